// Particles on a cubic lattice in a box and in layers beyond it: which are fluid or wall, which make room for
// membranes, and on which side of them they lie.
//
// Along each axis n = round(L/dx) particles sit in the middle of lattice cells of size L/n, which may differ from dx by
// 0.1 % at most. The layers continue with the spacing of their axis beyond -L/2 and +L/2.
#pragma once
#include <cstdint>
#include <functional>
#include <vector>

#include "core/periodicity.hpp"
#include "geometry/triangleMesh.hpp"

namespace corpuscle::geometry {

enum class PointKind : std::uint8_t { fluid, wall, nothing };

struct LatticeBox {
    Vec3 size = Vec3::Zero();                      // m
    Vec3 centre = Vec3::Zero();                    // m
    double spacing = 0;                            // dx, m
    Index3 layers{0, 0, 0};                        // number of layers beyond both faces across each axis
    std::function<PointKind(const Vec3&)> kindOf;  // kind of a lattice point; empty: all are fluid
    double jitter = 0;  // largest displacement of a fluid particle along each axis, in spacings, below 0.5
    std::uint64_t seed = 1;
};

struct Lattice {
    std::vector<Vec3> points;  // x fastest, then y, then z; without points of the kind `nothing`
    std::vector<PointKind> kinds;
    Index3 count{};               // points in the box along each axis
    Vec3 spacing = Vec3::Zero();  // L/n along each axis, m
};

// Throws Failure(invalidCase) for a size that is not a whole number of spacings, naming the nearest sizes that fit.
Lattice fillLattice(const LatticeBox& box);

// The sorted indices of the `count` points nearest to any of the nodes. They are to be removed, so that the removed
// volume equals that of the membrane's nodes. Points at the same distance are taken in the order of their indices.
// Throws Failure(invalidCase) if there are fewer points.
std::vector<int> carve(const std::vector<Vec3>& points, const std::vector<Vec3>& nodes, std::size_t count,
                       const Periodicity& period = {});

// 0 outside, n inside meshes[n-1]. Throws Failure(invalidCase) for a point that lies in two cells.
std::vector<int> tagSides(const std::vector<Vec3>& points, const std::vector<TriangleMesh>& meshes,
                          const Periodicity& period = {});

// Moves points that are nearer than `least` [m] to a mesh away from it to that distance, each on its side (as given by
// tagSides); returns how many were moved.
std::size_t holdOff(std::vector<Vec3>& points, const std::vector<int>& side, const std::vector<TriangleMesh>& meshes,
                    double least, const Periodicity& period = {});

}  // namespace corpuscle::geometry
