#include "sph/solute.hpp"

namespace corpuscle::sph {

const Schema<Solute>& Solute::schema() {
    static const Schema<Solute> s =
        Schema<Solute>("solute", "a solute that the fluid carries, such as haemoglobin")
            .quantity("concentration", &Solute::concentration, unit::kilogramPerMetre3,
                      "concentration outside the cells at t = 0; inside: interior.concentration of "
                      "constant/membranes.yaml",
                      {.fallback = "0 kg/m^3", .range = between(0, 1e4)})
            .quantity("diffusivity", &Solute::diffusivity, unit::metre2PerSecond,
                      "diffusivity in the fluid, inside cells and outside; 0: none, and only the flow through pores "
                      "passes them",
                      {.fallback = "6e-11 m^2/s", .range = nonNegative})
            .quantity("radius", &Solute::radius, unit::metre,
                      "radius of its molecules, which pores of membranes hinder; that of haemoglobin if not given",
                      {.fallback = "3.2 nm", .range = nonNegative})
            .atRestart(AtRestart::fixed, {"concentration"})
            .atRestart(AtRestart::noted, {"diffusivity", "radius"});
    return s;
}

}  // namespace corpuscle::sph
