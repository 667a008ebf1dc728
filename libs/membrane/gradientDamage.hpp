// Gradient damage of a sheet that tears: the form AT1 of the phase-field theory of fracture (Pham, Amor, Marigo and
// Maurini, Int. J. Damage Mech. 20:618, 2011; Tanne et al., J. Mech. Phys. Solids 110:80, 2018). Each node has a damage
// d, 0 where the sheet is whole and 1 where it is torn. A triangle keeps the share
//     s = mean over its nodes of (1 - d)^2
// of its energy psi A0 in tension. With the positions of the nodes fixed, the damage is that of the least energy
//     sum over triangles of s psi A0 + 3/8 integral of (G d/l + Gg l |grad d|^2) dA0,      d0 <= d <= 1
// where d0 is the damage before, so that damage never decreases. The second sum is the surface energy of the tear.
//
// symbol | meaning                                                                                           | unit
// G      | fracture energy for each length of tear                                                           | J/m
// l      | length over which the damage decreases: d = (1 - x/(2 l))^2 at the distance x from a straight tear | m
// psi    | energy in tension without the share, for each stress-free area                                    | J/m^2
// Gg     | G (1 - 3 h/(8 l))^2                                                                               | J/m
// h      | sqrt(sqrt(3) A0), height of an equilateral triangle of the same stress-free area                  | m
// A tear costs G for each length. On a mesh, d = 1 in a row of triangles, of height h, which alone costs
// 3/8 G h/l; both sides together cost sqrt(G Gg), the rest. The sheet is elastic up to
//     psi_c = 3 G/(16 l)
// which is the strength sqrt(2 E psi_c) of a sheet of Young's modulus E [N/m] under uniaxial tension. Around a slit of
// half-length c >> l the tear grows at Griffith's tension sqrt(E G/(pi c)).
//
// The mesh resolves l if its edges are at most l/2. Gradients are those of linear finite elements on the stress-free
// mesh (weights (cot a + cot b)/2 of its edges, none of them below 0), sources are lumped; the minimum is found by
// projected successive over-relaxation, to 1e-9 in d.
#pragma once
#include <span>
#include <vector>

#include "membrane/network.hpp"

namespace corpuscle::membrane {

class GradientDamage {
  public:
    // fractureEnergy: G [J/m]; length: l [m].
    GradientDamage(const Network& network, double fractureEnergy, double length);

    double onset() const { return onset_; }  // psi_c, J/m^2
    // Replaces the lower bounds d0 in `damage` (one value per node) by the damage d. tensileEnergy: psi A0 of each
    // triangle [J]; it may be infinite.
    void grow(std::span<const double> tensileEnergy, std::span<double> damage) const;
    double surfaceEnergy(std::span<const double> damage) const;  // J

  private:
    const Network& network_;
    double length_, onset_, gradient_;  // gradient_: 3 G l/8, J m/m
};

// s of each triangle.
std::vector<double> keptShares(const Network& network, std::span<const double> damage);

}  // namespace corpuscle::membrane
