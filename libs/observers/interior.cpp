#include "observers/interior.hpp"

#include "core/communicator.hpp"
#include "observers/cells.hpp"

namespace corpuscle::observers {

namespace {
constexpr std::size_t numbers = 5;
static_assert(sizeof(Interior) == numbers * sizeof(double));
}  // namespace

Interior total(const std::vector<Interior>& cells) {
    Interior all;
    for (const Interior& cell : cells) {
        all.mass += cell.mass;
        all.released += cell.released;
        all.releasedMass += cell.releasedMass;
        all.releasedVolume += cell.releasedVolume;
        all.leaked += cell.leaked;
    }
    return all;
}

std::vector<Interior> interiors(const coupling::Scene& scene) {
    const particles::ParticleStore& s = scene.store();
    const auto broken = ofEachCell(
        scene, 1, [](const coupling::Cell& cell, double* out) { *out = cell.membrane.network().wasOpen() ? 1 : 0; });
    const TrueSides sides(scene);
    std::vector<double> sums(numbers * scene.cells.count(), 0.0);
    for (std::size_t i = 0; i < s.size(); ++i) {
        if (s.kindOf(i) != particles::Kind::fluid || s.side[i] == 0) continue;
        const auto cell = static_cast<std::size_t>(s.side[i] - 1);
        double* const sum = sums.data() + numbers * cell;
        const double mass = scene.mass(i);
        sum[0] += mass;
        if (sides.inside(static_cast<int>(s.side[i]), s.position(i))) continue;
        if (broken[cell][0] > 0) {
            sum[1] += 1;
            sum[2] += mass;
            sum[3] += mass / s.density[i];
        } else
            sum[4] += 1;
    }
    sums = Communicator(scene.system->comm()).sum(std::move(sums));
    std::vector<Interior> all;
    for (const double* n = sums.data(); all.size() < scene.cells.count(); n += numbers)
        all.push_back({n[0], n[1], n[2], n[3], n[4]});
    return all;
}

}  // namespace corpuscle::observers
