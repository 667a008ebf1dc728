// Diffusion of a solute in the fluid on each side of membranes:
//     dq_i/dt = D k sum_j V_i V_j F (c_j - c_i),   k = 2/S2
// symbol | meaning                                                                             | unit
// q, c   | mass of the solute that a particle carries, its concentration (solute.hpp)          | kg, kg/m^3
// V      | m/rho0, volume of a particle                                                        | m^3
// F      | -W'(r)/r                                                                            | 1/m^5
// S2     | second moment of F on a cubic lattice: particles on a lattice diffuse exactly with D | -
// Source: L. Brookshaw, Proc. Astron. Soc. Aust. 6 (1985) 207; P. W. Cleary and J. J. Monaghan, J. Comput. Phys. 148
// (1999) 227. The sum of all q is kept to rounding, and no diffusion is across a membrane, to walls or bodies.
#pragma once
#include <vector>

#include "particles/particleSystem.hpp"
#include "sph/fluidForces.hpp"

namespace corpuscle::sph {

class Diffusion {
  public:
    Diffusion(const FluidModel& model, const particles::ParticleSystem& system);

    // Finds rates() and speeds() of the owned particles at these concentrations; lists must be up to date. Collective.
    void find(particles::ParticleSystem& system, const std::vector<double>& concentration);
    const std::vector<double>& rates() const { return rates_; }    // dq/dt [kg/s]
    const std::vector<double>& speeds() const { return speeds_; }  // D k sum_j V_j F [1/s]: dc/dt <= speed (cMax - c)

  private:
    double volumeOf(const particles::ParticleStore& s, std::size_t i) const {
        return (s.optional().mass ? s.mass[i] : mass_) / density_;
    }
    KernelKind kernel_;
    double mass_, density_, factor_;
    particles::RealArray sums_;
    std::vector<double> rates_, speeds_, unused_;
};

}  // namespace corpuscle::sph
