// A solute that the fluid carries, such as haemoglobin: each fluid particle has a mass of it, which moves with the
// particle and passes to others by diffusion (diffusion.hpp) and through the pores of membranes
// (coupling/soluteTransport.hpp). It does not act on the flow.
//
// The concentration of particle i is c_i = q_i rho0/m_i with the mass q of the solute that it carries: per volume at
// the rest density, so that it does not change with the small changes of density.
#pragma once
#include "core/settings.hpp"

namespace corpuscle::sph {

struct Solute {
    double concentration = 0;  // outside the cells at t = 0 [kg/m^3]
    double diffusivity = 0;    // D [m^2/s]
    double radius = 0;         // of its molecules [m]
    static const Schema<Solute>& schema();
};

}  // namespace corpuscle::sph
