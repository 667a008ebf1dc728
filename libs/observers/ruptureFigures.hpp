// The figures of the observer `rupture` for each cell, and their text.
#pragma once
#include <limits>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "observers/interior.hpp"

namespace corpuscle::observers {

// The first break of a cell: the most stretched bond of the step in which bonds broke for the first time; nan before.
struct FirstBreak {
    static constexpr double none = std::numeric_limits<double>::quiet_NaN();
    static constexpr std::size_t count = 9;  // numbers
    double time = none, strain = none, bond = none;
    Vec3 place = Vec3::Constant(none), place0 = Vec3::Constant(none);  // middle of the bond, then and stress-free [m]

    bool happened() const { return time == time; }
    std::vector<double> numbers() const;
    static FirstBreak of(const double* numbers);
};

// What the membrane of a cell has lost, and the largest strains, tension and damage of the rest.
struct Losses {
    double bonds, triangles, holes, holeArea, holeRestArea;  // areas in m^2
    double bondStrain, arealStrain, tension, damage;         // tension in N/m
    double tearLength;                                       // m
};

// For each cell, on every rank. Collective.
std::vector<Losses> losses(const coupling::Scene& scene);

// Of one cell, for run.json and for the log.
nlohmann::ordered_json figures(const Interior& in, const Losses& lost, const FirstBreak& first);
std::string sentence(const Interior& in, const Losses& lost, const FirstBreak& first);

}  // namespace corpuscle::observers
