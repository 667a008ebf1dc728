// Enclosed volume held near a target
//     E = modulus/2 (V - V_0)^2/V_0
// symbol        | meaning                                                                                        | unit
// modulus       | K_v; the pressure difference is modulus (1 - V/V_0), inside less outside                       | Pa
// V_0           | key rest: the volume wanted; or by reducedVolume; the stress-free mesh's own when neither      | m^3
// reducedVolume | nu = V_0/(4 pi/3 R^3), 4 pi R^2 = A_0: volume over that of the sphere with the rest area;      | -
//               | 1 is a sphere. A_0 is `area: {rest}` where given, else the stress-free mesh's area.            |
// A cell with a fluid inside has its volume from the fluid; this is for membranes without one, and against slow drift.
// Open cells: refused on a mesh with a border; let go for good when the first triangle breaks.
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

// slope d2V/dx2 of a closed surface, by edge (a, b) with c left and d right of a->b: d2V/dx_a dx_b = [(d - c)/6]x, the
// matrix of the cross product, so that an element does not depend on where the volume's tetrahedra meet.
void addVolumeCurvature(const Network& network, std::span<const Vec3> x, double slope, Definiteness definiteness,
                        Stiffness& stiffness);

}  // namespace corpuscle::membrane
