// Observer `rupture`: when, where and how far the membranes break, and what they let out.
//
// <cell>.csv, a row at each look:
// column                       | meaning                                                                                 | unit
// bondsBroken, trianglesLost   | so far                                                                                  | -
// holeArea                     | fans over the rims now                                                                  | m^2
// holeRestArea                 | stress-free area of the lost triangles                                                  | m^2
// released, releasedVolume     | fluid particles of this cell's inside (side n) that are outside the surface closed by   | -, m^3
//                              | fans over its rims, and the sum of their volumes m/rho                                  |
// maxBondStrain                | largest l/l0 - 1 of the living bonds                                                    | -
// firstBreak, _strain, _x,y,z  | time, strain and place (middle of the bond) of the first break; nan before              | s, -, m
//
// events.csv, a row for each bond, at the step at which it broke: cell (number, 1 and up), bond, stretch l/l0, place x, y, z [m].
//
// Numbers to compare with: bonds break at l/l0 = 1.05 in the DMP literature on red cells; a red cell's membrane bears 2-4 % of area
// strain (Evans, Waugh, Melnik, Biophys. J. 16:585, 1976).
#include <algorithm>
#include <limits>

#include "core/communicator.hpp"
#include "membrane/diagnostics.hpp"
#include "observers/cells.hpp"
#include "observers/observer.hpp"

namespace corpuscle::observers {

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t eventNumbers = 6, firstNumbers = 5;

class RuptureObservation : public Observation {
  public:
    explicit RuptureObservation(const Scene& scene) : Observation(tablesOf(scene)), first_(scene.cells.size()) {
        for (auto& first : first_) first.fill(none);
    }

    bool watchesSteps() const override { return true; }

    std::vector<Row> afterStep(const Scene& scene, const Time& time) override {
        std::vector<Row> rows = eventsOf(scene);
        for (const Row& row : rows) {
            auto& first = first_[indexOf(scene, row.values[0])];
            if (first[0] == first[0]) continue;
            first = {time.t, time.strain(), row.values[3], row.values[4], row.values[5]};
        }
        return rows;
    }

    std::vector<Row> observe(const Scene& scene, const Time&) override {
        const auto released = releasedFluid(scene);
        const auto measured = ofEachCell(scene, 5, [](const coupling::Cell& cell, std::size_t, double* out) {
            const membrane::Network& network = cell.membrane.network();
            out[0] = network.brokenBonds();
            out[1] = network.brokenTriangles();
            out[2] = network.holeArea(cell.membrane.position);
            out[3] = network.holeRestArea();
            out[4] = membrane::maxBondStrain(network, cell.membrane.position);
        });
        std::vector<Row> rows;
        for (std::size_t c = 0; c < measured.size(); ++c) {
            const auto& m = measured[c];
            rows.push_back({c, {m[0], m[1], m[2], m[3], released[2 * c], released[2 * c + 1], m[4]}});
            rows.back().values.insert(rows.back().values.end(), first_[c].begin(), first_[c].end());
        }
        return rows;
    }

    std::vector<double> state() const override {
        std::vector<double> all;
        for (const auto& first : first_) all.insert(all.end(), first.begin(), first.end());
        return all;
    }

  protected:
    void setState(std::span<const double> saved) override {
        for (std::size_t c = 0; c < first_.size(); ++c)
            std::copy_n(saved.data() + c * firstNumbers, firstNumbers, first_[c].begin());
    }

  private:
    static std::vector<Table> tablesOf(const Scene& scene) {
        std::vector<Table> tables;
        for (const coupling::Cell& cell : scene.cells)
            tables.push_back({cell.membrane.name,
                              {{"bondsBroken", ""},
                               {"trianglesLost", ""},
                               {"holeArea", "m2"},
                               {"holeRestArea", "m2"},
                               {"released", ""},
                               {"releasedVolume", "m3"},
                               {"maxBondStrain", ""},
                               {"firstBreak", "s"},
                               {"firstBreak_strain", ""},
                               {"firstBreak_x", "m"},
                               {"firstBreak_y", "m"},
                               {"firstBreak_z", "m"}}});
        tables.push_back({"events", {{"cell", ""}, {"bond", ""}, {"stretch", ""}, {"x", "m"}, {"y", "m"}, {"z", "m"}}});
        return tables;
    }

    static std::size_t indexOf(const Scene& scene, double number) {
        const auto found = std::find_if(scene.cells.begin(), scene.cells.end(), [&](const coupling::Cell& cell) {
            return cell.membrane.cell == static_cast<int>(number);
        });
        return static_cast<std::size_t>(found - scene.cells.begin());
    }

    // What broke at this step, by cell and bond, on every rank. One small reduction per step where nothing breaks.
    static std::vector<Row> eventsOf(const Scene& scene) {
        const Communicator ranks(scene.system->comm());
        if (!ranks.anyTrue(!scene.broken.empty())) return {};
        const std::vector<int> sources = sourceRanks(scene);  // all holders of a cell know of its events
        std::vector<double> own;
        for (const coupling::RuptureEvent& event : scene.broken) {
            if (sources[indexOf(scene, event.cell)] != ranks.rank()) continue;
            for (const membrane::BrokenBond& bond : event.bonds)
                own.insert(own.end(), {static_cast<double>(event.cell), static_cast<double>(bond.bond), bond.stretch,
                                       bond.place[0], bond.place[1], bond.place[2]});
        }
        std::vector<int> lengths, starts;
        int total = 0;
        for (const long length : ranks.gatherAll(static_cast<long>(own.size()))) {
            lengths.push_back(static_cast<int>(length));
            starts.push_back(total);
            total += lengths.back();
        }
        std::vector<double> all(static_cast<std::size_t>(total));
        MPI_Allgatherv(own.data(), static_cast<int>(own.size()), MPI_DOUBLE, all.data(), lengths.data(), starts.data(),
                       MPI_DOUBLE, ranks.handle());
        std::vector<Row> rows;
        for (auto event = all.begin(); event != all.end(); event += eventNumbers)
            rows.push_back({scene.cells.size(), {event, event + eventNumbers}});
        std::sort(rows.begin(), rows.end(), [](const Row& a, const Row& b) { return a.values < b.values; });
        return rows;
    }

    // Number and volume for each cell.
    static std::vector<double> releasedFluid(const Scene& scene) {
        const particles::ParticleStore& s = scene.store();
        const TrueSides sides(scene);
        std::vector<double> released(2 * scene.cells.size(), 0.0);
        for (std::size_t i = 0; i < s.size(); ++i) {
            if (s.kindOf(i) != particles::Kind::fluid || s.side[i] == 0) continue;
            const std::size_t cell = indexOf(scene, static_cast<double>(s.side[i]));
            if (cell == scene.cells.size() || sides.inside(cell, s.position(i))) continue;
            released[2 * cell] += 1;
            released[2 * cell + 1] += scene.mass(i) / s.density[i];
        }
        return Communicator(scene.system->comm()).sum(std::move(released));
    }

    std::vector<std::array<double, firstNumbers>> first_;  // of each cell: time, strain, place
};

struct RuptureObserver : Observer {
    static const Schema<RuptureObserver>& schema() {
        static const Schema<RuptureObserver> s =
            Schema<RuptureObserver>("rupture", "broken bonds, holes and released fluid").include<ObserverSettings>();
        return s;
    }
    std::string obstacle(const Subject& subject) const override { return needsCells(subject); }
    std::unique_ptr<Observation> begin(const Scene& scene) const override {
        return std::make_unique<RuptureObservation>(scene);
    }
};

CORPUSCLE_REGISTER(Observer, RuptureObserver, "rupture", "broken bonds, holes and released fluid");

}  // namespace
}  // namespace corpuscle::observers
