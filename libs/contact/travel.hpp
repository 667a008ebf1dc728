// How far four nodes may move along given straight lines before two pieces of surface meet: additive continuous
// collision detection (Li, Kaufman, Jiang 2021).
//
// The distance of the pieces after the fraction T of the displacements, d(T), falls no faster than
//     l = largest displacement of the first piece + largest of the second,   each less the mean of the four nodes,
// so that from T the fraction (d(T) - least)/l more is free. So is, with any unit vector n, the fraction up to which
// n.(x_i - x_j) >= least for all nodes i of the one and j of the other piece; with the normal at T as n it is long for
// pieces that slide past each other. The greater of the two is added up until little is left; each partial sum is
// itself safe, and the number of terms is bounded.
//     least = thickness + share (d(0) - thickness)     the distance that is kept
// Pieces that begin nearer than the thickness (triangles squeezed flat) are kept from meeting only: their thickness
// counts as 0.
// symbol    | meaning                                              | unit
// d         | distance of the pieces                               | m
// thickness | distance at which the surfaces touch                 | m
// share     | part of the gap d(0) - thickness that is kept        | -
//
// Li, Kaufman, Jiang 2021, Codimensional incremental potential contact, ACM Trans. Graph. 40(4), 170.
#pragma once
#include <array>

#include "core/vec.hpp"

namespace corpuscle::contact {

using FourNodes = std::array<Vec3, 4>;

struct Keep {
    double thickness = 0;  // m, not below 0
    double share = 0.1;    // above 0, below 1
};

// Largest fraction of the displacements `u` [m] that is known to be free, at most `most`. Node 0 and the triangle of
// nodes 1 to 3; the edge of nodes 0 and 1 and that of nodes 2 and 3.
double nodeTriangleTravel(const FourNodes& x, const FourNodes& u, const Keep& keep, double most = 1);
double edgeEdgeTravel(const FourNodes& x, const FourNodes& u, const Keep& keep, double most = 1);

}  // namespace corpuscle::contact
