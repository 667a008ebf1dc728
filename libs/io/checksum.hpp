// Checksum of a distributed array, independent of how the array is divided into slabs:
//
//     S = sum_i  mix(bits(v_i) + (i + 1) phi)   mod 2^64
//
// i counts the numbers of the whole array, phi = 2^64/golden ratio, mix is the bijective finaliser of splitmix64
// (Steele, Lea, Flood, OOPSLA 2014). The parts of the ranks add up to S. A single changed number always changes S; two
// swapped ones change it with probability 1 - 2^-64.
#pragma once
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace corpuscle::io {

inline std::uint64_t mix(std::uint64_t z) {
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
    return z ^ (z >> 31);
}

// The part of the sum from `values`, the first of which has index `first` in the whole array.
template <class T>
std::uint64_t checksum(std::span<const T> values, std::uint64_t first) {
    std::uint64_t sum = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        sum += mix(std::bit_cast<std::uint64_t>(values[i]) + (first + i + 1) * 0x9e3779b97f4a7c15ull);
    }
    return sum;
}

// Checksum of a text, byte by byte.
inline std::uint64_t checksum(std::string_view text) {
    std::vector<std::uint64_t> letters;
    letters.reserve(text.size());
    for (const char c : text) letters.push_back(static_cast<unsigned char>(c));
    return checksum(std::span<const std::uint64_t>(letters), 0);
}

}  // namespace corpuscle::io
