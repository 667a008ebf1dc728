#include "simulation/relaxSettings.hpp"

namespace corpuscle::simulation {

const Schema<RelaxSettings>& RelaxSettings::schema() {
    static const Schema<RelaxSettings> s =
        Schema<RelaxSettings>("relax", "a membrane without fluid, in equilibrium stage by stage")
            .table("cell", &RelaxSettings::cell, "the cell; its centre and axis are not used")
            .model("protocol", &RelaxSettings::protocol, "what is done to the membrane")
            .quantity("tolerance", &RelaxSettings::tolerance, unit::none,
                      "largest residual force, relative to the largest load or to forceScale",
                      {.fallback = "1e-6", .range = positive})
            .quantity("forceScale", &RelaxSettings::forceScale, unit::newton,
                      "what a force of a node is compared with where loads are small",
                      {.fallback = "1 pN", .range = positive})
            .integer("iterations", &RelaxSettings::iterations, "of Newton's method, each stage at most",
                     {.fallback = "500", .range = atLeast(1)});
    return s;
}

}  // namespace corpuscle::simulation
