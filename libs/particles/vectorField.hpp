// Fields of vectors have four numbers per entry, the fourth of them 0, so that the processor loads an entry at once.
#pragma once
#include <cstddef>

#include "core/vec.hpp"

namespace corpuscle::particles {

inline constexpr std::size_t fieldWidth = 4;

template <class Array>
Vec3 vectorAt(const Array& field, std::size_t entry) {
    const std::size_t at = fieldWidth * entry;
    return {static_cast<double>(field[at]), static_cast<double>(field[at + 1]), static_cast<double>(field[at + 2])};
}

template <class Array>
void setVector(Array& field, std::size_t entry, const Vec3& v) {
    using Real = typename Array::value_type;
    const std::size_t at = fieldWidth * entry;
    for (int k = 0; k < 3; ++k) field[at + static_cast<std::size_t>(k)] = static_cast<Real>(v[k]);
    field[at + 3] = Real(0);
}

}  // namespace corpuscle::particles
