#include "membrane/skalak.hpp"

#include <fmt/format.h>

#include "core/registry.hpp"

namespace corpuscle::membrane {

const Schema<Skalak>& Skalak::schema() {
    static const Schema<Skalak> s =
        Schema<Skalak>("Skalak sheet",
                       "sheet that resists shear by Gs and a change of area by C; stiffens at large strain")
            .quantity("Gs", &Skalak::Gs, unit::newtonPerMetre, "shear modulus", {.range = positive})
            .quantity("C", &Skalak::C, unit::none, "resistance to a change of area, Ks = (1 + 2 C) Gs",
                      {.range = {.low = -0.5, .lowOpen = true}})
            .quantity("Ks", &Skalak::Ks, unit::newtonPerMetre, "area modulus, in place of C", {.range = positive})
            .exactlyOneOf({"C", "Ks"});
    return s;
}

std::string Skalak::constants() const { return fmt::format("Gs {:.4g} N/m, C {:.4g}", Gs, areaNumber()); }

CORPUSCLE_REGISTER(TriangleLaw, Skalak, "skalak", "membrane of a red cell: shear and area resisted apart");

}  // namespace corpuscle::membrane
