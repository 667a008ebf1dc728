#include "core/blockAverage.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <vector>

namespace corpuscle {

namespace {

constexpr std::size_t fewestBlocks = 8, fewestToSee = 4;
constexpr double longEnough = 3;  // b/g

double varianceOfMean(const std::vector<double>& blocks, double mean) {
    double square = 0;
    for (const double block : blocks) square += (block - mean) * (block - mean);
    const auto n = static_cast<double>(blocks.size());
    return square / (n * (n - 1));
}

}  // namespace

BlockAverage blockAverage(std::span<const double> values) {
    if (values.empty()) throw std::invalid_argument("a mean needs at least one value");
    BlockAverage found;
    const auto n = static_cast<double>(values.size());
    found.values = static_cast<long>(values.size());
    found.mean = std::accumulate(values.begin(), values.end(), 0.0) / n;
    found.independent = n;

    std::vector<double> variance;     // V_b of b = 1, 2, 4, ...
    std::vector<std::size_t> counts;  // n_b
    for (std::vector<double> blocks(values.begin(), values.end()); blocks.size() >= fewestToSee;) {
        variance.push_back(varianceOfMean(blocks, found.mean)), counts.push_back(blocks.size());
        const std::size_t odd = blocks.size() % 2;  // then the first block is left out
        for (std::size_t k = 0; k < blocks.size() / 2; ++k)
            blocks[k] = 0.5 * (blocks[2 * k + odd] + blocks[2 * k + 1 + odd]);
        blocks.resize(blocks.size() / 2);
    }
    if (variance.empty()) {
        if (values.size() > 1) found.error = std::sqrt(varianceOfMean({values.begin(), values.end()}, found.mean));
        return found;
    }
    double square = *std::max_element(variance.begin(), variance.end());
    double length = 1;  // b
    for (std::size_t level = 0; level + 1 < variance.size(); ++level, length *= 2) {
        if (length * variance[0] < longEnough * variance[level]) continue;
        found.isReliable = counts[level + 1] >= fewestBlocks;
        if (found.isReliable) square = std::max(2 * variance[level + 1] - variance[level], 0.5 * variance[level]);
        break;
    }
    found.error = std::sqrt(square);
    if (square > 0) found.independent = std::min(n, n * variance[0] / square);
    return found;
}

}  // namespace corpuscle
