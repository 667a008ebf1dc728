// Observer `rupture`: when, where and how far the membranes break, and what they release.
//
// At each output, <cell>.csv, one for each type of cell, has a row for each of its cells, case.csv one for all cells
// together, and holes.csv one for each rim. The number of a hole may change from one output to the next when holes
// appear or merge. events.csv has a row for each broken bond, at the step at which it broke.
//
// Areas of holes are those of fans over their present rims. Released fluid is that of interior.hpp, tension that of
// diagnostics.hpp, damage that of damage.hpp. The first break is that of the most stretched bond of its step. Positions
// on the stress-free cell are given in the box of the case, with the cell where it was at the start.
//
// The haemolysis index is that of haemolysis tests, free haemoglobin over all haemoglobin, for cells that have the same
// concentration and release it with their fluid. It counts what has gone out with the fluid through torn membranes, but
// neither what diffuses nor what passes through pores smaller than a triangle. It is the index of this flow at this
// strain, not of a device.
//
// Numbers to compare with: bonds break at l/l0 = 1.05 in the DMP literature on red cells; a red cell's membrane bears
// 2-4 % of area strain (Evans, Waugh, Melnik, Biophys. J. 16:585, 1976).
#include <fmt/format.h>

#include <algorithm>

#include "core/communicator.hpp"
#include "membrane/surface.hpp"
#include "observers/cells.hpp"
#include "observers/observer.hpp"
#include "observers/ruptureFigures.hpp"
#include "observers/summary.hpp"

namespace corpuscle::observers {

namespace {

constexpr std::size_t eventNumbers = 11, holeNumbers = 8;

void addPoint(std::vector<io::Column>& columns, const std::string& prefix, const std::string& suffix,
              const std::string& meaning) {
    for (const char axis : {'x', 'y', 'z'})
        columns.push_back(
            {fmt::format("{}{}{}", prefix, axis, suffix), "m", fmt::format("{} coordinate of {}", axis, meaning)});
}

template <class T>
void append(std::vector<T>& all, const std::vector<T>& more) {
    all.insert(all.end(), more.begin(), more.end());
}

// Columns for one cell or for all cells; `whose` says which in their meanings.
std::vector<io::Column> releaseColumns(const std::string& whose) {
    return {{"released", "", "particles of " + whose + " inside that are outside the surface; 0 until the first break"},
            {"leaked", "", "the same particles while the cell is whole: an error of the numerics"},
            {"releasedVolume", "m3", "volume of the released particles, sum of m/rho"},
            {"haemolysisIndex", "percent", "released mass over the mass inside at the start"}};
}

std::vector<io::Column> cellColumns() {
    std::vector<io::Column> columns{{"bondsBroken", "", "bonds broken so far"},
                                    {"trianglesLost", "", "triangles lost so far"},
                                    {"holes", "", "closed rims between whole and lost triangles"},
                                    {"holeArea", "m2", "area of fans over the rims of the holes, now"},
                                    {"holeRestArea", "m2", "stress-free area of the lost triangles"}};
    append(columns, releaseColumns("this cell's"));
    append(columns,
           {{"maxBondStrain", "", "largest l/l0 - 1 of the living bonds"},
            {"maxArealStrain", "", "largest A/A0 - 1 of the whole triangles"},
            {"maxTension", "N_m", "greatest principal tension of the whole triangles"},
            {"maxDamage", "", "largest damage of the whole triangles; 0 where no law keeps it"},
            {"tearLength", "m", "surface energy of the tears over the fracture energy; 0 without a cohesive law"},
            {"firstBreak", "s", "time of the first break, nan before, as all of it"},
            {"firstBreak_strain", "", "strain of the flow at the first break"},
            {"firstBreak_bond", "", "number of the bond that broke first; events.csv has its nodes"}});
    addPoint(columns, "firstBreak_", "", "the middle of the bond that broke first, as it broke");
    addPoint(columns, "firstBreak_", "0", "the middle of the bond that broke first, on the stress-free cell");
    return columns;
}

std::vector<io::Column> holeColumns() {
    std::vector<io::Column> columns{
        {"cell", "", "number of the cell, 1 and up"},
        {"hole", "", "number of the hole in its cell, 1 and up, in the order of lowest bonds"},
        {"edges", "", "edges of its rim"},
        {"perimeter", "m", "length of its rim"},
        {"area", "m2", "area of a fan over its rim"}};
    addPoint(columns, "", "", "the mean point of the rim's nodes");
    return columns;
}

std::vector<io::Column> eventColumns() {
    std::vector<io::Column> columns{{"cell", "", "number of the cell, 1 and up"},
                                    {"bond", "", "number of the bond that broke"},
                                    {"node1", "", "number of its first node"},
                                    {"node2", "", "number of its second node"},
                                    {"stretch", "", "l/l0 as it broke"}};
    addPoint(columns, "", "", "its middle as it broke");
    addPoint(columns, "", "0", "its middle on the stress-free cell");
    return columns;
}

class RuptureObservation : public Observation {
  public:
    RuptureObservation(std::vector<Table> tables, const Scene& scene)
        : Observation(std::move(tables)), first_(scene.cells.count()) {}

    bool watchesSteps() const override { return true; }

    std::vector<Row> afterStep(const Scene& scene, const Time& time) override {
        std::vector<Row> rows = eventsOf(scene);
        std::vector<double> greatest(scene.cells.count(), 0.0);  // stretch at this step
        for (const Row& row : rows) {
            const auto& v = row.values;
            const auto cell = static_cast<std::size_t>(v[0]) - 1;
            if (v[4] <= greatest[cell] || (first_[cell].happened() && greatest[cell] == 0)) continue;
            greatest[cell] = v[4];
            first_[cell] = {time.t, time.strain(), v[1], Vec3(&v[5]), Vec3(&v[8])};
        }
        return rows;
    }

    bool leavesGaps() const override { return true; }
    std::vector<Row> observe(const Scene& scene, const Time&) override {
        const std::size_t types = scene.cells.types().size();
        const std::vector<Interior> interior = interiors(scene);
        const std::vector<Losses> lost = losses(scene);
        std::vector<std::vector<double>> ofCells;
        for (std::size_t c = 0; c < scene.cells.count(); ++c) {
            const Interior& in = interior[c];
            const Losses& d = lost[c];
            ofCells.push_back({d.bonds, d.triangles, d.holes, d.holeArea, d.holeRestArea, in.released, in.leaked,
                               in.releasedVolume, in.haemolysisIndex(), d.bondStrain, d.arealStrain, d.tension,
                               d.damage, d.tearLength});
            append(ofCells.back(), first_[c].numbers());
        }
        std::vector<Row> rows = rowsByType(scene, 0, ofCells);
        for (auto& hole : holesOf(scene)) rows.push_back({types + 1, std::move(hole)});
        const Interior all = total(interior);
        rows.push_back({types + 2,
                        {static_cast<double>(brokenOf(lost)), all.released, all.leaked, all.releasedVolume,
                         all.haemolysisIndex()}});
        return rows;
    }

    std::optional<Summary> summary(const Scene& scene, const Time&) override {
        constexpr int mostLines = 10;
        const std::vector<Interior> interior = interiors(scene);
        const std::vector<Losses> lost = losses(scene);
        const Interior all = total(interior);
        Summary summary;
        for (std::size_t c = 0; c < scene.cells.count(); ++c) {
            const std::string name = scene.cells.nameOf(static_cast<int>(c) + 1);
            summary.figures["cells"][name] = figures(interior[c], lost[c], first_[c]);
            if (first_[c].happened() && summary.lines.size() < mostLines)
                summary.lines.push_back(fmt::format("{}: {}", name, sentence(interior[c], lost[c], first_[c])));
        }
        const auto first = std::min_element(first_.begin(), first_.end(), [](const FirstBreak& a, const FirstBreak& b) {
            return a.happened() && (!b.happened() || a.time < b.time);
        });
        const int broken = brokenOf(lost);
        summary.figures["firstBreak_s"] = first->time;
        summary.figures["firstBreak_strain"] = first->strain;
        summary.figures["cellsBroken"] = broken;
        summary.figures["released"] = all.released;
        summary.figures["leaked"] = all.leaked;
        summary.figures["releasedVolume_m3"] = all.releasedVolume;
        summary.figures["haemolysisIndex_percent"] = all.haemolysisIndex();
        summary.lines.push_back(
            broken == 0 ? fmt::format("no membrane broke; greatest strain now: bond {:.4g}, area {:.4g}",
                                      greatest(lost, &Losses::bondStrain), greatest(lost, &Losses::arealStrain))
                        : fmt::format("{} of {} cells broke, first at strain {:.6g}; haemolysis index {:.4g} %", broken,
                                      scene.cells.count(), first->strain, all.haemolysisIndex()));
        return summary;
    }

    std::vector<double> state() const override {
        std::vector<double> all;
        for (const FirstBreak& first : first_) append(all, first.numbers());
        return all;
    }

  protected:
    void setState(std::span<const double> saved) override {
        for (std::size_t c = 0; c < first_.size(); ++c) first_[c] = FirstBreak::of(&saved[c * FirstBreak::count]);
    }

  private:
    static int brokenOf(const std::vector<Losses>& lost) {
        return static_cast<int>(std::count_if(lost.begin(), lost.end(), [](const Losses& l) { return l.bonds > 0; }));
    }
    static double greatest(const std::vector<Losses>& lost, double Losses::*member) {
        double most = lost.front().*member;
        for (const Losses& one : lost) most = std::max(most, one.*member);
        return most;
    }

    // The bonds that broke in this step, by cell and bond, on every rank. Needs one small reduction in a step where
    // none breaks.
    static std::vector<Row> eventsOf(const Scene& scene) {
        const Communicator ranks(scene.system->comm());
        if (!ranks.anyTrue(!scene.broken.empty())) return {};
        std::vector<double> own;
        for (const coupling::RuptureEvent& event : scene.broken) {  // all holders of a cell know of its events
            const coupling::Cell* const cell = scene.cells.find(event.cell);
            if (!cell || !cell->isOwnedBy(ranks.rank())) continue;
            const membrane::Network& network = cell->membrane.network();
            const coupling::CellType& type = scene.cells.types()[cell->type];
            geometry::Place place = type.places[static_cast<std::size_t>(event.cell - type.firstCell)];
            place.scale = 1;  // the network is scaled already
            for (const membrane::BrokenBond& bond : event.bonds) {
                const auto [a, b] = network.allBonds()[static_cast<std::size_t>(bond.bond)].node;
                const Vec3 rest = place.of({0.5 * (network.stressFree()[static_cast<std::size_t>(a)] +
                                                   network.stressFree()[static_cast<std::size_t>(b)])})[0];
                append(own, {static_cast<double>(event.cell), static_cast<double>(bond.bond), static_cast<double>(a),
                             static_cast<double>(b), bond.stretch, bond.place[0], bond.place[1], bond.place[2], rest[0],
                             rest[1], rest[2]});
            }
        }
        std::vector<Row> rows;
        for (auto& event : table(scene, own, eventNumbers))
            rows.push_back({scene.cells.types().size(), std::move(event)});
        return rows;
    }

    static std::vector<std::vector<double>> holesOf(const Scene& scene) {
        const int rank = Communicator(scene.system->comm()).rank();
        std::vector<double> own;
        for (const coupling::Cell& cell : scene.cells) {
            const membrane::Membrane& m = cell.membrane;
            if (!cell.isOwnedBy(rank) || m.network().brokenTriangles() == 0) continue;
            double number = 0;
            for (const std::vector<int>& rim : m.network().rims()) {
                const Vec3 middle = membrane::meanPoint(m.position, rim);
                append(own, {static_cast<double>(m.cell), ++number, static_cast<double>(rim.size()),
                             membrane::loopLength(m.position, rim), membrane::fanArea(m.position, rim), middle[0],
                             middle[1], middle[2]});
            }
        }
        return table(scene, own, holeNumbers);
    }

    // Rows of all ranks, ordered by their first numbers.
    static std::vector<std::vector<double>> table(const Scene& scene, const std::vector<double>& own,
                                                  std::size_t width) {
        const std::vector<double> all = gatherNumbers(scene, own);
        std::vector<std::vector<double>> rows;
        for (auto row = all.begin(); row != all.end(); row += static_cast<std::ptrdiff_t>(width))
            rows.emplace_back(row, row + static_cast<std::ptrdiff_t>(width));
        std::sort(rows.begin(), rows.end());
        return rows;
    }

    std::vector<FirstBreak> first_;  // of each cell of the scene
};

struct RuptureObserver : Observer {
    static const Schema<RuptureObserver>& schema() {
        static const Schema<RuptureObserver> s =
            Schema<RuptureObserver>("rupture", "broken bonds, holes, released fluid, haemolysis index")
                .include<ObserverSettings>();
        return s;
    }
    std::string whyNot(const Subject& subject) const override { return needsCells(subject); }
    std::vector<Table> tables(const SceneParts& parts) const override {
        std::vector<io::Column> ofAll{{"cellsBroken", "", "cells with a broken bond"}};
        append(ofAll, releaseColumns("all cells'"));
        std::vector<Table> all;
        for (const std::string& type : parts.cells) all.push_back({type, cellTable(cellColumns())});
        all.push_back({"events", eventColumns()});
        all.push_back({"holes", holeColumns()});
        all.push_back({"case", ofAll});
        return all;
    }
    std::unique_ptr<Observation> begin(const Scene& scene) const override {
        return std::make_unique<RuptureObservation>(tables(SceneParts::of(scene)), scene);
    }
};

CORPUSCLE_REGISTER(Observer, RuptureObserver, "rupture", "broken bonds, holes, released fluid, haemolysis index");

}  // namespace
}  // namespace corpuscle::observers
