// Particles on a cubic lattice in a box, layers of wall particles beyond two of its faces, and what membranes do to
// them.
//
// Along each axis n = round(L/dx) particles sit in the middle of cells of size L/n, which may differ from dx by 0.1 %
// at most. Wall layers go on with the spacing of their axis beyond -L/2 and +L/2.
#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "geometry/period.hpp"
#include "geometry/triangleMesh.hpp"

namespace corpuscle::geometry {

enum class PointKind : std::uint8_t { fluid, lowerWall, upperWall };

struct LatticeBox {
    Vec3 size = Vec3::Zero();       // m
    Vec3 centre = Vec3::Zero();     // m
    double spacing = 0;             // dx, m
    std::optional<int> wallNormal;  // 0, 1, 2: the axis across the walls; empty: no walls
    int wallLayers = 0;             // at each wall
    double jitter = 0;              // largest displacement of a fluid particle along each axis, in spacings, below 0.5
    std::uint64_t seed = 1;
};

struct Lattice {
    std::vector<Vec3> points;  // x fastest, then y, then z
    std::vector<PointKind> kinds;
    Index3 count{};               // of the fluid along each axis
    Vec3 spacing = Vec3::Zero();  // L/n along each axis, m
};

// Throws Failure(invalidCase) for a size that is no whole number of spacings, naming the nearest sizes that fit.
Lattice fillLattice(const LatticeBox& box);

// The `count` points nearest to any of the nodes, to be taken out so that the volume of the removed particles is that
// of the membrane's nodes. Sorted indices; points at the same distance go by index. Throws Failure(invalidCase) when
// there are not so many points.
std::vector<int> carve(const std::vector<Vec3>& points, const std::vector<Vec3>& nodes, std::size_t count,
                       const Period& period = Period::Zero());

// 0 outside, n inside meshes[n-1]. Throws Failure(invalidCase) for a point that lies in two cells.
std::vector<int> tagSides(const std::vector<Vec3>& points, const std::vector<TriangleMesh>& meshes,
                          const Period& period = Period::Zero());

// Moves points that are nearer than `least` [m] to a mesh out to that distance, each on its side (as of tagSides);
// returns how many.
std::size_t holdOff(std::vector<Vec3>& points, const std::vector<int>& side, const std::vector<TriangleMesh>& meshes,
                    double least, const Period& period = Period::Zero());

}  // namespace corpuscle::geometry
