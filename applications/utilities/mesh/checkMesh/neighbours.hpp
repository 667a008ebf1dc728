// Shortest distances between particles of 0/, by the kinds of the two particles, to detect overlaps. Periodic images
// are included.
#pragma once
#include <vector>

#include "particles/particleSystem.hpp"

namespace corpuscle::utilities {

struct Shortest {
    double fluidFluid, fluidWall, fluidBody, fluidNode;  // [m]
    double cellCell;                                     // nodes of two different cells
};

struct Members {
    std::vector<Vec3> fluid, walls, bodies;
    std::vector<std::vector<Vec3>> cells;  // nodes of each cell
};

// Distances beyond `reach` count as `reach`.
Shortest shortestDistances(const Members& members, const particles::Box& box, double reach, double spacing,
                           MPI_Comm comm);

}  // namespace corpuscle::utilities
