// Simple shear between two walls that move against each other, with the factor f(t) of a drive (drive.hpp):
//     u = gammadot s e_x,   s the coordinate along the walls' normal from the middle,
//         walls at s = +-L/2 move with +-f gammadot L/2
// start: linear sets this profile, times f(0), at t = 0; rest starts the walls impulsively:
//     u/U = 2 eta + sum_n 2/(n pi) (-1)^n sin(2 n pi eta) exp(-4 n^2 pi^2 nu t/L^2),  eta = s/L
#pragma once
#include "sph/shearRate.hpp"

namespace corpuscle::sph {

struct ShearFlow : Flow, ShearRate {
    Choice<boundary::WallShape> wallShape;
    std::string start = "linear";
    Choice<Drive> driveModel;
    static const Schema<ShearFlow>& schema();
    const boundary::WallShape* walls() const override { return wallShape.model.get(); }
    const Drive* drive() const override { return driveModel.model.get(); }
    FlowState resolve(const FlowContext& context, const Mark& mark, Problems& problems) const override;
};

}  // namespace corpuscle::sph
