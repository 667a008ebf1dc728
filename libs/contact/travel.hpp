// How far four nodes may move along straight lines before two pieces of surface meet: additive continuous collision
// detection (Li, Kaufman, Jiang 2021).
//
// The distance d(T) of the pieces after the fraction T of the displacements decreases no faster than at the rate
//     l = largest displacement of the first piece + largest of the second,   each less the mean of the four nodes,
// so that from T a further fraction (d(T) - least)/l is free. With any unit vector n, the further fraction up to which
// n.(x_i - x_j) >= least holds for all nodes i of one piece and j of the other is also free; with n the normal at T,
// this fraction is large for pieces that slide past each other. The larger of the two is added repeatedly until little
// is left; each partial sum is itself safe, and the number of terms is bounded.
//     least = thickness + share (d(0) - thickness)     the distance that is kept
// For pieces that start nearer than the thickness (triangles squeezed flat), the thickness is taken as 0: they are only
// kept from meeting.
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

// Fraction of the displacements `u` [m] from x that is known to be free, at most `most`. nodeTriangleTravel: node 0 and
// the triangle of nodes 1 to 3. edgeEdgeTravel: the edge of nodes 0 and 1, and that of nodes 2 and 3.
double nodeTriangleTravel(const FourNodes& x, const FourNodes& u, const Keep& keep, double most = 1);
double edgeEdgeTravel(const FourNodes& x, const FourNodes& u, const Keep& keep, double most = 1);

}  // namespace corpuscle::contact
