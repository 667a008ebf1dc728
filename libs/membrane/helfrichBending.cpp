#include "membrane/helfrichBending.hpp"

#include <cmath>
#include <numbers>
#include <numeric>

#include "core/error.hpp"
#include "core/registry.hpp"
#include "membrane/helfrichTerm.hpp"

namespace corpuscle::membrane {

const Schema<AreaDifference>& AreaDifference::schema() {
    static const Schema<AreaDifference> s =
        Schema<AreaDifference>("area difference", "elasticity of the difference of the two layers' areas (ADE)")
            .quantity("ratio", &AreaDifference::ratio, unit::none, "its modulus over kappa", {.range = positive})
            .quantity("reduced", &AreaDifference::reduced, unit::none,
                      "rest area difference over that of the sphere with the stress-free mesh's area")
            .quantity("absolute", &AreaDifference::absolute, unit::metre.power(2),
                      "rest area difference itself; wants thickness")
            .quantity("thickness", &AreaDifference::thickness, unit::metre, "distance of the layers' neutral surfaces",
                      {.range = positive})
            .exactlyOneOf({"reduced", "absolute"})
            .check([](const AreaDifference& a, const Node& node, Problems& problems) {
                if (a.absolute.has_value() != a.thickness.has_value()) {
                    problems.add(node.place(), node.path,
                                 a.absolute ? "absolute wants thickness, the distance of the layers' neutral surfaces "
                                              "(about 3 nm), or give reduced instead"
                                            : "thickness has a meaning only beside absolute; leave it out");
                }
            });
    return s;
}

const Schema<HelfrichBending>& HelfrichBending::schema() {
    static const Schema<HelfrichBending> s =
        Schema<HelfrichBending>("helfrich bending",
                                "curvature energy kappa/2 Int (c1 + c2 - c0)^2 dA from dihedral angles and node areas "
                                "(Juelicher 1996); knows no rest shape")
            .quantity(
                "Eb", &HelfrichBending::Eb, unit::none,
                "bending modulus relative to the sheet, kappa/(Gs a^2), with Gs of bonds and triangles in closed form",
                {.range = positive})
            .quantity("kappa", &HelfrichBending::kappa, unit::joule, "bending modulus", {.range = positive})
            .quantity("spontaneousCurvature", &HelfrichBending::spontaneousCurvature, unit::none / unit::metre,
                      "c0, of c1 + c2, positive outwards", {.fallback = "0 1/m"})
            .table("areaDifference", &HelfrichBending::areaDifference,
                   "elasticity of the difference of the two layers' areas")
            .exactlyOneOf({"Eb", "kappa"});
    return s;
}

std::unique_ptr<Term> HelfrichBending::makeTerm(Network& network, const MembraneScale& scale) const {
    HelfrichModuli moduli{.kappa = bendingModulus(scale), .c0 = spontaneousCurvature};
    if (areaDifference) {
        if (network.isOpen()) {
            throw Failure(ExitCode::invalidCase,
                          "bending helfrich: areaDifference on a mesh with a border; the two layers are one around a "
                          "border. Leave areaDifference out or close the mesh");
        }
        const double area = std::accumulate(network.restAreas().begin(), network.restAreas().end(), 0.0);
        moduli.difference = 4 * std::numbers::pi * areaDifference->ratio * moduli.kappa / area;
        moduli.restCurvature = areaDifference->absolute
                                   ? *areaDifference->absolute / (2 * *areaDifference->thickness)
                                   : *areaDifference->reduced * std::sqrt(4 * std::numbers::pi * area);
    }
    network.useHinges();
    return std::make_unique<HelfrichTerm>(network, moduli);
}

CORPUSCLE_REGISTER(BendingLaw, HelfrichBending, "helfrich",
                   "curvature energy node by node, with spontaneous curvature and area difference");

}  // namespace corpuscle::membrane
