#include "implicit/stepControl.hpp"

#include <algorithm>
#include <cmath>

#include "core/communicator.hpp"

namespace corpuscle::implicit {

using coupling::Immersed;

namespace {

// Bounds of the change from step to step. The stiffest displacements of membranes halve in a step and change their sign
// (TimeDifference::leadShare). If the steps were halved as well, the velocities of these displacements would not decay,
// and steps would shrink without end.
constexpr double most = 2, least = 0.2, leastWithMembranes = 0.7;

bool isStrict(const ImplicitSettings& settings) { return settings.error < ImplicitSettings{}.error; }

}  // namespace

double toleranceShare(const ImplicitSettings& settings, double rate, double planned) {
    constexpr double leastShare = 0.01;
    const double length = planned * rate / settings.step;
    return std::clamp(length * length, leastShare, 1.0);
}

double differenceOfCells(const Immersed& immersed, MPI_Comm comm, const Immersed::Vectors& a,
                         const Immersed::Vectors& b) {
    constexpr double shareOfWorst = 0.25;
    const Communicator ranks(comm);
    const coupling::NodeLayout& layout = immersed.layout();
    double worst2 = 0, sum2 = 0;
    for (std::size_t c = 0; c < layout.cells(); ++c) {
        if (!immersed.cells()[c].isOwnedBy(ranks.rank())) continue;
        const double radius = radiusOfSphere(immersed.cells()[c].initialVolume);
        double largest2 = 0;
        for (std::size_t m = layout.first(c); m < layout.last(c); ++m)
            largest2 = std::max(largest2, (a[m] - b[m]).squaredNorm() / (radius * radius));
        worst2 = std::max(worst2, largest2), sum2 += largest2;
    }
    const auto cells = static_cast<double>(immersed.cells().count());
    return std::max(std::sqrt(ranks.sum(sum2) / cells), shareOfWorst * std::sqrt(ranks.max(worst2)));
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
        allowed.error = std::clamp(last.dt * (last.backwardEuler ? ratio : std::sqrt(ratio)),
                                   (last.hasMembranes ? leastWithMembranes : least) * last.dt, most * last.planned);
    } else if (isStrict(settings)) {
        allowed.error = most * last.planned;
    }
    return allowed;
}

}  // namespace corpuscle::implicit
