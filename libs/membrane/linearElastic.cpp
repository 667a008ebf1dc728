#include "membrane/linearElastic.hpp"

#include <fmt/format.h>

#include "core/registry.hpp"

namespace corpuscle::membrane {

const Schema<LinearElastic>& LinearElastic::schema() {
    static const Schema<LinearElastic> s =
        Schema<LinearElastic>("linear sheet",
                              "Hooke's law of the plane in Green's strain, for strains of some per cent")
            .quantity("Gs", &LinearElastic::Gs, unit::newtonPerMetre, "shear modulus", {.range = positive})
            .quantity("Ks", &LinearElastic::Ks, unit::newtonPerMetre, "area modulus", {.range = positive});
    return s;
}

std::string LinearElastic::constants() const { return fmt::format("Gs {:.4g} N/m, Ks {:.4g} N/m", Gs, Ks); }

CORPUSCLE_REGISTER(TriangleLaw, LinearElastic, "linear", "Hooke's law of the plane for small strain");

}  // namespace corpuscle::membrane
