// Observer `wallStress`: what the fluid does to the walls; one file, wallStress.csv.
//
// column                           | meaning                                                                       | unit
// shearStress_lower, _upper        | stress sigma_xg in the fluid at the wall, g across the walls: F_x/A of the    | Pa
//                                  | lower wall, -F_x/A of the upper one, F the force of the fluid on the wall     |
// pressure_lower, _upper           | normal force over area, positive when the fluid pushes                        | Pa
// effectiveViscosity               | mean of the two shear stresses over mu gammadot; only in a flow with a shear  | -
//                                  | rate                                                                          |
//
// Numbers to compare with: plane Couette flow has sigma_xg = mu gammadot at both walls, effectiveViscosity 1; plane Poiseuille
// flow under the body force b over the gap h has +-rho b h/2 (momentum balance, exact). A dilute suspension of rigid spheres of volume
// fraction phi adds 5/2 phi (Einstein 1906).
#include "core/communicator.hpp"
#include "observers/observer.hpp"

namespace corpuscle::observers {

namespace {

class WallStressObservation : public Observation {
  public:
    explicit WallStressObservation(const Scene& scene) : Observation({{"wallStress", columnsOf(scene)}}) {}

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

  private:
    static std::vector<io::Column> columnsOf(const Scene& scene) {
        std::vector<io::Column> columns{{"shearStress_lower", "Pa"},
                                        {"shearStress_upper", "Pa"},
                                        {"pressure_lower", "Pa"},
                                        {"pressure_upper", "Pa"}};
        if (scene.flow.shearRate != 0) columns.push_back({"effectiveViscosity", ""});
        return columns;
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
    std::unique_ptr<Observation> begin(const Scene& scene) const override {
        return std::make_unique<WallStressObservation>(scene);
    }
};

CORPUSCLE_REGISTER(Observer, WallStressObserver, "wallStress", "stress on the walls and effective viscosity");

}  // namespace
}  // namespace corpuscle::observers
