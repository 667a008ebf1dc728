// A micropipette along z that presses on a membrane and aspirates it: two energies in addition to the membrane's own,
// which the protocol aspiration (aspiration.hpp) applies as loads.
//
// The glass is a tube of inner radius R and wall thickness w with a round end and its mouth at z_m. With rho the
// distance from the axis, it occupies rho - R = 0 .. w, above z_m. A point at the distance d from the middle of the
// wall (rho = R + w/2, z >= z_m + w/2) lies at the depth g = w/2 - d in the glass, which exerts a pressure without
// friction on it:
//     p(g) = p0 (g/c)^2 for g > 0,     E = sum A_i p0 g_i^3/(3 c^2)
// summed over 16 points of each triangle, with A_i their shares of its stress-free area, so that the glass does not
// slip between nodes; for this the wall must not be thinner than an edge is long.
// The suction P acts on the side of the membrane that faces the pipette (triangles whose normals have z > 0 at the
// start): within the bore and, with a factor s that falls smoothly from 1 to 0, from rho = R to the middle of the wall,
// where the membrane seals the pipette:
//     E = -P sum_t A_t,z F(x_t),   F = s(rho) (z - z_m),   s = 1 - 3 h^2 + 2 h^3,   h = (rho - R)/(w/2) within 0 .. 1
// with x_t the centroid of the triangle and A_t its area vector. The sum is the volume that the membrane takes up in
// the tube (divergence theorem).
// symbol | meaning                                      | unit
// R, w   | inner radius, thickness of the wall          | m
// z_m    | height of the mouth                          | m
// p0, c  | pressure on a point at the depth c in glass   | Pa, m
#pragma once
#include <memory>

#include "membrane/network.hpp"
#include "membrane/term.hpp"

namespace corpuscle::membrane {

struct Pipette {
    double radius = 0, wall = 0, mouth = 0;  // R, w, z_m, m
    double contactPressure = 0, depth = 0;   // p0, c

    double middle() const { return radius + 0.5 * wall; }
    // Lowest mouth that touches none of the nodes that lie under the wall.
    static double touching(std::span<const Vec3> x, double radius, double wall);
    bool isInside(const Vec3& x) const { return x.head<2>().norm() < middle(); }
    // Whether the edge of the mesh from a to b passes through the wall, above its round end.
    bool crosses(const Vec3& a, const Vec3& b) const {
        return isInside(a) != isInside(b) && std::min(a[2], b[2]) > mouth + wall;
    }
};

std::shared_ptr<const Term> pipetteContact(const Network& network, const Pipette& pipette);
// The stiffness is the exact one in every case: making an element semi-definite would remove the load's own part.
std::shared_ptr<const Term> pipetteSuction(const Network& network, std::span<const Vec3> initial,
                                           const Pipette& pipette, double pressure);

}  // namespace corpuscle::membrane
