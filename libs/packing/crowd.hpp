// Rigid surfaces that repel each other, fixed surfaces and walls: energy, forces and stiffness as functions of where
// each of them stands and how its axis points.
//
//     E(q) = energy of contact (contact/contacts.hpp, contact/wallContact.hpp) of nodes at x = centre + scale R(axis) X
// symbol | meaning                                                                           | unit
// X      | node of the mesh around the origin, axis along z                                   | m
// R      | shortest rotation from z to the axis, as in geometry/place.hpp                     | 1
// q      | for each cell its displacement, and length times its turn about two axes across its own | m
// length | radius of the cell; it gives all unknowns one unit                                 | m
//
// Turning an axis by omega turns the nodes by
//     Omega = omega - a (omega . z')/(1 + a_z),      z' = z - a a_z,   a: unit vector of the axis
// since the shortest rotation from z also spins about a. The second derivative is that of contact's springs alone; it
// is positive semi-definite.
#pragma once
#include <Eigen/SparseCore>
#include <functional>

#include "contact/contacts.hpp"
#include "contact/wallContact.hpp"

namespace corpuscle::packing {

// What cells of one type have in common.
struct Kind {
    geometry::TriangleMesh mesh;  // around the origin, axis along z, of full size
    bool mayTurn = true;
};

struct Pose {
    std::size_t kind;
    Vec3 centre, axis;  // m; of unit length
};

class Crowd {
  public:
    static constexpr int freedoms = 5;  // of a cell

    Crowd(std::vector<Kind> kinds, const std::vector<geometry::TriangleMesh>& fixed, boundary::Walls walls,
          const Periodicity& period, std::shared_ptr<const contact::ContactLaw> law);

    double radius(std::size_t kind) const { return kinds_[kind].radius; }  // largest distance of a node from the centre
    std::size_t nodesOf(std::size_t kind) const { return kinds_[kind].mesh.nodes.size(); }
    const contact::ContactLaw& law() const { return *law_; }
    const boundary::Walls& walls() const { return walls_; }

    // How many of which kind; their number stays what it is.
    void populate(const std::vector<Pose>& poses);
    // All nodes: of the cells in their order, and of the fixed surfaces.
    std::vector<Vec3> nodes(const std::vector<Pose>& poses, double scale) const;
    std::vector<Pose> moved(std::vector<Pose> poses, const Eigen::VectorXd& step) const;

    // Evaluates at these nodes. Lists are made anew where they do not cover them.
    void evaluate(const std::vector<Vec3>& x);
    double energy() const;    // J
    double leastGap() const;  // of those within the range of the law, or just beyond it; infinite: none is [m]
    std::size_t contacts() const { return contacts_.count() + atWalls_.size(); }
    // dE/dq [N] and the positive semi-definite part of d2E/dq2 [N/m], of poses whose nodes were evaluated last.
    Eigen::VectorXd gradient(const std::vector<Pose>& poses) const;
    Eigen::SparseMatrix<double> stiffness(const std::vector<Pose>& poses) const;  // its lower triangle

    // Largest part in [0, 1] of the straight ways u [m] from the nodes that were evaluated last that is free, with at
    // least `share` of each gap left.
    double freeTravel(const std::vector<Vec3>& u, double share);

  private:
    using Row = Eigen::Matrix<double, freedoms, 1>;
    struct Solid {
        geometry::TriangleMesh mesh;
        contact::Surface surface;
        double radius;
        bool mayTurn;
    };
    struct WallAt {
        int cell;
        contact::AtWall at;
    };
    void list(const std::vector<Vec3>& x, std::span<const Vec3> travel);
    std::size_t cellCount() const { return cellCount_; }
    std::span<const Vec3> ofCell(std::size_t cell, const std::vector<Vec3>& x) const;
    std::vector<Mat3> turnsOf(const std::vector<Pose>& poses) const;
    Row rowOf(const Pose& pose, const Mat3& turns, const Vec3& x, const Vec3& direction) const;
    void findWalls();

    std::vector<Solid> kinds_, fixed_;
    boundary::Walls walls_;
    Periodicity period_;
    std::shared_ptr<const contact::ContactLaw> law_;
    contact::Contacts contacts_;
    std::size_t cellCount_ = 0;
    std::vector<const contact::Surface*> surfaces_;
    std::vector<std::size_t> firstNode_;  // of each surface, and their sum
    std::vector<int> cellOf_;             // of each node; -1: fixed
    std::vector<Vec3> x_;                 // evaluated last
    std::vector<WallAt> atWalls_;
    bool isListed_ = false;
};

}  // namespace corpuscle::packing
