// Predicts the size of a case before anything is created: particles, memory of a run, disk space.
//
// Memory, all ranks together:
//     ranks x program + sum over ranks (owned x list + (owned + ghosts) x each)
//         + nodes x state x holders + nodes of each mesh x network x ranks
// term    | meaning
// program | libraries, buffers of MPI and files
// owned   | particles of a rank
// ghosts  | copies from other ranks and periodic images, within support + skin of the rank's brick
// list    | neighbour list, per particle; of the particles around a block, half are listed
// each    | per particle: the store and its copy while sorting, sums over pairs, the two states that rollbacks keep,
//         | the arrays of the scheme
// state   | of a node of a cell, on each of the ranks that hold the cell (`holders`)
// network | of a mesh node with its bonds and triangles, on every rank
// The constants are measured (docs/simulation.md); predictions are accurate to 20 %.
#pragma once
#include "simulation/case.hpp"

namespace corpuscle::simulation {

// Numbers of particles, from the lattice and the meshes' edge lengths. Whole numbers, stored as double because a box or
// an edge that is wrong by powers of ten gives more than an integer holds. nodes: membrane nodes that are also
// particles (dual identity).
struct ParticleEstimate {
    double fluid = 0, walls = 0, nodes = 0, bodies = 0;
    double all() const { return fluid + walls + nodes + bodies; }
};
std::string countText(double count);  // "237600"; from 1e15 on "3.34e+33"
// Of the lattice alone, as in a case without cells and bodies.
ParticleEstimate estimateLattice(const Case& input);
ParticleEstimate estimateParticles(const Case& input);

double estimateNodes(const CellSettings& cell);  // of the mesh of one cell

// In bytes: memory of a run on all ranks together, one written time, one checkpoint. writes: number of written times.
struct SizeEstimate {
    double memory = 0, perWrite = 0, checkpoint = 0, writes = 0;
};
SizeEstimate estimateSize(const Case& input, int ranks);

}  // namespace corpuscle::simulation
