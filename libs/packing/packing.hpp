// Puts many cells in place without overlap: scattered small, grown to their size, and pushed apart as they grow.
//
// 1. Balls around the cells, all scaled down alike, are put at random where they are clear of each other, of walls and
//    of what is fixed.
// 2. The scale grows by as much as leaves 0.3 of each gap; then Newton's method lowers the energy of the barrier
//    between surfaces (contact/barrier.hpp, with the gap as its thickness) over the places and axes of all cells, which
//    are rigid. No way that a surface goes crosses another one (contact/travel.hpp). Repeated until the scale is 1.
// 3. At full size, Newton's method again until nothing presses or moves.
// There is no stage at which surfaces are nearer than the gap. Contact is that of rough surfaces around the cells' own,
// whose edges are 0.35 of the radius of a ball of the cell's volume.
//
// The cells are unstressed in the end. Their arrangement is not one of flow: shear them before averaging.
#pragma once
#include "geometry/shape.hpp"
#include "packing/crowd.hpp"
#include "packing/orientation.hpp"

namespace corpuscle::packing {

// A coarse surface around a finer mesh of a shape, to be packed quickly in its place; around the origin, axis along z.
struct RoughSurface {
    geometry::TriangleMesh mesh;
    double outside = 0;           // the most by which nodes of the finer mesh lie outside of it [m]
    bool sameUpsideDown = false;  // half a turn about x leaves the shape what it is
    // The mesh itself where that is not much finer, or where there is no such surface.
    static RoughSurface of(const geometry::Shape& shape, const geometry::TriangleMesh& mesh);
};

class Packing {
  public:
    struct Type {
        RoughSurface surface;
        std::size_t number;  // of cells
        const Orientation* orientation;
    };
    struct Space {
        Vec3 low, high;  // around the fluid [m]
        double volume;   // of the fluid [m^3]
        Periodicity period;
        boundary::Walls walls;
        std::vector<geometry::TriangleMesh> fixed;  // cells and rigid bodies that are in place
    };
    struct Progress {
        double scale;          // of all cells
        int stages;            // of growth
        int iterations;        // of Newton's method, in all
        std::size_t contacts;  // of nodes and edges
        double leastGap;       // between surfaces [m]; infinite: beyond the range of contact
    };

    // gap: least distance of surfaces from each other and from walls [m].
    Packing(const std::vector<Type>& types, const Space& space, double gap);

    // Cells in the order of their types; the same places for the same seed. `told` hears of each stage. Throws
    // Failure(numerics), with how far they came, where there is no room.
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
