// Flat sheets that tear, for the tests of cohesive rupture. Lengths are multiples of the law's length l = 1 m, tensions
// of Young's modulus E = 1 N/m; Poisson's ratio is 1/4.
#pragma once
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "membrane/equilibrium.hpp"
#include "ruptureCases.hpp"

namespace corpuscle::membrane::testing {

// Places from `begin` to `end`, about `step` apart within `fine` of `centre`; beyond, each distance is greater than the
// one before by the factor `growth`, away from the centre.
inline std::vector<double> graded(double begin, double end, double step, double centre, double fine, double growth) {
    const auto outwards = [&](double length) {
        std::vector<double> places{0};
        for (double d = step; places.back() < length - 0.5 * d; places.push_back(places.back() + d))
            if (places.back() > fine) d *= growth;
        for (double& x : places) x *= length > 0 ? length / places.back() : 1;
        return places;
    };
    const std::vector<double> before = outwards(centre - begin), after = outwards(end - centre);
    std::vector<double> places;
    for (std::size_t k = before.size(); k-- > 1;) places.push_back(centre - before[k]);
    for (const double x : after) places.push_back(centre + x);
    return places;
}

// A rectangle of rows of triangles along x between the places `columns`, with the rows at `rows` along y; every second
// row is shifted by half a column. Inner nodes are displaced at random by up to the fraction `jitter` of the least
// distance.
inline Mesh rectangle(const std::vector<double>& columns, const std::vector<double>& rows, double jitter,
                      unsigned seed) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t k = 1; k < columns.size(); ++k) least = std::min(least, columns[k] - columns[k - 1]);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> shift(-jitter * least, jitter * least);
    std::vector<double> shifted{columns.front()};
    for (std::size_t k = 1; k < columns.size(); ++k) shifted.push_back(0.5 * (columns[k - 1] + columns[k]));
    shifted.push_back(columns.back());
    Mesh mesh;
    std::vector<std::vector<int>> row(rows.size());
    for (std::size_t j = 0; j < rows.size(); ++j) {
        const std::vector<double>& places = j % 2 == 0 ? columns : shifted;
        for (std::size_t i = 0; i < places.size(); ++i) {
            Vec3 x(places[i], rows[j], 0);
            if (j > 0 && j + 1 < rows.size() && i > 0 && i + 1 < places.size())
                x += Vec3(shift(random), shift(random), 0);
            row[j].push_back(static_cast<int>(mesh.nodes.size()));
            mesh.nodes.push_back(x);
        }
    }
    for (std::size_t j = 0; j + 1 < rows.size(); ++j) {
        const auto& below = row[j];
        const auto& above = row[j + 1];
        std::size_t a = 0, b = 0;
        while (a + 1 < below.size() || b + 1 < above.size()) {
            // Along the side whose next node is nearer to the beginning of the row.
            const auto next = [&](const std::vector<int>& side, std::size_t k) {
                return k + 1 < side.size() ? mesh.nodes[side[k + 1]].x() : std::numeric_limits<double>::infinity();
            };
            if (next(below, a) <= next(above, b)) {
                mesh.triangles.push_back({below[a], below[a + 1], above[b]});
                ++a;
            } else {
                mesh.triangles.push_back({below[a], above[b + 1], above[b]});
                ++b;
            }
        }
    }
    return mesh;
}

inline MembraneSettings settingsOf(const std::string& laws) {
    Problems problems;
    auto settings = read<MembraneSettings>(parseValue(laws, "test", problems), problems);
    problems.throwIfAny();
    return settings;
}

inline std::string tearingSheet(double fractureEnergy, const std::string& more = "") {
    return "{triangles: {type: linear, Gs: 0.4 N/m, Ks: 0.66666666667 N/m}, rupture: {type: cohesive, "
           "fractureEnergy: " +
           fmt::format("{:.10g}", fractureEnergy) + " N, length: 1 m" + more + "}}";
}

// Finds equilibrium and damage in turns until the damage changes by less than `precision`; returns whether it did
// within `most` turns.
inline bool settle(
    Membrane& sheet, const Loads& loads, double forceScale, double precision, int most,
    const std::function<bool()>& stops = [] { return false; }) {
    for (int turn = 0; turn < most; ++turn) {
        findEquilibrium(sheet, loads, {1e-5, forceScale, 100});
        const std::vector<double> before = sheet.damage();
        sheet.breakBonds(sheet.findBroken(0));
        double change = 0;
        for (std::size_t n = 0; n < before.size(); ++n)
            change = std::max(change, std::abs(sheet.damage()[n] - before[n]));
        if (change < precision) return true;
        if (stops()) return false;
    }
    return false;
}

}  // namespace corpuscle::membrane::testing
