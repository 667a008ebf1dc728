// The ranges in which the integrators are known to be safe, from the stability map (docs/stability.md,
// benchmarks/stability): the table safeRange.csv, built into the library.
//
// axis                  | value
// a group of groups.hpp | Ca, Re, lambda, E_b, a/dx ..., of every cell
// stiffEdge             | edge of the mesh over dx, of cells with Ca <= 0.005
// implicit.step         | strain of an implicit step; no value with other integrators
// implicit.tolerance    | of the implicit step's solver; no value with other integrators
// bulkModulus           | that of the case over that of `soundSpeed: auto`
// shifting.coefficient  | no value without shifting
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
    std::string outside;  // what happens outside the range
};

// Parses a table in the format of safeRange.csv: a header and five columns, the last one optionally in quotes; lines
// that begin with # are ignored. Throws std::invalid_argument with the faulty line.
std::vector<SafeRange> parseSafeRanges(const std::string& table);

const std::vector<SafeRange>& safeRanges();

// One sentence for each value of the case outside its range; empty without cells, since the map covers only cases with
// cells.
std::vector<std::string> outsideSafeRanges(const Case& input, const std::vector<SafeRange>& ranges = safeRanges());

}  // namespace corpuscle::simulation
