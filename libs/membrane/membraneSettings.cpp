#include "membrane/membraneSettings.hpp"

namespace corpuscle::membrane {

const Schema<InteriorSettings>& InteriorSettings::schema() {
    static const Schema<InteriorSettings> s =
        Schema<InteriorSettings>("interior", "the fluid inside the cell")
            .quantity("viscosityRatio", &InteriorSettings::viscosityRatio, unit::none,
                      "viscosity inside over viscosity outside", {.fallback = "1", .range = positive});
    return s;
}

const Schema<MembraneSettings>& MembraneSettings::schema() {
    static const Schema<MembraneSettings> s =
        Schema<MembraneSettings>("membrane", "the laws of one kind of cell")
            .table("interior", &MembraneSettings::interior, "the fluid inside", {.fallback = "{}"})
            .model("bonds", &MembraneSettings::bonds, "law of the bonds along the edges")
            .modelOr("none", "angles", &MembraneSettings::angles, "law of the triangles' corner angles",
                     {.fallback = "none"})
            .modelOr("none", "bending", &MembraneSettings::bending, "law of bending", {.fallback = "none"})
            .modelOr("none", "rupture", &MembraneSettings::rupture, "when bonds break", {.fallback = "none"});
    return s;
}

}  // namespace corpuscle::membrane
