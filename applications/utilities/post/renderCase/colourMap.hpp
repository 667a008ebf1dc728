// Colour maps that can be read without telling red from green. Each is a few anchors, interpolated linearly.
#pragma once
#include <algorithm>
#include <array>
#include <span>

namespace corpuscle {

using Colour = std::array<double, 3>;

// Sequential, perceptually even: viridis (Smith and van der Walt, 2015; public domain CC0).
inline constexpr std::array<Colour, 9> viridis{{{0.267, 0.005, 0.329},
                                                {0.279, 0.175, 0.483},
                                                {0.230, 0.322, 0.546},
                                                {0.173, 0.449, 0.558},
                                                {0.128, 0.567, 0.551},
                                                {0.158, 0.684, 0.502},
                                                {0.369, 0.789, 0.383},
                                                {0.678, 0.864, 0.190},
                                                {0.993, 0.906, 0.144}}};

// Diverging from zero: cool to warm (Moreland, ISVC 2009).
inline constexpr std::array<Colour, 5> coolWarm{{{0.230, 0.299, 0.754},
                                                 {0.552, 0.690, 0.996},
                                                 {0.865, 0.865, 0.865},
                                                 {0.958, 0.604, 0.483},
                                                 {0.706, 0.016, 0.150}}};

// Unordered kinds; the first colour, grey, is for "none" (Okabe and Ito, 2008).
inline constexpr std::array<Colour, 7> kinds{{{0.82, 0.82, 0.82},
                                              {0.835, 0.369, 0.000},
                                              {0.000, 0.447, 0.698},
                                              {0.000, 0.620, 0.451},
                                              {0.902, 0.624, 0.000},
                                              {0.800, 0.475, 0.655},
                                              {0.337, 0.706, 0.914}}};

// The colour at a position in [0, 1] along the map.
inline Colour colourAt(std::span<const Colour> anchors, double place) {
    const double at = place * static_cast<double>(anchors.size() - 1);
    const auto i = std::min(static_cast<std::size_t>(std::max(at, 0.0)), anchors.size() - 2);
    const double w = at - static_cast<double>(i);
    Colour colour{};
    for (std::size_t c = 0; c < 3; ++c) colour[c] = (1 - w) * anchors[i][c] + w * anchors[i + 1][c];
    return colour;
}

// The colour of a kind: 0 is none; after the last kind the colours repeat.
inline Colour colourOfKind(int kind) { return kinds[kind <= 0 ? 0 : 1 + (kind - 1) % (kinds.size() - 1)]; }

}  // namespace corpuscle
