#include "membrane/cohesive.hpp"

#include <algorithm>
#include <cmath>

#include "core/registry.hpp"
#include "membrane/gradientDamage.hpp"

namespace corpuscle::membrane {

namespace {
constexpr double leastShare = 0.01, resealedShare = 0.25, growth = 0.2;
}

void Cohesive::gather(const RuptureStep& now, std::span<double> damage) const {
    std::vector<double> energy(now.network.triangles().size(), 0.0);
    for (const auto& term : now.wholeTerms) term->addTensileEnergy(now.x, energy);
    if (resealing)
        for (double& d : damage) d *= std::exp(-now.dt / *resealing);
    GradientDamage(now.network, fractureEnergy, length).grow(energy, damage);
}

std::vector<double> Cohesive::shares(const Network& network, std::span<const double> damage) const {
    const bool isWhole = std::all_of(damage.begin(), damage.end(), [](double d) { return d == 0; });
    return isWhole ? std::vector<double>{} : keptShares(network, damage);
}

std::vector<BrokenBond> Cohesive::select(const RuptureStep& now) const {
    std::vector<BrokenBond> broken;
    if (!now.network.isWeakened()) return broken;
    for (const Bond& bond : now.network.bonds()) {
        if (now.network.shareOfBond(bond.number) >= leastShare) continue;
        const Vec3 &a = now.x[bond.node[0]], &b = now.x[bond.node[1]];
        broken.push_back({bond.number, (b - a).norm() / bond.rest, 0.5 * (a + b)});
    }
    return broken;
}

std::vector<int> Cohesive::resealed(const RuptureStep& now) const {
    std::vector<int> bonds;
    if (!resealing) return bonds;
    for (const Bond& bond : now.network.allBonds())
        if (!now.network.aliveBonds()[bond.number] && now.network.shareOfBond(bond.number) > resealedShare)
            bonds.push_back(bond.number);
    return bonds;
}

double Cohesive::tearLength(const Network& network, std::span<const double> damage) const {
    return GradientDamage(network, fractureEnergy, length).surfaceEnergy(damage) / fractureEnergy;
}

std::vector<double> Cohesive::excesses(const RuptureStep& now) const {
    std::vector<double> damage(now.damage.begin(), now.damage.end()), all;
    gather(now, damage);
    all.reserve(damage.size());
    for (std::size_t n = 0; n < damage.size(); ++n) all.push_back((damage[n] - now.damage[n]) / growth - 1);
    return all;
}

const Schema<Cohesive>& Cohesive::schema() {
    static const Schema<Cohesive> s =
        Schema<Cohesive>("cohesive", "the sheet weakens before it tears, and a tear costs an energy for each length")
            .quantity("fractureEnergy", &Cohesive::fractureEnergy, unit::newton,
                      "energy of a tear for each length; 1 J/m = 1 N", {.range = positive})
            .quantity("length", &Cohesive::length, unit::metre,
                      "length over which the sheet is weakened beside a tear; two mesh edges or more",
                      {.range = positive})
            .quantity("resealing", &Cohesive::resealing, unit::second,
                      "time in which a tear that has closed heals; without it, never", {.range = positive});
    return s;
}

CORPUSCLE_REGISTER(RuptureLaw, Cohesive, "cohesive", "a tear costs an energy for each length, on any mesh");

}  // namespace corpuscle::membrane
