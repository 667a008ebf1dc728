// Observer `conservation`: what a run must conserve, and how well it does; conservation.csv, a table of area and volume
// for each type of cell, and the budget of energy and momentum, budget.csv.
//
// budget.csv has sums and changes since the start (docs/theory/conservation.md), only those that apply to the case.
// changedSide is determined by geometry (cells.hpp); leak is changedSide and guardMoves together. The volume of a torn
// cell is that with its holes closed by fans.
//
// Expected: residualShare below 0.01; momentumDrift of the size of rounding with explicit schemes, and of the solver's
// tolerance with the implicit one; density within 1 % (the sound speed is chosen so); changedSide 0 for an intact cell.
// A red cell's membrane keeps its area within 4 % before it fails (2-4 %: Evans, Waugh, Melnik, Biophys. J. 16:585,
// 1976).
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/communicator.hpp"
#include "observers/budget.hpp"
#include "observers/cells.hpp"
#include "observers/observer.hpp"

namespace corpuscle::observers {

namespace {

class ConservationObservation : public Observation {
  public:
    ConservationObservation(std::vector<Table> tables, const Scene& scene) : Observation(std::move(tables)) {
        if (scene.budget.kept) book_.emplace(scene);
    }

    std::vector<Row> observe(const Scene& scene, const Time&) override {
        std::vector<double> row = ofParticles(scene);
        std::vector<std::vector<double>> ofCells;
        if (scene.cells.exist()) ofCells = addCells(scene, row);
        std::vector<Row> rows{{0, std::move(row)}};
        for (Row& cell : rowsByType(scene, 1, ofCells)) rows.push_back(std::move(cell));
        if (book_) rows.push_back({1 + scene.cells.types().size(), book_->row(scene)});
        return rows;
    }

    std::optional<Summary> summary(const Scene& scene, const Time&) override {
        if (!book_) return {};
        return book_->summary(scene);
    }

    std::vector<double> state() const override { return book_ ? book_->state() : std::vector<double>{}; }

  protected:
    void setState(std::span<const double> saved) override {
        if (book_) book_->setState(saved);
    }

  private:
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

    // Adds the figures of all cells together to the row; returns area and volume of each.
    static std::vector<std::vector<double>> addCells(const Scene& scene, std::vector<double>& row) {
        const Communicator ranks(scene.system->comm());
        const particles::ParticleStore& s = scene.store();
        const TrueSides sides(scene);
        long changed = 0;
        for (std::size_t i = 0; i < s.size(); ++i)
            if (s.kindOf(i) == particles::Kind::fluid && sides.side(s.position(i)) != s.side[i]) ++changed;

        auto measured = ofEachCell(scene, 5, [](const coupling::Cell& cell, double* out) {
            out[0] = cell.membrane.area();
            out[1] = out[0] / cell.initialArea - 1;
            out[2] = cell.membrane.volume();
            out[3] = out[2] / cell.initialVolume - 1;
            out[4] = cell.membrane.energy();
        });
        double energy = 0, area = 0, volume = 0;
        const auto larger = [](double one, double other) { return std::abs(one) < std::abs(other) ? other : one; };
        for (std::vector<double>& cell : measured) {
            energy += cell[4];
            area = larger(area, cell[1]), volume = larger(volume, cell[3]);
            cell.resize(4);
        }
        row.insert(row.end(), {energy, static_cast<double>(ranks.sum(changed)),
                               static_cast<double>(ranks.sum(scene.movedBack)), area, volume});
        return measured;
    }

    std::optional<BudgetTable> book_;
};

std::vector<io::Column> columnsOf(const SceneParts& parts) {
    std::vector<io::Column> columns{
        {"density_mean", "", "mean density of the fluid's particles over the density at rest"},
        {"density_min", "", "least density of the fluid's particles over the density at rest"},
        {"density_max", "", "greatest density of the fluid's particles over the density at rest"},
        {"kineticEnergy", "J", "kinetic energy of fluid and membranes, sum m u^2/2, and of rigid bodies"}};
    addVector(columns, "momentum", "Ns",
              "component of the momentum of the same; walls, body force and "
              "particles that cross faces whose images slide change it");
    columns.push_back({"particles", "", "particles of all kinds"});
    if (!parts.cells.empty())
        columns.insert(columns.end(),
                       {{"membraneEnergy", "J", "elastic energy of all membranes"},
                        {"changedSide", "", "fluid particles that are not on the side of the membranes they belong to"},
                        {"guardMoves", "", "particles moved back to their side of a membrane since the start"},
                        {"areaChange", "", "A/A(t = 0) - 1 of the cell in which it is greatest in size"},
                        {"volumeChange", "", "V/V(t = 0) - 1 of the cell in which it is greatest in size"}});
    return columns;
}

std::vector<io::Column> columnsOfCells() {
    return {{"area", "m2", "area of the whole triangles"},
            {"areaChange", "", "A/A(t = 0) - 1"},
            {"volume", "m3", "enclosed volume, holes closed by fans"},
            {"volumeChange", "", "V/V(t = 0) - 1"}};
}

struct ConservationObserver : Observer {
    static const Schema<ConservationObserver>& schema() {
        static const Schema<ConservationObserver> s =
            Schema<ConservationObserver>("conservation", "density, energy, momentum, leak, area and volume")
                .include<ObserverSettings>();
        return s;
    }
    bool wantsBudget(bool) const override { return true; }
    std::vector<Table> tables(const SceneParts& parts) const override {
        std::vector<Table> all{{"conservation", columnsOf(parts)}};
        for (const std::string& type : parts.cells) all.push_back({type, cellTable(columnsOfCells())});
        if (parts.budget) all.push_back({"budget", BudgetTable::columns(parts)});
        return all;
    }
    std::unique_ptr<Observation> begin(const Scene& scene) const override {
        return std::make_unique<ConservationObservation>(tables(SceneParts::of(scene)), scene);
    }
};

CORPUSCLE_REGISTER(Observer, ConservationObserver, "conservation", "density, energy, momentum, leak, area and volume");

}  // namespace
}  // namespace corpuscle::observers
