// Finds where closed surfaces touch or cross each other, or their own images in a periodic box.
//
// Two stages make the cost grow with the number of surfaces and of their neighbours, and not with all pairs. First the
// bounds of whole surfaces are tested against each other (sweep over sorted boxes); then, for each pair, only the
// triangles in the intersection of the two bounds, by their boxes and by exact predicates (CGAL). A surface wholly
// inside another does not cross it: use InsideTest to find it.
#pragma once
#include <Eigen/Geometry>
#include <optional>

#include "core/periodicity.hpp"
#include "geometry/triangleMesh.hpp"

namespace corpuscle::geometry {

using Bounds = Eigen::AlignedBox3d;
Bounds boundsOf(const std::vector<Vec3>& points);  // empty if a point is not finite

// A reference to a surface that is stored elsewhere.
struct SurfaceView {
    const std::vector<Vec3>* nodes;
    const std::vector<Index3>* triangles;

    Bounds bounds() const { return boundsOf(*nodes); }
};

// Two neighbours: the first surface, and the second one moved by `shift`. For a surface and its own image, the two
// numbers are equal and the shift is not zero.
struct ImagePair {
    std::size_t first, second;  // first <= second
    Vec3 shift;
    Vec3 slide = Vec3::Zero();  // velocity of the image relative to the second surface [m/s]
};

// All pairs of surfaces with images whose bounds, grown by `margin` [m], overlap; each pair of images once. Empty
// bounds overlap nothing.
std::vector<ImagePair> neighbours(const std::vector<Bounds>& bounds, const Periodicity& period, double margin = 0);

struct Crossing {
    Vec3 place;         // of one of the pairs of triangles, in the coordinates of the first surface
    std::size_t pairs;  // of triangles that have a point in common
};
std::optional<Crossing> crossing(const SurfaceView& first, const SurfaceView& second, const Vec3& shift);

}  // namespace corpuscle::geometry
