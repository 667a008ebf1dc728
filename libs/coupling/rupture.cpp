#include "coupling/rupture.hpp"

#include <utility>

namespace corpuscle::coupling {

RuptureEvent rupture(membrane::Membrane& membrane, double dt, sph::Budget* budget,
                     const std::function<void()>& beforeBreaks) {
    const auto released = [&](auto&& change) {
        const double before = budget ? membrane.energy() : 0;
        auto result = change();
        if (budget) budget->total[sph::Budget::released] += before - membrane.energy();
        return result;
    };
    const auto find = [&] { return membrane.findBroken(dt); };
    std::vector<membrane::BrokenBond> broken = membrane.canWeaken() ? released(find) : find();
    if (broken.empty()) return {membrane.cell, {}};
    if (beforeBreaks) beforeBreaks();
    return {membrane.cell, released([&] { return membrane.breakBonds(std::move(broken)); })};
}

}  // namespace corpuscle::coupling
