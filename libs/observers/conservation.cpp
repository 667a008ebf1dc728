// Observer `conservation`: what a run must keep, and how well it does; one file, conservation.csv.
//
// column                          | meaning                                                                             | unit
// density_mean, _min, _max        | of the fluid's particles over rho0                                                  | -
// kineticEnergy                   | sum m u^2/2 of fluid and membrane particles, and that of rigid bodies               | J
// momentum_x, _y, _z              | sum m u of the same; walls and body force change it                                 | N s
// particles                       | of all kinds                                                                        | -
// with cells only:
// membraneEnergy                  | of all laws of all membranes                                                        | J
// changedSide                     | fluid particles that are not where their `side` says, by geometry (cells.hpp)       | -
// guardMoves                      | particles put back to their side of a membrane since the start; leak: both together  | -
// <cell>_area, <cell>_areaChange  | of the whole triangles; A/A(t = 0) - 1                                              | m^2, -
// <cell>_volume, _volumeChange    | enclosed, holes closed by fans; V/V(t = 0) - 1                                      | m^3, -
//
// Expected: density within 1 % (the sound speed is chosen so), changedSide 0 for an intact cell. A red cell's membrane keeps its area
// within 4 % before it fails (Evans, Waugh, Melnik, Biophys. J. 16:585, 1976: 2-4 %).
#include <algorithm>
#include <limits>

#include "core/communicator.hpp"
#include "observers/cells.hpp"
#include "observers/observer.hpp"

namespace corpuscle::observers {

namespace {

class ConservationObservation : public Observation {
  public:
    explicit ConservationObservation(const Scene& scene) : Observation({{"conservation", columnsOf(scene)}}) {}

    std::vector<Row> observe(const Scene& scene, const Time&) override {
        std::vector<double> row = ofParticles(scene);
        if (!scene.cells.empty()) addCells(scene, row);
        return {{0, std::move(row)}};
    }

  private:
    static std::vector<io::Column> columnsOf(const Scene& scene) {
        std::vector<io::Column> columns{{"density_mean", ""},   {"density_min", ""},  {"density_max", ""},
                                        {"kineticEnergy", "J"}, {"momentum_x", "Ns"}, {"momentum_y", "Ns"},
                                        {"momentum_z", "Ns"},   {"particles", ""}};
        if (!scene.cells.empty())
            columns.insert(columns.end(), {{"membraneEnergy", "J"}, {"changedSide", ""}, {"guardMoves", ""}});
        for (const coupling::Cell& cell : scene.cells) {
            const std::string& name = cell.membrane.name;
            columns.insert(columns.end(), {{name + "_area", "m2"},
                                           {name + "_areaChange", ""},
                                           {name + "_volume", "m3"},
                                           {name + "_volumeChange", ""}});
        }
        return columns;
    }

    static std::vector<double> ofParticles(const Scene& scene) {
        const Communicator ranks(scene.system->comm());
        const particles::ParticleStore& s = scene.store();
        double density = 0, energy = 0, least = std::numeric_limits<double>::infinity(), most = -least;
        long fluid = 0;
        Vec3 momentum = Vec3::Zero();
        for (std::size_t i = 0; i < s.size(); ++i) {
            const particles::Kind kind = s.kindOf(i);
            if (particles::isBoundary(kind)) continue;
            const Vec3 u = s.velocity(i);
            energy += 0.5 * scene.mass(i) * u.squaredNorm();
            momentum += scene.mass(i) * u;
            if (kind != particles::Kind::fluid) continue;
            ++fluid;
            density += s.density[i];
            least = std::min(least, s.density[i]);
            most = std::max(most, s.density[i]);
        }
        if (scene.bodies && ranks.isRoot())
            for (const bodies::Body& body : scene.bodies->all()) {
                const bodies::RigidMotion& motion = body.state.motion;
                energy += 0.5 * (body.solid.mass * motion.linear.squaredNorm() +
                                 motion.angular.dot(body.state.angularMomentum(body.solid)));
                momentum += body.solid.mass * motion.linear;
            }
        const auto sums = ranks.sum(std::vector<double>{density, static_cast<double>(fluid), energy, momentum[0],
                                                        momentum[1], momentum[2], static_cast<double>(s.size())});
        const double rest = scene.model().density;
        return {sums[0] / sums[1] / rest,
                ranks.min(least) / rest,
                ranks.max(most) / rest,
                sums[2],
                sums[3],
                sums[4],
                sums[5],
                sums[6]};
    }

    static void addCells(const Scene& scene, std::vector<double>& row) {
        const Communicator ranks(scene.system->comm());
        const particles::ParticleStore& s = scene.store();
        const TrueSides sides(scene);
        long changed = 0;
        for (std::size_t i = 0; i < s.size(); ++i)
            if (s.kindOf(i) == particles::Kind::fluid && sides.side(s.position(i)) != s.side[i]) ++changed;

        const auto measured = ofEachCell(scene, 5, [](const coupling::Cell& cell, std::size_t, double* out) {
            out[0] = cell.membrane.area();
            out[1] = out[0] / cell.initialArea - 1;
            out[2] = cell.membrane.volume();
            out[3] = out[2] / cell.initialVolume - 1;
            out[4] = cell.membrane.energy();
        });
        double energy = 0;
        for (const auto& cell : measured) energy += cell[4];
        row.insert(row.end(),
                   {energy, static_cast<double>(ranks.sum(changed)), static_cast<double>(ranks.sum(scene.putBack))});
        for (const auto& cell : measured) row.insert(row.end(), cell.begin(), cell.begin() + 4);
    }
};

struct ConservationObserver : Observer {
    static const Schema<ConservationObserver>& schema() {
        static const Schema<ConservationObserver> s =
            Schema<ConservationObserver>("conservation", "density, energy, momentum, leak, area and volume")
                .include<ObserverSettings>();
        return s;
    }
    std::unique_ptr<Observation> begin(const Scene& scene) const override {
        return std::make_unique<ConservationObservation>(scene);
    }
};

CORPUSCLE_REGISTER(Observer, ConservationObserver, "conservation", "density, energy, momentum, leak, area and volume");

}  // namespace
}  // namespace corpuscle::observers
