// Nearest points and signed distances of a closed surface in a periodic box, over all images of a point.
#pragma once
#include "geometry/insideTest.hpp"
#include "geometry/triangleTree.hpp"

namespace corpuscle::geometry {

// For a surface that may move, in its present position.
class NearestImages {
  public:
    // grid: a tree with these nodes, which is referred to and must not be moved in memory.
    NearestImages(const TriangleTree& grid, const std::vector<Vec3>& nodes, const Periodicity& period);

    struct Found {
        SurfacePoint at;
        Vec3 image = Vec3::Zero();  // of the point
        explicit operator bool() const { return static_cast<bool>(at); }
    };
    // Of all images of x within reach, the one nearest to the surface. As long as the surface and its own images do not
    // touch, the sign of its distance tells whether any image of x lies inside.
    Found nearest(const Vec3& x) const;

  private:
    const TriangleTree& grid_;
    Periodicity period_;
    Vec3 low_, high_;  // bounds of the points within reach
};

// For a fixed surface.
class PeriodicSurface {
  public:
    // Distances are exact within `reach` [m].
    PeriodicSurface(const TriangleMesh& mesh, double reach, const Periodicity& period)
        : grid_(mesh, reach), images_(grid_, mesh.nodes, period), inside_(mesh), period_(period) {}
    PeriodicSurface(const PeriodicSurface&) = delete;
    PeriodicSurface& operator=(const PeriodicSurface&) = delete;

    struct Place {
        double distance = 0;  // [m]; beyond the reach -reach inside, infinity outside
        // Image of the point that is nearest to the surface, or inside it; further outside the point itself.
        Vec3 image = Vec3::Zero();
    };
    Place at(const Vec3& x) const;

  private:
    TriangleTree grid_;
    NearestImages images_;
    InsideTest inside_;
    Periodicity period_;
};

}  // namespace corpuscle::geometry
