#include "schemes/numericsSettings.hpp"

namespace corpuscle::schemes {

namespace {
std::vector<std::string> integrators() {
    std::vector<std::string> words{"automatic"};
    for (const std::string& name : Registry<Scheme>::instance().names()) words.push_back(name);
    return words;
}
}  // namespace

const Schema<NumericsSettings>& NumericsSettings::schema() {
    static const Schema<NumericsSettings> s =
        Schema<NumericsSettings>("numerics", "system/numerics.yaml: discretisation")
            .quantity("spacing", &NumericsSettings::spacing, unit::metre, "particle spacing dx", {.range = positive})
            .model("kernel", &NumericsSettings::kernel, "smoothing kernel", {.fallback = "wendlandC2"})
            .word("integrator", &NumericsSettings::integrator, integrators(),
                  "time integration; automatic: the cheapest by the prediction that checkCase prints",
                  {.fallback = "automatic"})
            .word("coupling", &NumericsSettings::coupling, {"automatic", "dualIdentity", "immersed"},
                  "coupling of fluid and membrane: nodes are particles, or lie in the fluid between them; automatic: "
                  "immersed; beside rigid bodies dualIdentity where the integrator is not implicit",
                  {.fallback = "automatic"})
            .word("operators", &NumericsSettings::operators, {"automatic", "plain", "corrected"},
                  "form of the pair operators: of the kernel alone, or exact for linear fields; automatic: corrected "
                  "with immersed membranes and with the implicit step",
                  {.fallback = "automatic"})
            .word("precision", &NumericsSettings::precision, {"double", "mixed"},
                  "of the terms between two particles: mixed works them out in float, about 1.5 times as fast; state "
                  "and sums are double",
                  {.fallback = "mixed"})
            .tableOr("none", "shifting", &NumericsSettings::shifting,
                     "particle shifting; where the key is absent, {coefficient: 1} with corrected operators",
                     {.fallback = "none"})
            .modelTables(&NumericsSettings::tables, AtRestart::noted)
            .length("skin", &NumericsSettings::skin, "reserve of the neighbour list beyond the support",
                    {.fallback = "0.3 dx", .range = positive})
            .integer("guard", &NumericsSettings::guard, "steps between two looks of the leakage guard, 0 for none",
                     {.fallback = "10", .range = nonNegative})
            .integerOr(
                "auto", "densityBalance", &NumericsSettings::densityBalance,
                "steps between two balances of density against the volume of closed cells, 0 for none; auto: 10, and "
                "1 with the implicit step",
                {.fallback = "auto", .range = nonNegative})
            .quantity("safety", &NumericsSettings::safety, unit::none,
                      "fraction of the viscous and the spring limit that a time step may take",
                      {.fallback = "0.95", .range = between(0.01, 1)})
            .integer("rollbacks", &NumericsSettings::rollbacks,
                     "how often in a row a run that fails goes back to its last good state and on with half the step, "
                     "before it ends; 0 for not at all",
                     {.fallback = "4", .range = between(0, 20)})
            .atRestart(AtRestart::fixed, {"spacing", "kernel", "coupling", "operators", "shifting", "skin"})
            .atRestart(AtRestart::resolved, {"integrator"})
            .atRestart(AtRestart::noted, {"precision", "guard", "densityBalance", "safety"})
            .atRestart(AtRestart::free, {"rollbacks"});
    return s;
}

}  // namespace corpuscle::schemes
