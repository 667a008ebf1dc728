// How large a case is, before anything is made: particles, memory of a run, disk.
//
// Memory, all ranks together:
//     ranks x program + sum over ranks (owned x list + (owned + ghosts) x each)
//         + nodes x state x holders + nodes of each mesh x network x ranks
// program: libraries, buffers of MPI and files. each: the store and its copy while sorting, sums over pairs, the two
// states that rollbacks keep, the arrays of the scheme. ghosts: copies from other ranks and periodic images, as deep as
// support and skin around the rank's brick. list: of what lies around a block of particles half is listed. The
// constants are measured (docs/simulation.md); a prediction is good to 20 %.
#pragma once
#include "simulation/case.hpp"

namespace corpuscle::simulation {

// By the lattice and the meshes' edge lengths. Whole numbers, which a box or an edge that is wrong by powers of ten
// makes larger than an integer holds. nodes: of membranes that are particles too (dual identity).
struct ParticleEstimate {
    double fluid = 0, walls = 0, nodes = 0, bodies = 0;
    double all() const { return fluid + walls + nodes + bodies; }
};
std::string countText(double count);  // "237600"; from 1e15 on "3.34e+33"
// Of a case without cells and bodies.
ParticleEstimate estimateLattice(const Case& input);
ParticleEstimate estimateParticles(const Case& input);

double estimateNodes(const CellSettings& cell);  // of its mesh, which each of its cells has

// Bytes: memory of a run in all ranks together, one written time, one checkpoint.
struct SizeEstimate {
    double memory = 0, perWrite = 0, checkpoint = 0, writes = 0;
};
SizeEstimate estimateSize(const Case& input, int ranks);

}  // namespace corpuscle::simulation
