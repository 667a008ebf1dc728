// From a checked case to a scene: only what the case names exists.
#pragma once
#include "coupling/scene.hpp"
#include "simulation/case.hpp"

namespace corpuscle::simulation {

// Particles and cells as they stand in 0/, spread over the ranks. Throws Failure(io) when files are missing or do not belong to
// the case, saying which utility writes them. Collective.
coupling::Scene buildScene(const Case& input, MPI_Comm comm);

// The scene without particles: what a restart fills from its checkpoint.
coupling::Scene emptyScene(const Case& input, MPI_Comm comm);

// Volume of each node of a membrane as a particle: the area around it, one spacing thick [m^3].
std::vector<double> nodeVolumes(const std::vector<double>& vertexAreas, double spacing);

}  // namespace corpuscle::simulation
