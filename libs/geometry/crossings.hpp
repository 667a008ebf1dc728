// Where closed surfaces touch or cross each other, or their own images in a periodic box.
//
// Two stages, so that the cost grows with the number of surfaces and of their neighbours, and not with all pairs:
// bounds of whole surfaces against each other (sweep of sorted boxes), then of each pair only the triangles in the
// intersection of the two bounds, by their boxes and by exact predicates (CGAL). One surface wholly inside another does
// not cross it: that is a question for InsideTest.
#pragma once
#include <Eigen/Geometry>
#include <optional>

#include "core/periodicity.hpp"
#include "geometry/triangleMesh.hpp"

namespace corpuscle::geometry {

using Bounds = Eigen::AlignedBox3d;
Bounds boundsOf(const std::vector<Vec3>& points);  // empty where one is not finite

// A surface that stands elsewhere.
struct SurfaceView {
    const std::vector<Vec3>* nodes;
    const std::vector<Index3>* triangles;

    Bounds bounds() const { return boundsOf(*nodes); }
};

// The second surface, moved by `shift`, beside the first. A surface and its own image: first == second, shift not zero.
struct ImagePair {
    std::size_t first, second;  // first <= second
    Vec3 shift;
    Vec3 slide = Vec3::Zero();  // by which the image is faster than the second surface [m/s]
};

// Every pair of whose bounds, grown by `margin` [m], some images meet; each pair of images once. Empty bounds meet
// nothing.
std::vector<ImagePair> neighbours(const std::vector<Bounds>& bounds, const Periodicity& period, double margin = 0);

struct Crossing {
    Vec3 place;         // of one of the pairs of triangles, in the coordinates of the first surface
    std::size_t pairs;  // of triangles that have a point in common
};
std::optional<Crossing> crossing(const SurfaceView& first, const SurfaceView& second, const Vec3& shift);

}  // namespace corpuscle::geometry
