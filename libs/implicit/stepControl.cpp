#include "implicit/stepControl.hpp"

#include <algorithm>
#include <cmath>

namespace corpuscle::implicit {

using coupling::Immersed;

namespace {

constexpr double most = 2, least = 0.2;  // change from step to step

bool isStrict(const ImplicitSettings& settings) { return settings.error < ImplicitSettings{}.error; }

}  // namespace

double largestDifference(const Immersed& immersed, const Immersed::Vectors& a, const Immersed::Vectors& b) {
    double largest = 0;
    const coupling::NodeLayout& layout = immersed.layout();
    for (std::size_t c = 0; c < layout.cells(); ++c) {
        const double radius = radiusOfSphere(immersed.cells()[c].initialVolume);
        for (std::size_t m = layout.first(c); m < layout.last(c); ++m)
            largest = std::max(largest, (a[m] - b[m]).norm() / radius);
    }
    return largest;
}

double largestBondRate(const Immersed& immersed, const Immersed::Vectors& velocity) {
    double largest = 0;
    const coupling::NodeLayout& layout = immersed.layout();
    for (std::size_t c = 0; c < layout.cells(); ++c) {
        const membrane::Membrane& membrane = immersed.cells()[c].membrane;
        const std::vector<Vec3>& x = membrane.position;
        const std::size_t first = layout.first(c);
        for (const membrane::Bond& bond : membrane.network().bonds()) {
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

AllowedSteps allowedSteps(const ImplicitSettings& settings, double rate, const LastStep& last, double difference,
                          double bondRate) {
    AllowedSteps allowed;
    if (bondRate > 0) allowed.bond = settings.bondStrain / bondRate;
    const double error = difference / ((last.backwardEuler ? 2 : 24) * rate);
    if (error > 0) {
        const double ratio = settings.error / error;
        allowed.error =
            std::clamp(last.dt * (last.backwardEuler ? ratio : std::sqrt(ratio)), least * last.dt, most * last.planned);
    } else if (isStrict(settings)) {
        allowed.error = most * last.planned;
    }
    return allowed;
}

}  // namespace corpuscle::implicit
