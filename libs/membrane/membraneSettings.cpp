#include "membrane/membraneSettings.hpp"

namespace corpuscle::membrane {

const Schema<InteriorSettings>& InteriorSettings::schema() {
    static const Schema<InteriorSettings> s =
        Schema<InteriorSettings>("interior", "the fluid inside the cell")
            .quantity("viscosityRatio", &InteriorSettings::viscosityRatio, unit::none,
                      "viscosity inside over viscosity outside", {.fallback = "1", .range = positive})
            .quantity(
                "concentration", &InteriorSettings::concentration, unit::kilogramPerMetre3,
                "concentration of the solute (solute in constant/fluid.yaml) at t = 0, 0 if not given; 330 kg/m^3 "
                "of haemoglobin in red cells",
                {.range = between(0, 1e4)});
    return s;
}

const Schema<MembraneSettings>& MembraneSettings::schema() {
    static const Schema<MembraneSettings> s =
        Schema<MembraneSettings>("membrane", "the laws of one kind of cell")
            .table("interior", &MembraneSettings::interior, "the fluid inside", {.fallback = "{}"})
            .text("stressFree", &MembraneSettings::stressFree,
                  "VTP file, relative to the case, of the same mesh in its stress-free shape; by default the mesh as "
                  "made")
            .modelOr("none", "bonds", &MembraneSettings::bonds, "law of the bonds along the edges",
                     {.fallback = "none"})
            .modelOr("none", "triangles", &MembraneSettings::triangles, "law of the sheet, triangle by triangle",
                     {.fallback = "none"})
            .modelOr("none", "angles", &MembraneSettings::angles, "law of the triangles' corner angles",
                     {.fallback = "none"})
            .modelOr("none", "bending", &MembraneSettings::bending, "law of bending", {.fallback = "none"})
            .table("area", &MembraneSettings::area, "area held near a target")
            .table("volume", &MembraneSettings::volume, "enclosed volume held near a target")
            .table("viscosity", &MembraneSettings::viscosity, "viscosity of the membrane itself")
            .modelOr("none", "rupture", &MembraneSettings::rupture, "when bonds break", {.fallback = "none"})
            .table("rim", &MembraneSettings::rim, "line tension of the rims of holes")
            .modelOr("none", "pores", &MembraneSettings::pores, "pores that let a solute through", {.fallback = "none"})
            .check([](const MembraneSettings& m, const Node& node, Problems& problems) {
                if (!m.bonds && !m.triangles) {
                    problems.add(node.place(), node.path,
                                 "has no law that resists shear; give bonds (" +
                                     joinWords(Registry<BondLaw>::instance().names()) + "), triangles (" +
                                     joinWords(Registry<TriangleLaw>::instance().names()) + ") or both");
                }
            })
            .atRestart(AtRestart::fixed, {"interior", "stressFree"})
            .atRestart(AtRestart::noted, {"bonds", "triangles", "angles", "bending", "area", "volume", "viscosity",
                                          "rupture", "rim", "pores"});
    return s;
}

SurfaceModuli MembraneSettings::moduli(double edge) const {
    SurfaceModuli sum;
    if (bonds) {
        sum += bonds->hexagonalModuli(edge);
    }
    if (triangles) {
        sum += triangles->moduli();
    }
    if (area) {
        sum.area += area->local.value_or(0) + area->global.value_or(0);
    }
    return sum;
}

}  // namespace corpuscle::membrane
