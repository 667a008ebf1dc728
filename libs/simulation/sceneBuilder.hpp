// From a checked case to a scene: only what the case names exists.
#pragma once
#include "coupling/scene.hpp"
#include "simulation/case.hpp"

namespace corpuscle::simulation {

// Particles and cells where they stand in 0/, with the velocity and pressure of the flow, spread over the ranks. Throws
// as readStart. Collective.
coupling::Scene buildScene(const Case& input, MPI_Comm comm);

// The scene without particles: what a restart fills from its checkpoint.
coupling::Scene emptyScene(const Case& input, MPI_Comm comm);

// Volume of each node of a membrane as a particle: the area around it, one spacing thick [m^3].
std::vector<double> nodeVolumes(const std::vector<double>& vertexAreas, double spacing);

}  // namespace corpuscle::simulation
