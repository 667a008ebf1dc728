// Membranes of one law, for the tests.
#pragma once
#include "membrane/membraneSettings.hpp"

namespace corpuscle::membrane::testing {

template <class Law>
MembraneSettings only(const Law& law) {
    MembraneSettings settings;
    if constexpr (std::is_base_of_v<BondLaw, Law>) {
        settings.bonds = {"bonds", std::make_shared<Law>(law)};
    } else {
        settings.triangles = {"triangles", std::make_shared<Law>(law)};
    }
    return settings;
}

}  // namespace corpuscle::membrane::testing
