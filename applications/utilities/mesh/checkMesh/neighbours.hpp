// Shortest distances in a start, by what the two particles are: overlaps show here. Periodic images included.
#pragma once
#include <vector>

#include "particles/particleSystem.hpp"

namespace corpuscle::utilities {

struct Shortest {
    double fluidFluid, fluidWall, fluidBody, fluidNode;  // [m]
    double cellCell;                                     // nodes of two cells
};

struct Members {
    std::vector<Vec3> fluid, walls, bodies;
    std::vector<std::vector<Vec3>> cells;  // nodes of each
};

// Distances beyond `reach` count as `reach`.
Shortest shortestDistances(const Members& members, const particles::Box& box, double reach, double spacing,
                           MPI_Comm comm);

}  // namespace corpuscle::utilities
