// Taylor-Green vortices in a box that is periodic along all axes, k = 2 pi/L_x.
//
// dimensions: 2, in the x-z plane; exact at any Reynolds number:
//     u =  U sin(kx) cos(kz) exp(-2 nu k^2 t),   w = -U cos(kx) sin(kz) exp(-2 nu k^2 t)
//     p = rho U^2/4 (cos 2kx + cos 2kz) exp(-4 nu k^2 t);   mean kinetic energy per mass U^2/4 exp(-4 nu k^2 t)
// dimensions: 3, in a cube; at t = 0, and for Re = U/(nu k) -> 0 afterwards:
//     u =  U sin(kx) cos(ky) cos(kz) exp(-3 nu k^2 t),   v = -U cos(kx) sin(ky) cos(kz) exp(-3 nu k^2 t),   w = 0
//     p = rho U^2/16 (cos 2kx + cos 2ky)(cos 2kz + 2) at t = 0;   mean kinetic energy per mass U^2/8 exp(-6 nu k^2 t)
// At larger Re smaller scales and a component w develop, and the energy decays faster: there is no closed form.
// symbol | meaning                                        | unit
// U      | largest component of velocity at t = 0         | m/s
// x y z  | position relative to the box's lower corner    | m
// Source: G. I. Taylor and A. E. Green, Proc. R. Soc. A 158 (1937) 499.
#pragma once
#include "sph/flow.hpp"

namespace corpuscle::sph {

struct TaylorGreenFlow : Flow {
    double speed = 0;
    long dimensions = 2;
    static const Schema<TaylorGreenFlow>& schema();
    bool isThreeDimensional() const override { return dimensions == 3; }
    FlowState resolve(const FlowContext& context, const Mark& mark, Problems& problems) const override;
};

}  // namespace corpuscle::sph
