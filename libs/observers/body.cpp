// Observer `body`: motion of each rigid body, and the force and torque of the fluid on it; one file per body. The force
// includes rho0 b V if a body force b stands for a pressure gradient.
//
// Numbers to compare with, in Stokes flow, a the radius, mu the viscosity: drag 6 pi mu a U; torque on a sphere held in
// a flow with the shear rate gammadot: 4 pi mu a^3 gammadot; angular velocity of a free sphere: gammadot/2, of a free
// spheroid of axis ratio r = c/a whose axis is in the shear plane at phi from the direction of the gradient:
//     dphi/dt = gammadot/(r^2 + 1) (r^2 cos^2 phi + sin^2 phi),   period 2 pi (r + 1/r)/gammadot
//         (Jeffery, Proc. R. Soc. A 102:161, 1922)
#include "observers/observer.hpp"

namespace corpuscle::observers {

namespace {

class BodyObservation : public Observation {
  public:
    using Observation::Observation;

    std::vector<Row> observe(const Scene& scene, const Time&) override {
        std::vector<Row> rows;
        for (const bodies::Body& body : scene.bodies->all()) {
            Row row{rows.size(), {}};
            const auto add = [&](const Vec3& v) { row.values.insert(row.values.end(), v.data(), v.data() + 3); };
            const Eigen::Quaterniond turned = body.turned();
            add(body.state.centre);
            add(turned * body.axis);
            row.values.push_back(turned.w());
            add(turned.vec());
            add(body.state.motion.linear), add(body.state.motion.angular);
            add(body.wrench.force), add(body.wrench.torque);
            rows.push_back(std::move(row));
        }
        return rows;
    }
};

struct BodyObserver : Observer {
    static const Schema<BodyObserver>& schema() {
        static const Schema<BodyObserver> s =
            Schema<BodyObserver>("body", "place, motion, force and torque of each rigid body")
                .include<ObserverSettings>();
        return s;
    }
    std::string whyNot(const Subject& subject) const override {
        if (subject.bodies) return {};
        return "this observer looks at rigid bodies, and the case has none; remove it, or add bodies to "
               "system/mesh.yaml";
    }
    std::vector<Table> tables(const SceneParts& parts) const override {
        std::vector<io::Column> columns;
        addVector(columns, "centre", "m", "coordinate of the centre of mass, not wrapped into the box");
        addVector(columns, "axis", "", "component of the unit vector that was the axis of its shape at t = 0");
        columns.push_back({"rotation_w", "", "scalar part of the unit quaternion of the rotation since t = 0"});
        addVector(columns, "rotation", "", "component of the vector part of the unit quaternion");
        addVector(columns, "velocity", "m_s", "component of the velocity of the centre of mass");
        addVector(columns, "angularVelocity", "1_s", "component of the angular velocity");
        addVector(columns, "force", "N", "component of the force of the fluid, with that of a mean pressure gradient");
        addVector(columns, "torque", "Nm", "component of the torque of the fluid about the centre of mass");
        std::vector<Table> all;
        for (const std::string& body : parts.bodies) all.push_back({body, columns});
        return all;
    }
    std::unique_ptr<Observation> begin(const Scene& scene) const override {
        return std::make_unique<BodyObservation>(tables(SceneParts::of(scene)));
    }
};

CORPUSCLE_REGISTER(Observer, BodyObserver, "body", "place, motion, force and torque of each rigid body");

}  // namespace
}  // namespace corpuscle::observers
