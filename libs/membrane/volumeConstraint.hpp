// Penalty energy that holds the enclosed volume near a target
//     E = modulus/2 (V - V_0)^2/V_0
// symbol        | meaning                                                                                        | unit
// modulus       | K_v; the pressure difference is modulus (1 - V/V_0), inside minus outside                      | Pa
// V_0           | target volume (key rest or reducedVolume); default: the volume of the stress-free mesh         | m^3
// reducedVolume | nu = V_0/(4 pi/3 R^3), 4 pi R^2 = A_0: volume over that of the sphere with the rest area;      | -
//               | 1 is a sphere. A_0 is `area: {rest}` where given, else the stress-free mesh's area.            |
// In a cell that is filled with fluid, the fluid holds the volume; this law is for membranes without fluid, and against
// slow drift.
// Open cells: the law is rejected on a mesh with a border, and switched off permanently when the first triangle breaks.
#pragma once
#include <memory>
#include <optional>

#include "core/settings.hpp"
#include "membrane/network.hpp"
#include "membrane/term.hpp"

namespace corpuscle::membrane {

struct VolumeConstraint {
    double modulus = 0;                     // Pa
    std::optional<double> rest{};           // V_0, m^3
    std::optional<double> reducedVolume{};  // nu

    // `restArea` is A_0. Throws Failure(invalidCase) for a mesh with a border, and for one with normals inward.
    std::unique_ptr<Term> makeTerm(Network& network, double restArea) const;
    static const Schema<VolumeConstraint>& schema();
};

// Adds slope d2V/dx2 of a closed surface, edge by edge. For the edge (a, b) with the nodes c left and d right of a->b:
// d2V/dx_a dx_b = [(d - c)/6]x, the matrix of the cross product. In this form an element does not depend on the
// reference point of the volume's tetrahedra.
void addVolumeCurvature(const Network& network, std::span<const Vec3> x, double slope, Definiteness definiteness,
                        Stiffness& stiffness);

}  // namespace corpuscle::membrane
