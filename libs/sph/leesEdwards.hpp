// Simple shear without walls: the periodic images of the box slide past each other (Lees and Edwards),
//     u = gammadot s e_x,   s the coordinate along `gradient` from the middle,
//         the next image along it, at x + L e_s + gammadot L t e_x, moves with u + gammadot L e_x
// A box of a shear flow that fills all of space: what a suspension does by itself, without walls. The mean velocity is
// that of the start, 0, as long as no force acts from outside.
//
// Lees, Edwards 1972, J. Phys. C 5, 1921.
#pragma once
#include "sph/shearRate.hpp"

namespace corpuscle::sph {

struct LeesEdwards : Flow, ShearRate {
    std::string gradient = "z";
    static const Schema<LeesEdwards>& schema();
    bool slides() const override { return true; }
    FlowState resolve(const FlowContext& context, const Mark& mark, Problems& problems) const override;
};

}  // namespace corpuscle::sph
