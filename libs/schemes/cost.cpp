#include "schemes/cost.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "schemes/choice.hpp"

namespace corpuscle::schemes {

namespace {

// Steps and passes of the whole run. If the flow settles, steps grow at first, and are then as long as at the end.
void countPasses(const CaseFacts& facts, const NumericsSettings& numerics, IntegratorCost& cost) {
    const Scheme& scheme = *numerics.scheme;
    const auto stepAt = [&](double t) { return scheme.limits(facts, numerics, t).binding().seconds; };
    const double end = facts.duration, last = stepAt(end);
    double t = 0, dt = stepAt(0);
    while (t < end && dt < last) {
        cost.steps += 1, cost.passes += scheme.passes(facts, numerics, dt);
        t += dt;
        dt = stepAt(t);
    }
    const double rest = std::max(0.0, end - t) / last;
    cost.steps += rest, cost.passes += rest * scheme.passes(facts, numerics, last);
}

}  // namespace

std::vector<IntegratorCost> predictCosts(const NumericsSettings& written, const CaseFacts& facts) {
    std::vector<IntegratorCost> costs;
    for (const std::string& name : Registry<Scheme>::instance().names()) {
        IntegratorCost& cost = costs.emplace_back();
        cost.name = name;
        cost.whyNot = whyNot(written, facts, name);
        const NumericsSettings named = settled(written, facts, name);
        cost.limits = named.scheme->limits(facts, named, 0.5 * facts.duration);
        countPasses(facts, named, cost);
        cost.cost = cost.passes / facts.duration / (facts.flow.shearRate > 0 ? facts.flow.shearRate : 1);
        if (cost.whyNot.empty()) cost.whyNot = named.scheme->unfit(facts, named);
    }
    return costs;
}

std::string cheapest(const std::vector<IntegratorCost>& costs) {
    const IntegratorCost* least = nullptr;
    for (const IntegratorCost& cost : costs)
        if (cost.whyNot.empty() && (!least || cost.cost < least->cost)) least = &cost;
    return least ? least->name : "";
}

std::vector<std::string> costHeader(const CaseFacts& facts) {
    return {"integrator",
            "predicted step",
            "limited by",
            "passes a step",
            facts.flow.shearRate > 0 ? "passes per unit of strain" : "passes per second",
            ""};
}

std::vector<std::vector<std::string>> costRows(const std::vector<IntegratorCost>& costs, const std::string& integrator,
                                               bool isChosen) {
    std::vector<std::vector<std::string>> rows;
    for (const IntegratorCost& cost : costs) {
        std::string note = cost.name != integrator ? "" : isChosen ? "chosen automatically" : "chosen by the case";
        if (!note.empty() && !cost.whyNot.empty()) note += ": ";
        note += cost.whyNot;
        rows.push_back({cost.name, formatQuantity(cost.step().seconds, unit::second), cost.step().name,
                        fmt::format("{:.3g}", cost.passes / cost.steps), fmt::format("{:.3g}", cost.cost), note});
    }
    return rows;
}

}  // namespace corpuscle::schemes
