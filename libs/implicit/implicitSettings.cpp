#include "implicit/implicitSettings.hpp"

namespace corpuscle::implicit {

const Schema<ImplicitSettings>& ImplicitSettings::schema() {
    static const Schema<ImplicitSettings> s =
        Schema<ImplicitSettings>("implicit", "the implicit step; its size is set by accuracy")
            .quantity(
                "step", &ImplicitSettings::step, unit::none,
                "largest strain of one step, rate x dt; where it is absent, a step is also at most 1/40 of the time "
                "scale on which the flow itself changes",
                {.fallback = "0.05", .range = between(1e-6, 0.5)})
            .quantity("tolerance", &ImplicitSettings::tolerance, unit::none,
                      "largest error of the solver, relative to the disturbance of the flow, in the norm of energy",
                      {.fallback = "1e-3", .range = between(1e-10, 0.1)})
            .quantity(
                "error", &ImplicitSettings::error, unit::none,
                "error that steps may make per unit of strain in the places of nodes and of free bodies, in their "
                "radii; without either in those of the fluid, in lengths of the flow",
                {.fallback = "1e-3", .range = between(1e-8, 1)})
            .quantity("bondStrain", &ImplicitSettings::bondStrain, unit::none,
                      "largest change of a bond's length in one step, relative",
                      {.fallback = "0.1", .range = between(1e-4, 1)})
            .word("method", &ImplicitSettings::method, {"midpoint", "backwardEuler"}, "of second or of first order",
                  {.fallback = "midpoint"})
            .word("preconditioner", &ImplicitSettings::preconditioner,
                  {"automatic", "twoLevel", "withMembrane", "blockJacobi"},
                  "of the solver: with the flow on a background grid, with that and the membranes, or without either; "
                  "automatic: the first or the second, by their stiffness",
                  {.fallback = "automatic"});
    return s;
}

}  // namespace corpuscle::implicit
