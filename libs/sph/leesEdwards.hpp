// Simple shear without walls: the periodic images of the box slide past each other (Lees and Edwards),
//     u = gammadot s e_x,   s the coordinate along `gradient` from the middle,
//         the next image along it, at x + L e_s + gammadot L t e_x, moves with u + gammadot L e_x
// The box represents an unbounded suspension, without the effects of walls. The mean velocity keeps its initial value,
// 0, unless an external force acts.
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
