// Flow `modelName`: a uniform stream along x through a box that is periodic along all axes.
//     u = U,   p = 0
// symbol | meaning | unit
// U      | speed   | m/s
#pragma once
#include "sph/flow.hpp"

namespace corpuscle::sph {

struct ModelNameFlow : Flow {
    double speed = 0;
    static const Schema<ModelNameFlow>& schema();
    FlowState resolve(const FlowContext& context, const Mark& mark, Problems& problems) const override;
};

}  // namespace corpuscle::sph
