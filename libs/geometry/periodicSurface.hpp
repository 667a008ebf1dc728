// Nearest points and signed distances of a closed surface in a periodic box, over all images of a point.
#pragma once
#include "geometry/insideTest.hpp"
#include "geometry/triangleTree.hpp"

namespace corpuscle::geometry {

// Of a surface that may move, as it stands now.
class NearestImages {
  public:
    // grid: with these nodes, and it must stay where it is.
    NearestImages(const TriangleTree& grid, const std::vector<Vec3>& nodes, const Periodicity& period);

    struct Found {
        SurfacePoint at;
        Vec3 image = Vec3::Zero();  // of the point
        explicit operator bool() const { return static_cast<bool>(at); }
    };
    // Of all images of x that are within reach the one nearest to the surface. As long as the surface and its own
    // images are apart, the sign is that of x among all of them.
    Found nearest(const Vec3& x) const;

  private:
    const TriangleTree& grid_;
    Periodicity period_;
    Vec3 low_, high_;  // of what is within reach
};

// Of a fixed surface.
class PeriodicSurface {
  public:
    // Distances are exact within `reach` [m].
    PeriodicSurface(const TriangleMesh& mesh, double reach, const Periodicity& period)
        : grid_(mesh, reach), images_(grid_, mesh.nodes, period), inside_(mesh), period_(period) {}
    PeriodicSurface(const PeriodicSurface&) = delete;
    PeriodicSurface& operator=(const PeriodicSurface&) = delete;

    struct Place {
        double distance = 0;  // [m]; -reach further inside, infinity further outside
        Vec3 image =
            Vec3::Zero();  // of the point: the one nearest to the surface, or inside it; itself further outside
    };
    Place at(const Vec3& x) const;

  private:
    TriangleTree grid_;
    NearestImages images_;
    InsideTest inside_;
    Periodicity period_;
};

}  // namespace corpuscle::geometry
