#include "membrane/neoHookean.hpp"

#include <fmt/format.h>

#include "core/registry.hpp"

namespace corpuscle::membrane {

const Schema<NeoHookean>& NeoHookean::schema() {
    static const Schema<NeoHookean> s =
        Schema<NeoHookean>("neo-Hookean sheet",
                           "thin layer of incompressible rubber; softens at large strain; Ks = 3 Gs")
            .quantity("Gs", &NeoHookean::Gs, unit::newtonPerMetre, "shear modulus", {.range = positive});
    return s;
}

std::string NeoHookean::constants() const { return fmt::format("Gs {:.4g} N/m", Gs); }

CORPUSCLE_REGISTER(TriangleLaw, NeoHookean, "neoHookean", "thin layer of incompressible rubber");

}  // namespace corpuscle::membrane
