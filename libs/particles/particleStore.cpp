#include "particles/particleStore.hpp"

#include <type_traits>

namespace corpuscle::particles {

void ParticleStore::reorder(const std::vector<int>& order) {
    const std::size_t n = order.size();
    const auto sort = [&](auto& array, auto& sorted) {
        sorted.resize(n);
        for (std::size_t i = 0; i < n; ++i) sorted[i] = array[static_cast<std::size_t>(order[i])];
        array.swap(sorted);
    };
    forEachField([&](std::string_view, auto& array) {
        if constexpr (std::is_same_v<std::remove_reference_t<decltype(array)>, RealArray>)
            sort(array, spareReals_);
        else
            sort(array, spareIntegers_);
    });
}

std::size_t ParticleStore::bytesPerParticle() const {
    std::size_t bytes = 0;
    forEachField([&](std::string_view, const auto& array) { bytes += sizeof(array[0]); });
    return bytes;
}

}  // namespace corpuscle::particles
