// The gap between two pieces of surface: node and node, node and edge, node and triangle, edge and edge.
//     gap vector = sum_k w_k x_k,   distance d = |gap vector|,   normal n = gap vector/d,   d(d)/dx_k = w_k n
// The weights w_k are those of the nearest points of the two pieces, and their sum is 0. The derivative contains no
// derivative of the weights, since the nearest points minimise the distance (envelope theorem).
//
// The distance of a node from a triangle or an edge has a continuous gradient wherever d > 0. The distance of two edges
// does not where they are parallel, since their nearest points jump. A contact of two edges is therefore multiplied by
// a factor
//     m = P(sin^2 theta) W(s) W(t),     P(y) = z (2 - z), z = min(y/parallelRange, 1)
//     W(s) = z^2 (3 - 2 z),  z = min(s, 1 - s, endRange)/endRange
// with a continuous gradient. m vanishes where the edges are parallel (as in Li et al. 2020, with a narrower range) and
// where a nearest point of the two lines reaches an end of its edge. No contact is lost there, since a node of one
// surface is then near a triangle of the other. crossingMean is the mean of m sin theta over all s, t and theta; the
// factor sin theta is due to random lines crossing at the angle theta in proportion to it.
// symbol | meaning                                              | unit
// theta  | angle between the two edges                          | rad
// s, t   | position of the nearest point along the first and    | -
//        | the second edge                                      |
//
// Li, Ferguson, Schneider, Langlois, Zorin, Panozzo, Jiang, Kaufman 2020, Incremental potential contact, ACM Trans.
// Graph. 39(4), 49.
#pragma once
#include <array>

#include "core/vec.hpp"

namespace corpuscle::contact {

struct Gap {
    double distance = 0;              // m
    Vec3 normal = Vec3::Zero();       // 0 where the pieces touch and no direction is known
    std::array<double, 4> weights{};  // of the nodes in the order of the arguments; 0 beyond the last argument
};

// A weight of exactly 0 means that the nearest point lies on an edge or at a node of the triangle. Degenerate pieces
// (edges of no length, triangles of no area) are allowed. The gap vector points to the first argument.
Gap nodeToNode(const Vec3& x, const Vec3& a);
Gap nodeToEdge(const Vec3& x, const Vec3& a, const Vec3& b);
Gap nodeToTriangle(const Vec3& x, const Vec3& a, const Vec3& b, const Vec3& c);
// Gap of the edges ab and cd; the gap vector points to the second one.
Gap edgeToEdge(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

constexpr double parallelRange = 0.25;  // sin^2 of 30 degrees
constexpr double endRange = 0.25;       // of the edge's length
constexpr double crossingMean = 0.3426;

struct CrossingFactor {
    double value = 0;             // m in the equation above, 0 to 1
    std::array<Vec3, 4> slope{};  // dm/dx_k [1/m]; set where value > 0
};
CrossingFactor crossingFactor(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

}  // namespace corpuscle::contact
