// Taylor-Green vortices in the x-z plane of a box that is periodic along all axes; exact at any Reynolds number:
//     u =  U sin(kx) cos(kz) exp(-2 nu k^2 t),   w = -U cos(kx) sin(kz) exp(-2 nu k^2 t),   k = 2 pi/L_x
//     p = rho U^2/4 (cos 2kx + cos 2kz) exp(-4 nu k^2 t);   mean kinetic energy per mass U^2/4 exp(-4 nu k^2 t)
#pragma once
#include "sph/flow.hpp"

namespace corpuscle::sph {

struct TaylorGreenFlow : Flow {
    double speed = 0;
    static const Schema<TaylorGreenFlow>& schema();
    int wallAxis() const override { return -1; }
    FlowState resolve(const FlowContext& context, const Mark& mark, Problems& problems) const override;
};

}  // namespace corpuscle::sph
