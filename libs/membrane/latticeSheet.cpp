#include "membrane/latticeSheet.hpp"

#include <fmt/format.h>

#include "core/registry.hpp"

namespace corpuscle::membrane {

const Schema<LatticeSheet>& LatticeSheet::schema() {
    static const Schema<LatticeSheet> s =
        Schema<LatticeSheet>("lattice sheet",
                             "continuum of a hexagonal lattice of harmonic bonds, independent of the mesh; Ks = 2 Gs")
            .quantity("Gs", &LatticeSheet::Gs, unit::newtonPerMetre, "shear modulus", {.range = positive})
            .quantity("k", &LatticeSheet::k, unit::newtonPerMetre,
                      "spring constant of the lattice's bonds, Gs = sqrt(3)/4 k", {.range = positive})
            .exactlyOneOf({"Gs", "k"});
    return s;
}

std::string LatticeSheet::constants() const {
    return fmt::format("Gs {:.4g} N/m, k {:.4g} N/m", shearModulus(), shearModulus() / 0.4330127018922193);
}

CORPUSCLE_REGISTER(TriangleLaw, LatticeSheet, "lattice", "continuum of the hexagonal lattice of harmonic bonds");

}  // namespace corpuscle::membrane
