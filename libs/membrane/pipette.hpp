// A micropipette along z that presses on a membrane and sucks it in: two energies beside the membrane's own, loads of
// the protocol aspiration.
//
// The glass is a tube of inner radius R and wall w with a round end, its mouth at z_m; it lies within rho - R = 0 .. w,
// above z_m. With d the distance of a point to the middle of the wall (rho = R + w/2, z >= z_m + w/2), its depth in the
// glass is g = w/2 - d, and it takes a pressure without friction
//     p(g) = p0 (g/c)^2 for g > 0,     E = sum A_i p0 g_i^3/(3 c^2)
// summed over 16 points of each triangle, A_i their shares of its stress-free area, so that glass does not slip between
// nodes: the wall is to be no thinner than an edge.
// Suction P acts on the side of the membrane that faces the pipette (normals with z > 0 at the start), within the bore
// and, with s falling smoothly from 1 to 0, from rho = R to the middle of the wall, where the membrane seals it:
//     E = -P sum_t A_t,z F(x_t),   F = s(rho) (z - z_m),   s = 1 - 3 h^2 + 2 h^3,   h = (rho - R)/(w/2) within 0 .. 1
// x_t the triangle's middle, A_t its area vector: P times the volume that the membrane takes up in the tube (divergence
// theorem).
// symbol | meaning                                      | unit
// R, w   | inner radius, thickness of the wall          | m
// z_m    | height of the mouth                          | m
// p0, c  | pressure at which a point is c deep in glass  | Pa, m
#pragma once
#include <memory>

#include "membrane/network.hpp"
#include "membrane/term.hpp"

namespace corpuscle::membrane {

struct Pipette {
    double radius = 0, wall = 0, mouth = 0;  // R, w, z_m, m
    double contactPressure = 0, depth = 0;   // p0, c

    double middle() const { return radius + 0.5 * wall; }
    // Highest mouth that touches none of the nodes that lie under the wall.
    static double touching(std::span<const Vec3> x, double radius, double wall);
    bool isInside(const Vec3& x) const { return x.head<2>().norm() < middle(); }
    // An edge of the mesh through the wall, above its round end.
    bool crosses(const Vec3& a, const Vec3& b) const {
        return isInside(a) != isInside(b) && std::min(a[2], b[2]) > mouth + wall;
    }
};

std::shared_ptr<const Term> pipetteContact(const Network& network, const Pipette& pipette);
// The matrix is the exact one in either case: what makes an element semi-definite would take the load's own part away.
std::shared_ptr<const Term> pipetteSuction(const Network& network, std::span<const Vec3> initial,
                                           const Pipette& pipette, double pressure);

}  // namespace corpuscle::membrane
