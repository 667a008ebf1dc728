// Contact of surfaces with each other and with themselves: energy, forces, stiffness, and the free travel of nodes.
//
//     E = sum over pairs of surfaces (A, B) and their images of   E_nodes(A, B) + E_nodes(B, A) + E_edges(A, B)
//     E_nodes(A, B) = sum_v a_v q_A sum_F c_F psi(d(v, F) - thickness)          v: nodes of A,  F: pieces of B
//     E_edges(A, B) = sum_e,e' w_ee' m(e, e') psi(d(e, e') - thickness)         e: edges of A,  e': edges of B
// symbol | meaning                                                                       | unit | file
// psi    | energy per area of the law                                                    | J/m^2| contactLaw.hpp
// d      | distance of two pieces                                                        | m    | gap.hpp
// a_v    | area of a node in the reference state                                         | m^2  | surface.hpp
// c_F    | coefficient of a triangle, edge or node; counts overlapping pieces once       | 1    | surface.hpp
// q_A    | nodeShare a_B/(a_A + a_B), a_A: mean node area of A                           | 1    |
// w_ee'  | edgeShare/crossingMean min(b_e, b_e')^2, b: width of an edge                  | m^2  | surface.hpp
// m      | factor of two edges: 0 where they are parallel or do not cross inside         | 1    | gap.hpp
//
// Nodes: the sum over F is the integral of -psi'(r) times the Euler characteristic of the part of B in the ball of
// radius r around v. It equals psi of the distance of v from B wherever B is flat, convex towards v, or smooth on the
// scale of the reach, so a node that slides over a surface is not affected by its triangulation. The coefficients of
// the nearest pieces add up to at least 1 on any mesh, so the sum diverges where a node approaches a triangle, an edge
// or a node of B. (Li et al. 2023, Convergent incremental potential contact, count pieces in this way.)
// Edges: without them, two ridges could cross between their nodes. Every term has the sign of psi, and diverges where
// two edges cross away from their ends; at the ends and where edges are parallel, nodes are near triangles. (Edges of B
// cannot be counted by inclusion and exclusion as well, because of the factor m: sum_e' m psi - (n - 1) psi at a node
// with n edges has no lower bound.)
// Weights: two flat sheets at the gap g have the energy psi(g) per area. The part nodeShare of it, from nodes, is
// exact; with a fine and a coarse mesh most of it acts on the nodes of the fine one. The part edgeShare, from edges, is
// correct in the mean over positions and directions, for meshes with edges of the same length (crossingMean of gap.hpp:
// the mean of m, by the number of crossings).
//
// Stiffness: K = sum c (w w^T) x (n n^T), c = weight times psi'' where that is above 0. For each place on B that is
// nearest to a node, the coefficients of the pieces are added up first, then the sign is tested. K is positive
// semi-definite; the rotation of normals and the slope of m are left out.
//
// Contact of a surface with itself: pieces that share a node are left out. The caller must check that reach + thickness
// of the law does not exceed largestReach (surface.hpp), or pieces of an undeformed mesh may count as contacts.
//
// Nodes are numbered surface by surface: node n of surface s is node firstNode(s) + n of every array. Forces on an
// image of a node act on the node.
#pragma once
#include <algorithm>
#include <memory>

#include "contact/candidates.hpp"
#include "contact/contactLaw.hpp"
#include "contact/gap.hpp"
#include "contact/travel.hpp"

namespace corpuscle::contact {

constexpr double nodeShare = 0.92, edgeShare = 0.08;

// One term c (w w^T) x (n n^T) of the stiffness.
struct Spring {
    std::array<int, 4> nodes;
    std::array<double, 4> weights;  // their sum is 0; 0 for unused nodes
    Vec3 normal;
    double stiffness;  // c > 0, N/m
};

// Needed if images of the box slide (core/periodicity.hpp).
struct Sliding {
    double seconds = 0, slide = 0;  // duration of the displacements; speed of the fastest image at a surface [m/s]
};

class Contacts {
  public:
    explicit Contacts(std::shared_ptr<const ContactLaw> law) : law_(std::move(law)) {}

    // Lists the pieces that may come within the range of the law, and evaluates at x. Listed are, for each pair of
    // surfaces, the pieces within
    //     range + spare + the most by which their nodes approach each other with the displacements `travel` [m]
    // of each other (without travel, the last term is 0). The surfaces must outlive the lists. pairs: from
    // geometry::neighbours with a margin of at least pairMargin; (s, s, 0) pairs a surface with itself.
    void find(std::span<const Surface* const> surfaces, std::span<const Vec3> x,
              std::span<const geometry::ImagePair> pairs, double spare, std::span<const Vec3> travel = {},
              Sliding sliding = {});
    double pairMargin(double spare, std::span<const Vec3> travel, Sliding sliding = {}) const;
    // Whether the lists include every contact at the positions x, with images where they were at `find`: true if no two
    // surfaces have approached each other by more than was expected at `find`.
    bool covers(std::span<const Vec3> x) const;
    int firstNode(std::size_t surface) const { return firstNode_[surface]; }
    const Candidates& candidates() const { return *candidates_; }
    // Marks the nodes of all listed pieces: only these can have a force.
    void markListed(std::span<char> marks) const;

    // Computes energy, forces, springs, least gap and virial at the positions x [m], for the functions below.
    void evaluate(std::span<const Vec3> x);
    double energy() const { return energy_; }             // J
    void addForces(std::span<Vec3> f) const;              // N
    const Mat3& virial() const { return virial_; }        // sum_k x_k f_k^T, x_k: nodes, as the images that touch [J]
    double leastGap() const { return leastGap_; }         // distance - thickness [m]; infinite: nothing is listed
    std::size_t count() const { return points_.size(); }  // number of contacts: gaps below the reach
    const std::vector<Spring>& springs() const { return springs_; }
    void addStiffness(double factor, std::span<const Vec3> u, std::span<Vec3> f) const;  // f += factor K u

    // Largest fraction in [0, 1] of the displacements u [m] from x on which every gap stays at least `share` of its
    // value at x, or of the reach, so that nothing crosses. It is also limited by what the lists cover: two surfaces
    // may approach each other by (1 - share) reach plus the approach expected at `find`, less their approach since. 0
    // if the lists do not cover x. seconds: duration of the displacements, during which sliding images move on.
    double freeTravel(std::span<const Vec3> x, std::span<const Vec3> u, double share = 0.1, double seconds = 0) const;

  private:
    // One contact: a node at a piece, or two edges, within the range of the law.
    struct Point {
        std::array<int, 4> nodes;
        Gap gap;
        double weight;  // m^2: area times coefficients, or w m
        ContactLaw::Value psi;
    };
    // The force of a contact of two edges that is due to the slope of m.
    struct Turning {
        std::array<int, 4> nodes;
        std::array<Vec3, 4> force;
    };
    // The point of the target nearest to a node. kind: whether it lies on a triangle, an edge or a node; number: of
    // that triangle, edge or node; coefficient: sum of c_F over the pieces with this nearest point.
    struct Place {
        int kind, number, coefficient;
        std::array<int, 4> nodes;
        Gap gap;
    };
    void addNode(const NodeRow& row, std::span<const Vec3> x);
    void addTriangles(const NodeRow& row, std::span<const Vec3> x);
    void addRims(const NodeRow& row, std::span<const Vec3> x);
    void addPlace(int kind, int number, int coefficient, const std::array<int, 4>& nodes, const Gap& gap);
    void addPoint(const std::array<int, 4>& nodes, const Gap& gap, double weight);
    void addEdges(const EdgePair& pair, std::span<const Vec3> x);
    std::array<int, 4> nodesOf(const NodeRow& row, int triangle) const;
    std::array<int, 4> nodesOf(const EdgePair& pair) const;
    // Two bounds of the displacements of the nodes of a surface: `mean` for all, and at most `spread` in addition; or a
    // mean deformation whose gradient has the norm `gradient`, and at most `rest` in addition.
    struct Motion {
        Vec3 mean = Vec3::Zero();                   // m
        double spread = 0, gradient = 0, rest = 0;  // m, 1, m
    };
    std::vector<Motion> motionsOf(std::span<const Vec3> u) const;
    Motion motionOf(std::span<const Vec3> x, std::span<const Vec3> u) const;
    static constexpr double mostGradient = 0.4;  // largest norm for which the mean deformation is used
    // Upper bound of the approach of the nodes of the two surfaces in this time [s].
    static double approach(const geometry::ImagePair& pair, const std::vector<Motion>& motions, double seconds) {
        const Motion &a = motions[pair.first], &b = motions[pair.second];
        return a.spread + b.spread + (a.mean - b.mean - seconds * pair.slide).norm();
    }
    // The same for pieces that are `within` of each other; pieces further apart do not get nearer than these. For
    // pieces of one surface the bound is small, since a mean deformation hardly changes the distance of pieces near
    // each other.
    static double approach(const geometry::ImagePair& pair, const std::vector<Motion>& motions, double seconds,
                           double within) {
        const Motion& own = motions[pair.first];
        const double any = approach(pair, motions, seconds);
        return isOfOne(pair) && own.gradient <= mostGradient ? std::min(any, 2 * own.rest + own.gradient * within)
                                                             : any;
    }
    static bool isOfOne(const geometry::ImagePair& pair) { return pair.first == pair.second && pair.shift.isZero(0); }
    // Expected approach of the pieces of a pair: all pieces that will come within range are now within range plus this.
    double expectedOf(const geometry::ImagePair& pair, const std::vector<Motion>& motions, double seconds,
                      double spare) const;
    std::vector<Vec3> since(std::span<const Vec3> x) const;  // displacements since `find`

    std::shared_ptr<const ContactLaw> law_;
    std::vector<const Surface*> surfaces_;
    std::vector<int> firstNode_;
    std::vector<Vec3> found_;       // positions at `find`
    std::vector<double> expected_;  // expected approach of each pair in candidates_ [m]
    double expectedOfOthers_ = 0;   // the same for surfaces that are not a pair
    double slide_ = 0;              // speed of the fastest image [m/s]
    std::shared_ptr<const Candidates> candidates_ = std::make_shared<Candidates>();  // shared by copies

    double energy_ = 0, leastGap_ = 0;
    Mat3 virial_ = Mat3::Zero();
    std::vector<Point> points_;
    std::vector<Turning> turnings_;
    std::vector<Spring> springs_;
    std::vector<Place> places_;  // of the present row
};

}  // namespace corpuscle::contact
