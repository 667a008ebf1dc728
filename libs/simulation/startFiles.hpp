// The files of 0/, and the settings for which they were made.
//
// 0/<cell>.vtp and 0/<body>.vtp (membraneMesh), 0/fluid.vtp, 0/walls.vtp and 0/bodies.vtp (particleFill) hold geometry:
// nodes and triangles, particles and their sides. Each records in its field data, as named texts, the settings on which
// its geometry depends; when it is read, they are compared with the case:
//     of a cell       cell.shape.*, cell.edge, cell.enclose, cell.centre, cell.axis; of a body likewise
//     of particles    mesh.domain.*, mesh.cells[n].*, mesh.bodies[n].*, numerics.spacing; of mesh.fill.* and
//                     numerics.kernel.* those that have an effect
// Settings on which only the run depends (flow, Ca, Re, fluid, laws, time step) are not among them: one filling serves
// all their values. Velocity, density and pressure in these files are those of the case when it was filled, for viewing
// only; a run takes its own from the flow.
#pragma once
#include <filesystem>
#include <map>
#include <string>

#include "io/polyData.hpp"
#include "simulation/case.hpp"

namespace corpuscle::simulation {

std::filesystem::path startFile(const Case& input, const std::string& name);  // 0/<name>.vtp

// Name ("mesh.domain.size") and value ("[1.2e-05 m, 1e-05 m, 1e-05 m]", ten digits) of each setting on which
// 0/<name>.vtp depends.
std::map<std::string, std::string> startSettings(const Case& input, const std::string& name);

// Throws Failure(io) if 0/ cannot be written; called before anything is meshed or filled. Collective.
void requireStartWritable(const Communicator& communicator, const Case& input);

// Writes 0/<name>.vtp at t = 0 with its settings. Throws Failure(io).
void writeStart(const Case& input, const std::string& name, io::PolyData data);

// Throws Failure(io) if the file is missing, damaged, without a checksum or, for a cell or body, without triangles, and
// CaseError with each setting that differs from the case; both messages say which program to run.
io::PolyData readStart(const Case& input, const std::string& name);

}  // namespace corpuscle::simulation
