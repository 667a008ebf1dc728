// What the observer rupture knows of each cell, and how it says it.
#pragma once
#include <limits>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "observers/interior.hpp"

namespace corpuscle::observers {

// That of the most stretched bond of the step at which the first broke; nan before.
struct FirstBreak {
    static constexpr double none = std::numeric_limits<double>::quiet_NaN();
    static constexpr std::size_t count = 9;  // numbers
    double time = none, strain = none, bond = none;
    Vec3 place = Vec3::Constant(none), place0 = Vec3::Constant(none);  // middle of the bond, then and stress-free [m]

    bool happened() const { return time == time; }
    std::vector<double> numbers() const;
    static FirstBreak of(const double* numbers);
};

// What a cell's membrane has lost, and the most that is left of it bears.
struct Losses {
    double bonds, triangles, holes, holeArea, holeRestArea;  // areas in m^2
    double bondStrain, arealStrain, tension, damage;         // tension in N/m
};

// Of each cell, on every rank. Collective.
std::vector<Losses> losses(const coupling::Scene& scene);

// Of one cell, for run.json and for the log.
nlohmann::ordered_json figures(const Interior& in, const Losses& lost, const FirstBreak& first);
std::string sentence(const Interior& in, const Losses& lost, const FirstBreak& first);

}  // namespace corpuscle::observers
