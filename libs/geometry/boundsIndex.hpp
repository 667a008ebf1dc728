// Which surfaces may contain a point, or lie near it: a spatial index of their bounds in a periodic box.
//
// A grid covers the box, with cuboids about as large as the surfaces; each cuboid lists the surfaces that have an image
// reaching into it. The cost of a query therefore depends on the surfaces around a point, not on all of them.
#pragma once
#include <vector>

#include "geometry/crossings.hpp"

namespace corpuscle::geometry {

class BoundsIndex {
  public:
    BoundsIndex() = default;
    // bounds: of the surfaces, anywhere in space; they are grown by `margin` [m]. Empty bounds contain no point. low,
    // high: corners of the box.
    BoundsIndex(const std::vector<Bounds>& bounds, const Vec3& low, const Vec3& high, const Periodicity& period,
                double margin = 0);

    // Numbers, in ascending order, of the surfaces whose bounds, or an image of them, may contain x: all that do, and
    // some nearby ones.
    const std::vector<int>& near(const Vec3& x) const;

  private:
    void add(int surface, const Bounds& bounds);
    Index3 cuboid(const Vec3& x) const;  // not wrapped: beyond the grid if x is beyond the box
    std::size_t index(const Index3& cuboid) const;

    Vec3 low_ = Vec3::Zero(), size_ = Vec3::Ones();  // lower corner of the box; size of a cuboid
    Index3 count_{1, 1, 1};
    Periodicity period_;
    std::array<bool, 3> periodic_{};  // axes along which the grid is wrapped: not across faces whose images slide
    std::vector<std::vector<int>> surfaces_ = std::vector<std::vector<int>>(1);  // of each cuboid
};

// For each mesh, the points that may lie, themselves or by an image, in its bounds grown by `margin` [m]; in the order
// of the points.
std::vector<std::vector<std::size_t>> pointsNear(const std::vector<Vec3>& points,
                                                 const std::vector<TriangleMesh>& meshes, double margin,
                                                 const Periodicity& period);

}  // namespace corpuscle::geometry
