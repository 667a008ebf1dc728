// Mean of a correlated series, such as the values of a run in time, with its standard error by blocking.
//
// b = 1, 2, 4, ... neighbouring values are averaged into blocks. The variance of the mean estimated from these blocks,
//     V_b = s_b^2/(n_b - 1),      below its true value V by about V g/(2 b),      g = V_b/V_1
// grows with b as long as the blocks are correlated. The shortest blocks with b >= 3 g are long enough; the remaining
// bias is removed by extrapolation from these blocks and those of twice their length,
//     error^2 = 2 V_2b - V_b
// symbol     | meaning
// n_b, s_b^2 | number of blocks of b values; mean square deviation of their means from the mean of all values
// g          | statistical inefficiency: number of correlated values that count as one independent value
// Flyvbjerg, Petersen 1989, J. Chem. Phys. 91, 461; Vats, Flegal 2022, Biometrika 109, 735 (the difference).
#pragma once
#include <span>

namespace corpuscle {

struct BlockAverage {
    double mean = 0;
    double error = 0;        // standard error of the mean
    long values = 0;         // number of values in the series
    double independent = 0;  // number of independent values that would have the same error
    // True when blocks are long enough and at least 8 blocks of twice their length fit into the series. Otherwise the
    // error is a lower bound: the series is too short, or it drifts.
    bool isReliable = false;
};

// Throws std::invalid_argument for an empty series.
BlockAverage blockAverage(std::span<const double> values);

}  // namespace corpuscle
