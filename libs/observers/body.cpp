// Observer `body`: motion of each rigid body and what the fluid does to it; one file per body.
//
// column                    | meaning                                                                                  | unit
// centre_x, _y, _z          | centre of mass, not wrapped into the box                                                 | m
// axis_x, _y, _z            | what was the axis of its shape at t = 0                                                  | -
// rotation_w, _x, _y, _z    | unit quaternion of the rotation since t = 0                                              | -
// velocity_x, _y, _z        | of the centre of mass                                                                    | m/s
// angularVelocity_x, _y, _z |                                                                                          | 1/s
// force_x, _y, _z           | of the fluid, with rho0 b V where a body force b stands for a pressure gradient          | N
// torque_x, _y, _z          | of the fluid, about the centre of mass                                                   | N m
//
// Numbers to compare with, in Stokes flow, a the radius, mu the viscosity: drag 6 pi mu a U; torque on a sphere held in the shear
// rate gammadot 4 pi mu a^3 gammadot; angular velocity of a free sphere gammadot/2, of a free spheroid of axis ratio r = c/a whose axis
// is in the shear plane at phi from the direction of the gradient
//     dphi/dt = gammadot/(r^2 + 1) (r^2 cos^2 phi + sin^2 phi),   period 2 pi (r + 1/r)/gammadot      (Jeffery, Proc. R. Soc. A 102:161, 1922)
#include "observers/observer.hpp"

namespace corpuscle::observers {

namespace {

class BodyObservation : public Observation {
  public:
    explicit BodyObservation(const Scene& scene) : Observation(tablesOf(scene)) {}

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

  private:
    static std::vector<Table> tablesOf(const Scene& scene) {
        std::vector<io::Column> columns;
        const auto add = [&](const std::string& name, const std::string& unit) {
            for (const char* component : {"_x", "_y", "_z"}) columns.push_back({name + component, unit});
        };
        add("centre", "m"), add("axis", "");
        columns.push_back({"rotation_w", ""});
        add("rotation", "");
        add("velocity", "m_s"), add("angularVelocity", "1_s"), add("force", "N"), add("torque", "Nm");
        std::vector<Table> tables;
        for (const bodies::Body& body : scene.bodies->all()) tables.push_back({body.name, columns});
        return tables;
    }
};

struct BodyObserver : Observer {
    static const Schema<BodyObserver>& schema() {
        static const Schema<BodyObserver> s =
            Schema<BodyObserver>("body", "place, motion, force and torque of each rigid body")
                .include<ObserverSettings>();
        return s;
    }
    std::string obstacle(const Subject& subject) const override {
        if (subject.bodies) return {};
        return "this observer looks at rigid bodies, and the case has none; remove it, or add bodies to "
               "system/mesh.yaml";
    }
    std::unique_ptr<Observation> begin(const Scene& scene) const override {
        return std::make_unique<BodyObservation>(scene);
    }
};

CORPUSCLE_REGISTER(Observer, BodyObserver, "body", "place, motion, force and torque of each rigid body");

}  // namespace
}  // namespace corpuscle::observers
