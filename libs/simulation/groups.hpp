// The dimensionless numbers of a case, for checkCase, the head of a run's log, and run.json. Cells (or bodies) after the first have those that
// differ, under their own name: "Ca (stiff)".
#pragma once
#include <string>
#include <vector>

#include "simulation/case.hpp"

namespace corpuscle::simulation {

struct Group {
    std::string name, value, text;
    double number;
    std::string symbol;  // the name without whose it is
};
std::vector<Group> dimensionlessGroups(const Case& input);
double capillaryNumber(const Case& input, const CellSettings& cell);  // mu gammadot a/Gs, Gs of the closed form

// Particles of the case by the lattice and the meshes' edge lengths, before anything is made.
struct ParticleEstimate {
    long fluid = 0, walls = 0, nodes = 0, bodies = 0;
    long all() const { return fluid + walls + nodes + bodies; }
};
ParticleEstimate estimateParticles(const Case& input);

// Bytes: memory of a run in all ranks together, one written time, one checkpoint.
struct SizeEstimate {
    double memory = 0, perWrite = 0, checkpoint = 0;
    long writes = 0;
};
SizeEstimate estimateSize(const Case& input);

}  // namespace corpuscle::simulation
