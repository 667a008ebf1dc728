// Start vector of power iterations that does not depend on the number of ranks: signs from a hash of particle and axis.
#pragma once
#include <cstdint>

namespace corpuscle::sph {

inline double randomSign(std::int64_t id, int axis) {
    auto h = (static_cast<std::uint64_t>(id) * 3 + static_cast<std::uint64_t>(axis)) * 0x9E3779B97F4A7C15ull;
    h = (h ^ (h >> 29)) * 0xBF58476D1CE4E5B9ull;
    return (h >> 40) % 2 ? 1.0 : -1.0;
}

}  // namespace corpuscle::sph
