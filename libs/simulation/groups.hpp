// The dimensionless numbers of a case, for checkCase, the head of a run's log, and run.json. For cells (or bodies)
// after the first, only numbers that differ are listed, with the name of the cell: "Ca (stiff)".
#pragma once
#include <string>
#include <vector>

#include "simulation/case.hpp"

namespace corpuscle::simulation {

struct Group {
    std::string name, value, text;
    double number;
    std::string symbol;  // the name without that of the cell or body: "Ca"
};
std::vector<Group> dimensionlessGroups(const Case& input);
double capillaryNumber(const Case& input, const CellSettings& cell);  // mu gammadot a/Gs, Gs of the closed form

}  // namespace corpuscle::simulation
