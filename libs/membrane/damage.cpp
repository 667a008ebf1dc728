#include "membrane/damage.hpp"

#include <algorithm>
#include <cmath>

#include "core/registry.hpp"
#include "membrane/diagnostics.hpp"

namespace corpuscle::membrane {

double Damage::rate(double strain) const {
    return strain > onset ? std::pow((strain - onset) / scale, exponent) / time : 0;
}

double Damage::after(const RuptureStep& now, int triangle) const {
    return now.damage[triangle] + now.dt * rate(arealStrain(now.network, triangle, now.x));
}

void Damage::gather(const RuptureStep& now, std::span<double> damage) const {
    for (const int t : now.network.wholeTriangles()) damage[t] = std::min(after(now, t), 1.0);
}

std::vector<BrokenBond> Damage::select(const RuptureStep& now) const {
    std::vector<int> beyond;
    for (const int t : now.network.wholeTriangles())
        if (now.damage[t] >= 1) beyond.push_back(t);
    return mostStretchedBonds(now.network, beyond, now.x);
}

std::vector<double> Damage::excesses(const RuptureStep& now) const {
    std::vector<double> all;
    for (const int t : now.network.wholeTriangles()) all.push_back(after(now, t) - 1);
    return all;
}

const Schema<Damage>& Damage::schema() {
    static const Schema<Damage> s =
        Schema<Damage>("damage",
                       "a triangle gathers damage while its areal strain is beyond the onset, and breaks at 1: "
                       "dD/dt = ((strain - onset)/scale)^exponent/time")
            .quantity("onset", &Damage::onset, unit::none, "areal strain A/A0 - 1 up to which nothing is damaged",
                      {.fallback = "0", .range = nonNegative})
            .quantity("scale", &Damage::scale, unit::none,
                      "areal strain beyond the onset under which a triangle lasts for 'time'", {.range = positive})
            .quantity("time", &Damage::time, unit::second, "time to failure at onset + scale", {.range = positive})
            .quantity("exponent", &Damage::exponent, unit::none, "power of the strain beyond the onset",
                      {.fallback = "1", .range = positive});
    return s;
}

CORPUSCLE_REGISTER(RuptureLaw, Damage, "damage", "the sheet breaks where damage by areal strain over time is full");

}  // namespace corpuscle::membrane
