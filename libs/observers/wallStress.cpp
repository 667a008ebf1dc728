// Observer `wallStress`: what the fluid does to the walls; one file, wallStress.csv.
//
// Shear stress: sigma_xg in the fluid at the wall, g across the walls, which is F_x/A of the lower wall and -F_x/A of
// the upper one, F the force of the fluid on the wall.
//
// Numbers to compare with: plane Couette flow has sigma_xg = mu gammadot at both walls, effectiveViscosity 1; plane
// Poiseuille flow under the body force b over the gap h has +-rho b h/2 (momentum balance, exact). A dilute suspension
// of rigid spheres of volume fraction phi adds 5/2 phi (Einstein 1906).
#include "core/communicator.hpp"
#include "observers/observer.hpp"

namespace corpuscle::observers {

namespace {

class WallStressObservation : public Observation {
  public:
    using Observation::Observation;

    std::vector<Row> observe(const Scene& scene, const Time&) override {
        const int axis = scene.flow.walls.axis;
        const double area = scene.fluidBox.volume() / scene.fluidBox.size()[axis];
        const Vec3 &lower = scene.forces->wallForce(0), &upper = scene.forces->wallForce(1);
        const auto force =
            Communicator(scene.system->comm()).sum(std::vector<double>{lower[0], -upper[0], -lower[axis], upper[axis]});
        std::vector<double> row;
        row.reserve(force.size() + 1);
        for (const double f : force) row.push_back(f / area);
        if (const double rate = scene.flow.shearRate; rate != 0)
            row.push_back(0.5 * (row[0] + row[1]) / (scene.model().viscosity * rate));
        return {{0, std::move(row)}};
    }
};

struct WallStressObserver : Observer {
    static const Schema<WallStressObserver>& schema() {
        static const Schema<WallStressObserver> s =
            Schema<WallStressObserver>("wallStress", "stress on the walls and effective viscosity")
                .include<ObserverSettings>();
        return s;
    }
    std::string obstacle(const Subject& subject) const override {
        if (subject.walls) return {};
        return "this observer looks at walls, and the flow has none; remove it, or choose a flow with walls in "
               "constant/flow.yaml";
    }
    std::vector<Table> tables(const SceneParts& parts) const override {
        std::vector<io::Column> columns{
            {"shearStress_lower", "Pa", "shear stress in the fluid at the lower wall, along the flow"},
            {"shearStress_upper", "Pa", "shear stress in the fluid at the upper wall, along the flow"},
            {"pressure_lower", "Pa", "normal force on the lower wall over its area, positive when the fluid pushes"},
            {"pressure_upper", "Pa", "normal force on the upper wall over its area, positive when the fluid pushes"}};
        if (parts.shear)
            columns.push_back({"effectiveViscosity", "", "mean of the two shear stresses over mu gammadot"});
        return {{"wallStress", columns}};
    }
    std::unique_ptr<Observation> begin(const Scene& scene) const override {
        return std::make_unique<WallStressObservation>(tables(SceneParts::of(scene)));
    }
};

CORPUSCLE_REGISTER(Observer, WallStressObserver, "wallStress", "stress on the walls and effective viscosity");

}  // namespace
}  // namespace corpuscle::observers
