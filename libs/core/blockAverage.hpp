// Mean of a series whose values depend on each other, as those of a run in time do, with its standard error by blocks.
//
// Values are put together to blocks of b neighbours, b = 1, 2, 4, ... The variance of the mean by these blocks,
//     V_b = s_b^2/(n_b - 1),      short of its true value V by about V g/(2 b),      g = V_b/V_1
// grows with b as long as blocks depend on each other. The shortest blocks with b >= 3 g are long enough; what they and
// those of twice their length lack is taken out,
//     error^2 = 2 V_2b - V_b
// symbol     | meaning
// n_b, s_b^2 | number of blocks of b values; mean square deviation of their means from the mean of all
// g          | how many values count as one that is independent of the others
// Flyvbjerg, Petersen 1989, J. Chem. Phys. 91, 461; Vats, Flegal 2022, Biometrika 109, 735 (the difference).
#pragma once
#include <span>

namespace corpuscle {

struct BlockAverage {
    double mean = 0;
    double error = 0;        // standard error of the mean
    long values = 0;         // of the series
    double independent = 0;  // as many independent values would have the same error
    // Blocks are long enough, and at least 8 of twice their length fit into the series. Where not, the error is a lower
    // bound: the series is too short, or drifts.
    bool isReliable = false;
};

// Of at least one value. Throws std::invalid_argument for none.
BlockAverage blockAverage(std::span<const double> values);

}  // namespace corpuscle
