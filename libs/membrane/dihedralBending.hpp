// Bending by dihedral springs across each edge
//     E = kb/2 sum (theta - theta0)^2,     kb = 2/sqrt(3) kappa
// symbol | meaning                                                | unit
// theta  | angle between the normals of the edge's two triangles  | rad
// theta0 | the same angle in the stress-free mesh                 | rad
// kb     | spring constant (key k)                                | J
// kappa  | bending modulus, E = kappa/2 Int (c1 + c2)^2 dA        | J
// Eb     | kappa/(Gs a^2)                                         | -
// Exactly one of Eb, kappa, k is given.
//
// Derivation of the relation between kb and kappa (Kantor and Nelson 1987, Seung and Nelson 1988; checked numerically
// on lattices wrapped on cylinder, sphere and saddle): on a hexagonal lattice with theta0 = 0
//     E/A = kappa/2 (c1 + c2)^2 + kappaG c1 c2,   kappa = sqrt(3)/2 kb,   kappaG = -4/3 kappa.
// The cylinder gives this kappa; the springs also produce the Gaussian term. A sphere therefore has the energy
// 8 pi kappa + 4 pi kappaG = 8 pi kappa/3 and not 8 pi kappa. On a closed surface of a regular lattice, the Gaussian
// part is a constant of the topology (no force); on an icosphere the energy is 3.4 % above the limit, and does not
// converge, because its edges are unequal. Codes that calibrate on the sphere have kb = sqrt(3) kappa. theta jumps by
// 2 pi where two triangles fold onto each other (theta = +-pi): the law does not cover a membrane that reaches this
// state.
#pragma once
#include <cmath>
#include <optional>

#include "core/settings.hpp"
#include "membrane/bendingLaw.hpp"
#include "membrane/elementTerm.hpp"
#include "membrane/harmonic.hpp"

namespace corpuscle::membrane {

struct DihedralBending : BendingLaw {
    std::optional<double> Eb;     // -
    std::optional<double> kappa;  // J
    std::optional<double> k;      // J

    static constexpr double springPerModulus() { return 1.1547005383792515; }  // 2/sqrt(3)

    double bendingModulus(const MembraneScale& scale) const override {
        return Eb ? *Eb * scale.shearModulus * scale.radius * scale.radius : kappa ? *kappa : *k / springPerModulus();
    }
    std::unique_ptr<Term> makeTerm(Network& network, const MembraneScale& scale) const override {
        network.useHinges();
        return std::make_unique<HingeTerm<Harmonic>>(network, Harmonic{springPerModulus() * bendingModulus(scale)});
    }
    static const Schema<DihedralBending>& schema();
};

}  // namespace corpuscle::membrane
