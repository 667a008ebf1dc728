// Pores by tension: they take area in proportion to the isotropic tension beyond an onset,
//     phi_eq = min(1, max(0, T - T0)/K)
// symbol | meaning                                                                                    | unit
// T      | isotropic tension: half the trace of the tension of bonds and triangle law (diagnostics.hpp),
//        | and that of the area laws, k (A - A0)/A0 of the triangle and of the whole                  | N/m
// T0     | tension from which pores open (key onset)                                                  | N/m
// K      | tension beyond it at which all would be pores (key modulus): K_A of the bilayer if the
//        | pores are to take what the strain would                                                    | N/m
// Molecules are released at an isotropic tension of the order of 1e-6 N/m (Omori et al., Phys. Rev. E 86 (2012)
// 056321); in a pipette red cells lyse at about 10 mN/m.
#pragma once
#include "membrane/poreLaw.hpp"

namespace corpuscle::membrane {

struct PoreTension : PoreLaw {
    double onset = 0, modulus = 0;

    std::vector<double> atRest(const Network& network, const MembraneSettings& laws,
                               std::span<const Vec3> x) const override;
    static const Schema<PoreTension>& schema();
};

}  // namespace corpuscle::membrane
