// Which surfaces may contain a point, or lie near it: a spatial index of their bounds in a periodic box.
//
// A grid over the box, as coarse as the surfaces are large; each of its cuboids lists the surfaces of which some image
// reaches into it. So the cost of a question goes with the surfaces around a point, not with all of them.
#pragma once
#include <vector>

#include "geometry/crossings.hpp"

namespace corpuscle::geometry {

class BoundsIndex {
  public:
    BoundsIndex() = default;
    // bounds: of surfaces as they stand, wherever that is; empty ones lie nowhere. Grown by `margin` [m]. low, high:
    // the box.
    BoundsIndex(const std::vector<Bounds>& bounds, const Vec3& low, const Vec3& high, const Periodicity& period,
                double margin = 0);

    // The surfaces whose bounds, or some image of them, may have x in them, by their numbers, ascending: all of those
    // that do, and some near by.
    const std::vector<int>& near(const Vec3& x) const;

  private:
    void add(int surface, const Bounds& bounds);
    Index3 cuboid(const Vec3& x) const;  // not wrapped: beyond the grid where x is beyond the box
    std::size_t index(const Index3& cuboid) const;

    Vec3 low_ = Vec3::Zero(), size_ = Vec3::Ones();  // of the box; of a cuboid
    Index3 count_{1, 1, 1};
    Periodicity period_;
    std::array<bool, 3> periodic_{};  // of the grid: not across faces whose images slide
    std::vector<std::vector<int>> surfaces_ = std::vector<std::vector<int>>(1);  // of each cuboid
};

// Of each mesh the points that may lie in its bounds, grown by `margin` [m], or images of theirs; in their order.
std::vector<std::vector<std::size_t>> pointsNear(const std::vector<Vec3>& points,
                                                 const std::vector<TriangleMesh>& meshes, double margin,
                                                 const Periodicity& period);

}  // namespace corpuscle::geometry
