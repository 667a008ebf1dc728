// Observer `wallStress`: stress of the fluid on the walls; one file, wallStress.csv.
//
// For a wall of area A and normal n into the fluid, on which the fluid exerts the force F, the pressure is -F.n/A. The
// shear stress sigma_xg in the fluid at the wall is F_x/A times the sign of n_g, with g the axis along which the flow
// changes: F_x/A at the lower of two planes and -F_x/A at the upper one.
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
        const std::vector<Vec3>& forces = scene.forces->wallForces();
        std::vector<double> row;
        for (const boundary::Wall& wall : scene.flow.walls)
            row.push_back(forces[static_cast<std::size_t>(wall.number)][0] * normal(wall)[scene.flow.gradient] /
                          wall.surface->area());
        for (const boundary::Wall& wall : scene.flow.walls)
            row.push_back(-forces[static_cast<std::size_t>(wall.number)].dot(normal(wall)) / wall.surface->area());
        row = Communicator(scene.system->comm()).sum(std::move(row));
        if (const double rate = scene.flow.shearRate; rate != 0)
            row.push_back(0.5 * (row[0] + row[1]) / (scene.model().viscosity * rate));
        return {{0, std::move(row)}};
    }

  private:
    static Vec3 normal(const boundary::Wall& wall) { return wall.normal(Vec3::Zero()); }  // the same all over a plane
};

struct WallStressObserver : Observer {
    static const Schema<WallStressObserver>& schema() {
        static const Schema<WallStressObserver> s =
            Schema<WallStressObserver>("wallStress", "stress on the walls and effective viscosity")
                .include<ObserverSettings>();
        return s;
    }
    std::string whyNot(const Subject& subject) const override {
        if (subject.planeWalls) return {};
        return "this observer looks at plane walls, and the flow has none; remove it, or choose a flow with plane "
               "walls in constant/flow.yaml";
    }
    std::vector<Table> tables(const SceneParts& parts) const override {
        std::vector<io::Column> columns;
        for (const std::string& wall : parts.walls)
            columns.push_back(
                {"shearStress_" + wall, "Pa", "shear stress in the fluid at the " + wall + " wall, along the flow"});
        for (const std::string& wall : parts.walls)
            columns.push_back({"pressure_" + wall, "Pa",
                               "normal force on the " + wall + " wall over its area, positive when the fluid pushes"});
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
