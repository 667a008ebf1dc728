#include "coupling/densityBalance.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/communicator.hpp"

namespace corpuscle::coupling {

using particles::Kind;

namespace {
// Sums over one region. Region 0 is the outside.
struct Region {
    double space = 0;  // sum m/rho of its fluid particles and its share of nodes [m^3]
    double mass = 0;   // sum m of the same [kg]
};
static_assert(sizeof(Region) == 2 * sizeof(double));
}  // namespace

void DensityBalance::apply(particles::ParticleSystem& system, const Cells& cells) {
    particles::ParticleStore& s = system.store();
    const Communicator ranks(system.comm());
    const auto n = static_cast<std::size_t>(system.owned());
    const std::size_t held = cells.heldCount();
    std::vector<double> volume(held, 0);  // of each held cell; 0: open
    for (std::size_t c = 0; c < held; ++c)
        if (!cells[c].membrane.network().isOpen()) volume[c] = cells[c].membrane.volume();

    // Region 0 is the outside with all open cells; then follow the cells that this rank holds. A rank that has a
    // particle in a closed cell holds that cell. A node counts half to either side of its membrane.
    const auto regionOfCell = [&](int number) -> std::size_t {
        const std::size_t index = number > 0 ? cells.indexOf(number) : Cells::notHeld;
        return index != Cells::notHeld && volume[index] > 0 ? index + 1 : 0;
    };
    const auto regionOf = [&](std::size_t i) {
        return regionOfCell(s.optional().side ? static_cast<int>(s.side[i]) : 0);
    };
    const auto sidesOf = [&](std::size_t i) {  // the two regions of a particle, the same one for fluid
        const bool node = s.kindOf(i) == Kind::membrane;
        return node ? std::array{regionOfCell(cells.cellOfNode(s.node[i]).first), std::size_t(0)}
                    : std::array{regionOf(i), regionOf(i)};
    };
    const auto massOf = [&](std::size_t i) { return s.optional().mass ? s.mass[i] : mass_; };
    std::vector<Region> regions(held + 1);
    for (std::size_t i = 0; i < n; ++i) {
        if (particles::isBoundary(s.kindOf(i))) continue;
        for (const std::size_t r : sidesOf(i)) {
            regions[r].space += 0.5 * massOf(i) / s.density[i];
            regions[r].mass += 0.5 * massOf(i);
        }
    }
    sums_.plan(
        cells, system.comm(), [](const Cell&) { return 1; }, std::vector<char>(held, 1));
    sums_.addUp({reinterpret_cast<double*>(regions.data() + 1), 2 * held}, 2);
    double closed = 0, closedAtStart = 0;  // volumes of the closed cells that this rank owns, with rigid bodies inside
    for (std::size_t c = 0; c < held; ++c)
        if (volume[c] > 0 && cells[c].isOwnedBy(ranks.rank()))
            closed += volume[c], closedAtStart += cells[c].initialVolume;
    const std::vector<double> all =
        ranks.sum(std::vector<double>{regions[0].space, regions[0].mass, closed, closedAtStart});
    regions[0] = {all[0], all[1]};

    std::vector<double> factor(regions.size(), 1.0);
    double largest = 0;
    for (std::size_t r = 0; r < regions.size(); ++r) {
        if (regions[r].space <= 0 || (r > 0 && !(volume[r - 1] > 0))) continue;
        const double solid = r == 0 ? 0 : cells[r - 1].solidVolume;
        const double change = r == 0 ? (fluidVolume_ - all[2]) / (fluidVolume_ - all[3])
                                     : (volume[r - 1] - solid) / (cells[r - 1].initialVolume - solid);
        factor[r] = regions[r].space / (change * regions[r].mass / density_);
        largest = std::max(largest, std::abs(factor[r] - 1));
    }
    largest_ = std::max(largest_, ranks.max(largest));
    for (std::size_t i = 0; i < n; ++i) {
        if (particles::isBoundary(s.kindOf(i))) continue;
        const auto [one, other] = sidesOf(i);
        s.density[i] *= 0.5 * (factor[one] + factor[other]);
    }
}

}  // namespace corpuscle::coupling
