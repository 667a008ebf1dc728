// The files of 0/, and what they were made for.
//
// 0/<cell>.vtp and 0/<body>.vtp (membraneMesh), 0/fluid.vtp, 0/walls.vtp and 0/bodies.vtp (particleFill) hold places:
// nodes and triangles, particles and their sides. Each notes in its field data, as texts by name, the settings that its
// places follow from; reading compares them with the case:
//     of a cell       cell.shape.*, cell.edge, cell.enclose, cell.centre, cell.axis; of a body likewise
//     of particles    mesh.domain.*, mesh.cells[n].*, mesh.bodies[n].*, numerics.spacing; of mesh.fill.* and
//                     numerics.kernel.* what counts
// What only the run depends on (flow, Ca, Re, fluid, laws, time step) is not among them: a start holds for all such
// values. Velocity, density and pressure in these files are those of the case as it was filled, for looking at; a run
// takes its own from the flow.
#pragma once
#include <filesystem>
#include <map>
#include <string>

#include "io/polyData.hpp"
#include "simulation/case.hpp"

namespace corpuscle::simulation {

std::filesystem::path startFile(const Case& input, const std::string& name);  // 0/<name>.vtp

// Name ("mesh.domain.size") and value ("[1.2e-05 m, 1e-05 m, 1e-05 m]", ten digits) of what 0/<name>.vtp depends on.
std::map<std::string, std::string> startSettings(const Case& input, const std::string& name);

// Collective. Failure(io) when 0/ cannot be written, before anything is meshed or filled.
void requireStartWritable(const Communicator& communicator, const Case& input);

// Writes 0/<name>.vtp at t = 0 with its settings. Throws Failure(io).
void writeStart(const Case& input, const std::string& name, io::PolyData data);

// Throws Failure(io) when the file is missing, damaged, without a checksum or, of a cell or body, without triangles,
// and CaseError with each setting for which it was not made; both say what to run.
io::PolyData readStart(const Case& input, const std::string& name);

}  // namespace corpuscle::simulation
