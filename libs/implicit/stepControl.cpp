#include "implicit/stepControl.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace corpuscle::implicit {

using coupling::Cell;
using coupling::Immersed;

namespace {

constexpr double most = 2, least = 0.2;  // change from step to step

bool isStrict(const ImplicitSettings& settings) { return settings.error < ImplicitSettings{}.error; }

// Largest difference of two velocities, in radii of the nodes' cell.
double largestDifference(const std::vector<Cell>& cells, const Immersed::Vectors& a, const Immersed::Vectors& b) {
    double largest = 0;
    for (const Cell& cell : cells) {
        const double radius = std::cbrt(3 * cell.initialVolume / (4 * std::numbers::pi));
        const auto first = static_cast<std::size_t>(cell.firstNode);
        for (std::size_t m = first; m < first + static_cast<std::size_t>(cell.nodeCount()); ++m)
            largest = std::max(largest, (a[m] - b[m]).norm() / radius);
    }
    return largest;
}

}  // namespace

double largestBondRate(const std::vector<Cell>& cells, const Immersed::Vectors& velocity) {
    double largest = 0;
    for (const Cell& cell : cells) {
        const std::vector<Vec3>& x = cell.membrane.position;
        const auto first = static_cast<std::size_t>(cell.firstNode);
        for (const membrane::Bond& bond : cell.membrane.network().bonds()) {
            const auto a = static_cast<std::size_t>(bond.node[0]), b = static_cast<std::size_t>(bond.node[1]);
            const Vec3 d = x[b] - x[a];
            largest = std::max(largest, std::abs(d.dot(velocity[first + b] - velocity[first + a])) / d.squaredNorm());
        }
    }
    return largest;
}

AllowedSteps firstStep(const ImplicitSettings& settings, double rate) {
    if (!isStrict(settings)) return {};
    return {.error = settings.step / rate * std::sqrt(settings.error / ImplicitSettings{}.error)};
}

AllowedSteps allowedSteps(const ImplicitSettings& settings, const coupling::Scene& scene, double dt, bool backwardEuler,
                          const Immersed::Vectors& found, const Immersed::Vectors& extrapolated) {
    AllowedSteps allowed;
    if (const double rate = largestBondRate(scene.cells, found); rate > 0) allowed.bond = settings.bondStrain / rate;
    const double error =
        largestDifference(scene.cells, found, extrapolated) / ((backwardEuler ? 2 : 24) * scene.flow.rate);
    if (error > 0) {
        const double ratio = settings.error / error;
        allowed.error = dt * std::clamp(backwardEuler ? ratio : std::sqrt(ratio), least, most);
    } else if (isStrict(settings)) {
        allowed.error = most * dt;
    }
    return allowed;
}

}  // namespace corpuscle::implicit
