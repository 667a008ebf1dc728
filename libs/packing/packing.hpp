// Places many cells without overlap: they are scattered at a small scale, grown to full size, and pushed apart as they
// grow.
//
// 1. Balls around the cells, all scaled down by the same factor, are placed at random where they are clear of each
//    other, of walls and of fixed surfaces.
// 2. The scale grows as far as 0.3 of each gap is left; then Newton's method, over the centres and axes of all cells,
//    lowers the energy of the barrier between surfaces (contact/barrier.hpp, with the gap as its thickness). Cells are
//    rigid, and no motion makes surfaces cross (contact/travel.hpp). This is repeated until the scale is 1.
// 3. At full size, Newton's method is applied again until no cell presses on another, or cells are at rest.
// Surfaces are never nearer to each other than the gap. Contact is computed with rough surfaces around those of the
// cells, with edges of 0.35 of the radius of a ball of the cell's volume.
//
// The packed cells are unstressed. Their arrangement is not one that a flow produces: shear them before averaging.
#pragma once
#include "geometry/shape.hpp"
#include "packing/crowd.hpp"
#include "packing/orientation.hpp"

namespace corpuscle::packing {

// A coarse surface around a finer mesh of a shape, packed in place of it for speed; around the origin, axis along z.
struct RoughSurface {
    geometry::TriangleMesh mesh;
    double outside = 0;           // largest distance of a node of the finer mesh outside the coarse surface [m]
    bool sameUpsideDown = false;  // whether half a turn about x maps the shape onto itself
    // Returns the mesh itself if a coarse surface would not be much coarser or cannot be made.
    static RoughSurface of(const geometry::Shape& shape, const geometry::TriangleMesh& mesh);
};

class Packing {
  public:
    struct Type {
        RoughSurface surface;
        std::size_t number;  // number of cells
        const Orientation* orientation;
    };
    struct Space {
        Vec3 low, high;  // around the fluid [m]
        double volume;   // of the fluid [m^3]
        Periodicity period;
        boundary::Walls walls;
        std::vector<geometry::TriangleMesh> fixed;  // cells and rigid bodies that stay where they are
    };
    struct Progress {
        double scale;          // of all cells
        int stages;            // number of stages of growth
        int iterations;        // of Newton's method, over all stages
        std::size_t contacts;  // number of contacts of nodes and edges
        double leastGap;       // between surfaces [m]; infinite: all are beyond the range of contact
    };

    // gap: least distance of surfaces from each other and from walls [m].
    Packing(const std::vector<Type>& types, const Space& space, double gap);

    // Returns cells in the order of their types; the same seed gives the same result. `told` is called after each
    // stage. Throws Failure(numerics), with the scale that was reached, if there is no room.
    std::vector<Pose> pack(std::uint64_t seed, const std::function<void(const Progress&)>& told = {});
    const Progress& progress() const { return progress_; }

  private:
    bool scatter(Random& random, double scale);
    void grow();
    void relax(int iterations, double gapsOfReach);
    bool step();
    void shorten(Eigen::VectorXd& q) const;
    bool isFree(const Vec3& centre, double radius, std::size_t among) const;

    std::vector<Type> types_;
    Space space_;
    double gap_;
    Crowd crowd_;
    std::vector<Pose> poses_;
    std::vector<Vec3> x_;
    Progress progress_{};
    std::function<void(const Progress&)> told_;
};

}  // namespace corpuscle::packing
