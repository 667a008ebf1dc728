#include "membrane/modelName.hpp"

#include <fmt/format.h>

#include "core/registry.hpp"

namespace corpuscle::membrane {

const Schema<ModelName>& ModelName::schema() {
    static const Schema<ModelName> s =
        Schema<ModelName>("modelName", "spring along each edge")
            .quantity("k", &ModelName::k, unit::newtonPerMetre, "spring constant", {.range = positive})
            .boolean("scaled", &ModelName::scaled, scaledText, {.fallback = "false"});
    return s;
}

std::string ModelName::constants(double) const { return fmt::format("k {:.4g} N/m", k); }

CORPUSCLE_REGISTER(BondLaw, ModelName, "modelName", "spring along each edge");

}  // namespace corpuscle::membrane
