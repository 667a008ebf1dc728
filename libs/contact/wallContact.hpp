// Contact of nodes with walls: the same law as between surfaces, applied to the distance of each node,
//     E = sum over nodes and walls of a_v psi(d - thickness)
// symbol | meaning                                       | unit
// d      | distance of the node from the wall            | m
// a_v    | area of the node in the reference state       | m^2
// Meshes are fine compared with the radius of curvature of a wall, so that nodes represent the surface.
#pragma once
#include <span>
#include <vector>

#include "boundary/walls.hpp"
#include "contact/contactLaw.hpp"
#include "contact/surface.hpp"

namespace corpuscle::contact {

struct AtWall {
    std::size_t node;  // number of the node in the surface
    int wall;          // number of the wall
    Vec3 normal;       // into the fluid
    double distance;   // m
    double area;       // m^2
    ContactLaw::Value psi;
    Vec3 force() const { return -area * psi.slope * normal; }  // on the node [N]
};

// Nodes of one surface, at x [m], that are within the range of the law: wall by wall, with ascending node numbers.
std::vector<AtWall> nodesAtWalls(const ContactLaw& law, const boundary::Walls& walls, const Surface& surface,
                                 std::span<const Vec3> x);

// Largest fraction in [0, 1] of the displacements u [m] from x, of the nodes of one surface, on which every gap to a
// wall stays at least `share` of its value at x. It is tested at a few points of the motion: walls are smooth on the
// scale of the displacements.
double freeOfWalls(const ContactLaw& law, const boundary::Walls& walls, std::span<const Vec3> x,
                   std::span<const Vec3> u, double share = 0.1);

}  // namespace corpuscle::contact
