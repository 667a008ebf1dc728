// Rigid cells that repel each other, fixed surfaces and walls: energy, forces and stiffness as functions of the centres
// and axes of the cells.
//
//     E(q) = energy of contact (contact/contacts.hpp, contact/wallContact.hpp) of nodes at x = centre + scale R(axis) X
// symbol | meaning                                                                            | unit
// X      | node of the mesh around the origin, axis along z                                   | m
// R      | shortest rotation from z to the axis, as in geometry/place.hpp                     | 1
// q      | for each cell: its displacement; length times its rotation about two directions    | m
//        | normal to its axis                                                                 |
// length | radius of the cell; it gives all unknowns the same unit                            | m
//
// A rotation omega of the axis rotates the nodes by
//     Omega = omega - a (omega . z')/(1 + a_z),      z' = z - a a_z,   a: unit vector of the axis
// since the shortest rotation from z also spins about a. The second derivative includes the springs of contact only; it
// is positive semi-definite.
#pragma once
#include <Eigen/SparseCore>
#include <functional>

#include "contact/contacts.hpp"
#include "contact/wallContact.hpp"

namespace corpuscle::packing {

// What cells of one type have in common.
struct Kind {
    geometry::TriangleMesh mesh;  // around the origin, axis along z, at full size
    bool mayTurn = true;
};

struct Pose {
    std::size_t kind;
    Vec3 centre, axis;  // centre [m]; axis, a unit vector
};

class Crowd {
  public:
    static constexpr int freedoms = 5;  // degrees of freedom of a cell

    Crowd(std::vector<Kind> kinds, const std::vector<geometry::TriangleMesh>& fixed, boundary::Walls walls,
          const Periodicity& period, std::shared_ptr<const contact::ContactLaw> law);

    double radius(std::size_t kind) const { return kinds_[kind].radius; }  // largest distance of a node from the centre
    std::size_t nodesOf(std::size_t kind) const { return kinds_[kind].mesh.nodes.size(); }
    const contact::ContactLaw& law() const { return *law_; }
    const boundary::Walls& walls() const { return walls_; }

    // Sets the cells, by their number and kinds; all later poses must have the same number and kinds.
    void populate(const std::vector<Pose>& poses);
    // Positions of all nodes: those of the cells in their order, then those of the fixed surfaces.
    std::vector<Vec3> nodes(const std::vector<Pose>& poses, double scale) const;
    std::vector<Pose> moved(std::vector<Pose> poses, const Eigen::VectorXd& step) const;

    // Evaluates at the node positions x; makes new lists if the present ones do not cover x.
    void evaluate(const std::vector<Vec3>& x);
    double energy() const;    // J
    double leastGap() const;  // least gap within the range of the law, or just beyond it; infinite: there is none [m]
    std::size_t contacts() const { return contacts_.count() + atWalls_.size(); }
    // dE/dq [N] and the positive semi-definite part of d2E/dq2 [N/m]. poses: those whose nodes were evaluated last.
    Eigen::VectorXd gradient(const std::vector<Pose>& poses) const;
    Eigen::SparseMatrix<double> stiffness(const std::vector<Pose>& poses) const;  // lower triangle

    // Largest fraction in [0, 1] of the displacements u [m], from the positions evaluated last, that is free and leaves
    // at least `share` of each gap.
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
    std::vector<std::size_t> firstNode_;  // first node of each surface, and the number of all nodes
    std::vector<int> cellOf_;             // cell of each node; -1: fixed surface
    std::vector<Vec3> x_;                 // positions evaluated last
    std::vector<WallAt> atWalls_;
    bool isListed_ = false;
};

}  // namespace corpuscle::packing
