// Contact of surfaces with each other and with themselves: its energy, forces, stiffness, and how far nodes may move.
//
//     E = sum over pairs of surfaces (A, B) and their images of   E_nodes(A, B) + E_nodes(B, A) + E_edges(A, B)
//     E_nodes(A, B) = sum_v a_v q_A sum_F c_F psi(d(v, F) - thickness)          v: nodes of A,  F: pieces of B
//     E_edges(A, B) = sum_e,e' w_ee' m(e, e') psi(d(e, e') - thickness)         e: edges of A,  e': edges of B
// symbol | meaning                                                                       | unit | file
// psi    | energy per area of the law                                                    | J/m^2| contactLaw.hpp
// d      | distance of two pieces                                                        | m    | gap.hpp
// a_v    | area of a node in the reference state                                         | m^2  | surface.hpp
// c_F    | coefficient of a triangle, edge or node: counts pieces that overlap once      | 1    | surface.hpp
// q_A    | nodeShare a_B/(a_A + a_B), a_A: mean node area of A                           | 1    |
// w_ee'  | edgeShare/crossingMean min(b_e, b_e')^2, b: width of an edge                  | m^2  | surface.hpp
// m      | factor of two edges: 0 where they are parallel or do not cross inside         | 1    | gap.hpp
//
// Nodes: the sum over F is the integral of -psi'(r) times the Euler characteristic of what lies of B in the ball of
// radius r around v. It is psi of the distance of v from B wherever B is flat, convex towards v, or smooth on the scale
// of the reach, so a node that slides over a surface does not feel its triangles. The coefficients add up to at least 1
// among the pieces that are nearest, whatever the mesh: the sum diverges where a node approaches a triangle, an edge
// or a node of B.
// (Li et al. 2023, Convergent incremental potential contact, count pieces in this way.)
// Edges: without them, two ridges could cross between the nodes. Every term has the sign of psi, and diverges where two
// edges cross away from their ends; at the ends and where edges are parallel, nodes are near triangles. (To count edges
// of B by inclusion and exclusion as well is not possible with a factor m: sum_e' m psi - (n - 1) psi at a node with n
// edges has no lower bound.)
// Weights: two flat sheets at the gap g have the energy psi(g) per area. Its part nodeShare is exact, of a fine and a
// coarse mesh mostly on the nodes of the fine one. The part edgeShare is the mean over positions and directions, of
// meshes with edges of the same length (crossingMean of gap.hpp: the mean of m, by the number of crossings).
//
// Stiffness: K = sum c (w w^T) x (n n^T), c = weight times psi'' where that is above 0. The pieces' coefficients are
// added up for each place on B that is nearest to a node before the sign is looked at. K is positive semi-definite; the
// turning of normals and the slope of m are left out.
//
// Contact of a surface with itself: pieces that share a node are left out. reach + thickness of the law must not exceed
// largestReach (surface.hpp), or pieces of an undeformed mesh may count as contacts: this is for the caller to check.
//
// All surfaces are numbered through: node n of surface s is node firstNode(s) + n of every array. Forces on an image
// of a node act on the node.
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
    std::array<double, 4> weights;  // sum 0; 0 of those that are not needed
    Vec3 normal;
    double stiffness;  // c > 0, N/m
};

// Where images of the box slide (core/periodicity.hpp).
struct Sliding {
    double seconds = 0, slide = 0;  // what displacements take; of the fastest image beside a surface [m/s]
};

class Contacts {
  public:
    explicit Contacts(std::shared_ptr<const ContactLaw> law) : law_(std::move(law)) {}

    // Lists the pieces that may come within the law's range, and evaluates: for each pair of surfaces those within
    //     range + spare + the most by which their nodes approach each other with the displacements `travel` [m]
    // (no travel: 0). The surfaces must outlive the lists. pairs: of geometry::neighbours with a margin of at least
    // pairMargin; (s, s, 0) is a surface and itself.
    void find(std::span<const Surface* const> surfaces, std::span<const Vec3> x,
              std::span<const geometry::ImagePair> pairs, double spare, std::span<const Vec3> travel = {},
              Sliding sliding = {});
    double pairMargin(double spare, std::span<const Vec3> travel, Sliding sliding = {}) const;
    // Whether the lists hold every contact of these places, images being where they were at `find`: no two surfaces
    // have approached each other by more than `find` expected.
    bool covers(std::span<const Vec3> x) const;
    int firstNode(std::size_t surface) const { return firstNode_[surface]; }
    const Candidates& candidates() const { return *candidates_; }
    // Marks the nodes of all pieces that are listed: no other has a force.
    void markListed(std::span<char> marks) const;

    // Energy, forces, springs, gap and virial of these places [m], for the functions below.
    void evaluate(std::span<const Vec3> x);
    double energy() const { return energy_; }             // J
    void addForces(std::span<Vec3> f) const;              // N
    const Mat3& virial() const { return virial_; }        // sum_k x_k f_k^T, x_k: of the images that touch [J]
    double leastGap() const { return leastGap_; }         // distance - thickness [m]; infinite: nothing is listed
    std::size_t count() const { return points_.size(); }  // of contacts: gaps below the reach
    const std::vector<Spring>& springs() const { return springs_; }
    void addStiffness(double factor, std::span<const Vec3> u, std::span<Vec3> f) const;  // f += factor K u

    // Largest fraction in [0, 1] of the displacements u [m] from x after which every gap is at least `share` of what it
    // is at x, or of the reach, on the whole way: nothing crosses. It is also limited by what the lists cover: two
    // surfaces approach each other by no more than (1 - share) reach and what `find` expected, less what they have
    // since. 0 where the lists do not cover x. seconds: what the displacements take; images that slide go on meanwhile.
    double freeTravel(std::span<const Vec3> x, std::span<const Vec3> u, double share = 0.1, double seconds = 0) const;

  private:
    // One place where a node or an edge is within reach.
    struct Point {
        std::array<int, 4> nodes;
        Gap gap;
        double weight;  // m^2: area times coefficients, or w m
        ContactLaw::Value psi;
    };
    // The force by the slope of m.
    struct Turning {
        std::array<int, 4> nodes;
        std::array<Vec3, 4> force;
    };
    // The place on the target that is nearest: by its kind (corners that count) and number.
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
    // How the nodes of a surface move: all of them by `mean` and each by no more than `spread` besides; or all by a
    // mean deformation whose gradient has the norm `gradient`, and each by no more than `rest` besides.
    struct Motion {
        Vec3 mean = Vec3::Zero();                   // m
        double spread = 0, gradient = 0, rest = 0;  // m, 1, m
    };
    std::vector<Motion> motionsOf(std::span<const Vec3> u) const;
    Motion motionOf(std::span<const Vec3> x, std::span<const Vec3> u) const;
    static constexpr double mostGradient = 0.4;  // largest norm with which a mean deformation is treated apart
    // The most by which nodes of the two surfaces approach each other, in as many seconds.
    static double approach(const geometry::ImagePair& pair, const std::vector<Motion>& motions, double seconds) {
        const Motion &a = motions[pair.first], &b = motions[pair.second];
        return a.spread + b.spread + (a.mean - b.mean - seconds * pair.slide).norm();
    }
    // The same of pieces that are `within` of each other; those further apart do not get nearer than these. A mean
    // deformation moves pieces of one surface that are near each other little against each other.
    static double approach(const geometry::ImagePair& pair, const std::vector<Motion>& motions, double seconds,
                           double within) {
        const Motion& own = motions[pair.first];
        const double any = approach(pair, motions, seconds);
        return isOfOne(pair) && own.gradient <= mostGradient ? std::min(any, 2 * own.rest + own.gradient * within)
                                                             : any;
    }
    static bool isOfOne(const geometry::ImagePair& pair) { return pair.first == pair.second && pair.shift.isZero(0); }
    // By how much pieces of a pair may approach each other, so that all that come within range are within range and
    // this of each other now.
    double expectedOf(const geometry::ImagePair& pair, const std::vector<Motion>& motions, double seconds,
                      double spare) const;
    std::vector<Vec3> since(std::span<const Vec3> x) const;  // `find`: displacements

    std::shared_ptr<const ContactLaw> law_;
    std::vector<const Surface*> surfaces_;
    std::vector<int> firstNode_;
    std::vector<Vec3> found_;       // places at `find`
    std::vector<double> expected_;  // approach, of each pair in candidates_ [m]
    double expectedOfOthers_ = 0;   // of surfaces that are no pair
    double slide_ = 0;              // of the fastest image [m/s]
    std::shared_ptr<const Candidates> candidates_ = std::make_shared<Candidates>();  // of copies, too

    double energy_ = 0, leastGap_ = 0;
    Mat3 virial_ = Mat3::Zero();
    std::vector<Point> points_;
    std::vector<Turning> turnings_;
    std::vector<Spring> springs_;
    std::vector<Place> places_;  // of the present row
};

}  // namespace corpuscle::contact
