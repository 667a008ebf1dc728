// Flow between walls at rest, driven along x by a body force F per unit mass, or by a pressure drop over the length of
// the box, F = drop/(rho L_x), or such that the flow rate is a given one (coupling/flowControl). A drive (drive.hpp)
// multiplies each of them by a factor of time. Between two planes, with a steady drive:
//     u(s) = F/(2 nu) (s - low)(high - s) when developed; from rest
//     u nu/(F L^2) = y(1 - y)/2 - sum_n 4/((2n+1)^3 pi^3) sin((2n+1) pi y) exp(-(2n+1)^2 pi^2 nu t/L^2),  y = (s -
//         low)/L
// Between walls other than two parallel planes the flow always starts from rest; boundary/wallShape has estimates.
#pragma once
#include "sph/flow.hpp"

namespace corpuscle::sph {

struct PoiseuilleFlow : Flow {
    std::optional<double> bodyForce;     // F [m/s^2]
    std::optional<double> pressureDrop;  // [Pa]
    std::optional<double> flowRate;      // [m^3/s]
    Choice<boundary::WallShape> wallShape;
    std::string start = "rest";
    Choice<Drive> driveModel;
    static const Schema<PoiseuilleFlow>& schema();
    const boundary::WallShape* walls() const override { return wallShape.model.get(); }
    const Drive* drive() const override { return driveModel.model.get(); }
    FlowState resolve(const FlowContext& context, const Mark& mark, Problems& problems) const override;
};

}  // namespace corpuscle::sph
