// constant/bodies.yaml: one entry for each kind of rigid body.
//
//     sphere: {density: 1000 kg/m^3, motion: free}
//     piston: {motion: {type: driven, velocity: [1 mm/s, 0 mm/s, 0 mm/s]}}
#pragma once
#include <map>

#include "bodies/bodyMotion.hpp"

namespace corpuscle::bodies {

struct BodySettings {
    std::optional<double> density;  // [kg/m^3]; empty: density of the fluid
    Choice<BodyMotion> motion;
    static const Schema<BodySettings>& schema();
};

struct BodiesSettings {
    std::map<std::string, BodySettings> types;
    static const Schema<BodiesSettings>& schema();
};

}  // namespace corpuscle::bodies
