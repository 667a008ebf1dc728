#include "coupling/densityBalance.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace corpuscle::coupling {

using particles::Kind;

namespace {
// Of one region, outside first.
struct Region {
    double space = 0;  // sum m/rho of its fluid particles and its share of nodes
    double mass = 0;   // of the same
};
static_assert(sizeof(Region) == 2 * sizeof(double));
}  // namespace

void DensityBalance::apply(particles::ParticleSystem& system, const std::vector<Cell>& cells) {
    particles::ParticleStore& s = system.store();
    const auto n = static_cast<std::size_t>(system.owned());
    std::vector<double> volume(cells.size(), -1);  // every holder has the same
    for (std::size_t c = 0; c < cells.size(); ++c)
        if (cells[c].held) volume[c] = cells[c].membrane.network().isOpen() ? 0 : cells[c].membrane.volume();
    MPI_Allreduce(MPI_IN_PLACE, volume.data(), static_cast<int>(volume.size()), MPI_DOUBLE, MPI_MAX, system.comm());
    std::vector<char> closed(cells.size());
    std::transform(volume.begin(), volume.end(), closed.begin(), [](double v) { return v > 0; });

    // Region 0 is the outside and all open cells. A node counts half to either side of its membrane.
    const auto regionOfCell = [&](std::size_t number) { return number > 0 && closed[number - 1] ? number : 0; };
    const auto regionOf = [&](std::size_t i) {
        return regionOfCell(s.optional().side ? static_cast<std::size_t>(s.side[i]) : 0);
    };
    const auto cellOfNode = [&](std::int64_t node) {
        const auto next = std::upper_bound(cells.begin(), cells.end(), node,
                                           [](std::int64_t n, const Cell& c) { return n < c.firstNode; });
        return static_cast<std::size_t>(next - cells.begin());
    };
    const auto sidesOf = [&](std::size_t i) {  // the two regions of a particle, the same one for fluid
        const bool node = s.kindOf(i) == Kind::membrane;
        return node ? std::array{regionOfCell(cellOfNode(s.node[i])), std::size_t(0)}
                    : std::array{regionOf(i), regionOf(i)};
    };
    const auto massOf = [&](std::size_t i) { return s.optional().mass ? s.mass[i] : mass_; };
    std::vector<Region> regions(cells.size() + 1);
    for (std::size_t i = 0; i < n; ++i) {
        if (particles::isBoundary(s.kindOf(i))) continue;
        for (const std::size_t r : sidesOf(i)) {
            regions[r].space += 0.5 * massOf(i) / s.density[i];
            regions[r].mass += 0.5 * massOf(i);
        }
    }
    MPI_Allreduce(MPI_IN_PLACE, regions.data(), static_cast<int>(2 * regions.size()), MPI_DOUBLE, MPI_SUM,
                  system.comm());

    double outside = fluidVolume_, outsideAtStart = fluidVolume_;
    for (std::size_t c = 0; c < cells.size(); ++c)
        if (closed[c]) outside -= volume[c], outsideAtStart -= cells[c].initialVolume;  // rigid bodies inside included
    std::vector<double> factor(regions.size(), 1.0);
    for (std::size_t r = 0; r < regions.size(); ++r) {
        if (regions[r].space <= 0 || (r > 0 && !closed[r - 1])) continue;
        const double solid = r == 0 ? 0 : cells[r - 1].solidVolume;
        const double change =
            r == 0 ? outside / outsideAtStart : (volume[r - 1] - solid) / (cells[r - 1].initialVolume - solid);
        factor[r] = regions[r].space / (change * regions[r].mass / density_);
        largest_ = std::max(largest_, std::abs(factor[r] - 1));
    }
    for (std::size_t i = 0; i < n; ++i) {
        if (particles::isBoundary(s.kindOf(i))) continue;
        const auto [one, other] = sidesOf(i);
        s.density[i] *= 0.5 * (factor[one] + factor[other]);
    }
}

}  // namespace corpuscle::coupling
