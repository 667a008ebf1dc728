// Arnold-Beltrami-Childress flow in a cube that is periodic along all axes, k = 2 pi/L_x; exact at any Reynolds number:
//     u = (A sin kz + C cos ky) exp(-nu k^2 t)
//     v = (B sin kx + A cos kz) exp(-nu k^2 t)
//     w = (C sin ky + B cos kx) exp(-nu k^2 t)
//     p = -rho (A B sin kx cos kz + B C sin ky cos kx + C A sin kz cos ky) exp(-2 nu k^2 t)
// Its vorticity is k times its velocity (a Beltrami flow), so that u.grad u is the gradient of u^2/2 and only viscosity
// changes the flow. The mean kinetic energy per mass is (A^2 + B^2 + C^2)/2 exp(-2 nu k^2 t). Particle paths are
// chaotic if none of A, B, C vanishes. Above Re = A/(nu k) of about 13 (A = B = C) small disturbances grow.
// symbol  | meaning                                       | unit
// A, B, C | amplitudes of velocity at t = 0               | m/s
// x y z   | position relative to the box's lower corner   | m
// Sources: T. Dombre et al., J. Fluid Mech. 167 (1986) 353; growth: D. Galloway and U. Frisch, J. Fluid Mech. 180
// (1987) 557.
#pragma once
#include "sph/flow.hpp"

namespace corpuscle::sph {

struct AbcFlow : Flow {
    double A = 0, B = 0, C = 0;
    static const Schema<AbcFlow>& schema();
    bool isThreeDimensional() const override { return true; }
    FlowState resolve(const FlowContext& context, const Mark& mark, Problems& problems) const override;
};

}  // namespace corpuscle::sph
