// Builds the scene of a checked case; it contains only what the case names.
#pragma once
#include "coupling/scene.hpp"
#include "simulation/case.hpp"

namespace corpuscle::simulation {

// The scene at t = 0: particles and cells at their places in 0/, with the velocity and pressure of the flow,
// distributed over the ranks. Throws like readStart. Collective.
coupling::Scene buildScene(const Case& input, MPI_Comm comm);

// The scene without particles, which a restart fills from its checkpoint.
coupling::Scene emptyScene(const Case& input, MPI_Comm comm);

// Distance from its brick up to which a rank holds cells, with lists of this skin [m].
double cellMargin(const Case& input, double skin);

// Volume of each membrane node as a particle: its vertex area times one spacing [m^3].
std::vector<double> nodeVolumes(const std::vector<double>& vertexAreas, double spacing);

}  // namespace corpuscle::simulation
