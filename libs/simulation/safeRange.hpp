// Where the integrators are known to be safe, from the stability map (docs/stability.md, benchmarks/stability): the
// table safeRange.csv, built into the library.
//
// axis                  | value
// a group of groups.hpp | Ca, Re, lambda, E_b, a/dx ..., of every cell
// stiffEdge             | edge of the mesh over dx, of cells with Ca <= 0.005
// implicit.step         | strain of an implicit step; with other integrators none
// implicit.tolerance    | of the implicit step's solver; with other integrators none
// bulkModulus           | that of the case over what `soundSpeed: auto` stands for
// shifting.coefficient  | none without shifting
// fill.jitter           | in spacings
// integrator: implicit, velocityVerlet, rkl2.
#pragma once
#include <string>
#include <vector>

#include "simulation/case.hpp"

namespace corpuscle::simulation {

struct SafeRange {
    std::string axis, integrator;
    double low = 0, high = 0;
    std::string outside;  // what happens there
};

// Of a table as safeRange.csv has it, a header and five columns, the last one in quotes or not, lines that open with #
// left out. Throws std::invalid_argument with the line where it is not one.
std::vector<SafeRange> parseSafeRanges(const std::string& table);

const std::vector<SafeRange>& safeRanges();

// What of the case lies outside, each in a sentence; empty without cells, for which there is no map.
std::vector<std::string> outsideSafeRanges(const Case& input, const std::vector<SafeRange>& ranges = safeRanges());

}  // namespace corpuscle::simulation
