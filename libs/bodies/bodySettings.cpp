#include "bodies/bodySettings.hpp"

namespace corpuscle::bodies {

const Schema<BodySettings>& BodySettings::schema() {
    static const Schema<BodySettings> s =
        Schema<BodySettings>("body", "one kind of rigid body")
            .quantityOr("fluid", "density", &BodySettings::density, unit::kilogramPerMetre3,
                        "mass of the solid over the volume of its mesh; fluid: as the fluid around",
                        {.fallback = "fluid", .range = positive})
            .model("motion", &BodySettings::motion, "what it does under force and torque")
            .atRestart(AtRestart::fixed, {"density"})
            .atRestart(AtRestart::noted, {"motion"});
    return s;
}

const Schema<BodiesSettings>& BodiesSettings::schema() {
    static const Schema<BodiesSettings> s =
        Schema<BodiesSettings>("bodies", "constant/bodies.yaml: density and motion of each kind of rigid body")
            .map("*", &BodiesSettings::types, "one kind of rigid body");
    return s;
}

}  // namespace corpuscle::bodies
