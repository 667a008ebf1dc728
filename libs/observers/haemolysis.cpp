// Observer `haemolysis`: the solute (haemoglobin) that cells have lost, through pores (membrane/poreLaw.hpp) and
// through holes (rupture). At each output, <cell>.csv, one for each type of cell, has a row for each of its cells, and
// case.csv one for all cells together.
//
//     index = pores + holes,   pores = 100 (1 - m/m0),   holes = 100 m_released/m0
// symbol     | meaning                                                                                     | unit
// m0         | solute inside at t = 0                                                                      | kg
// m          | solute of the fluid that was inside at t = 0, wherever it is now: the rest has left by pores | kg
// m_released | solute of that fluid outside the surface of a torn cell, its holes closed by fans           | kg
// The index is that of haemolysis tests, free haemoglobin over all haemoglobin, without what was free at the start. It
// is the index of this flow at this time, not of a device. An index below 0 says that more has come in than gone out.
#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <optional>

#include "core/communicator.hpp"
#include "observers/cells.hpp"
#include "observers/observer.hpp"
#include "observers/summary.hpp"

namespace corpuscle::observers {

namespace {

struct Content {
    double start = 0, solute = 0, released = 0;  // m0, m, m_released [kg]
    double volume = 0;                           // of the fluid, m/rho0 [m^3]

    void operator+=(const Content& o) {
        start += o.start, solute += o.solute, released += o.released, volume += o.volume;
    }
    double inside() const { return solute - released; }
    double byPores() const { return start > 0 ? 100 * (1 - solute / start) : 0; }
    double concentration() const { return volume > 0 ? solute / volume : std::numeric_limits<double>::quiet_NaN(); }
    double byHoles() const { return start > 0 ? 100 * released / start : 0; }
    double index() const { return byPores() + byHoles(); }
};
constexpr std::size_t numbers = 4;
static_assert(sizeof(Content) == numbers * sizeof(double));

// Of the fluid outside (first), and of each cell, on every rank. Collective.
std::vector<Content> contents(const Scene& scene) {
    const particles::ParticleStore& s = scene.store();
    const coupling::SoluteTransport& solute = *scene.solute;
    const auto torn = ofEachCell(
        scene, 1, [](const coupling::Cell& cell, double* out) { *out = cell.membrane.network().wasOpen() ? 1 : 0; });
    bool some = false;
    for (const auto& cell : torn) some = some || cell[0] > 0;
    std::optional<TrueSides> sides;
    if (some) sides.emplace(scene);
    std::vector<double> concentration{solute.solute().concentration};
    for (const coupling::CellType& type : scene.cells.types())
        concentration.insert(concentration.end(), type.places.size(), type.settings.interior.concentration.value_or(0));
    std::vector<Content> all(scene.cells.count() + 1);
    for (std::size_t i = 0; i < s.size(); ++i) {
        if (s.kindOf(i) != particles::Kind::fluid) continue;
        const auto side = static_cast<std::size_t>(s.side[i]);
        Content& of = all[side];
        const double volume = solute.volume(s, i);
        of.start += concentration[side] * volume;
        of.solute += s.solute[i];
        of.volume += volume;
        if (side > 0 && torn[side - 1][0] > 0 && !sides->inside(static_cast<int>(side), s.position(i)))
            of.released += s.solute[i];
    }
    Communicator(scene.system->comm()).addUp({reinterpret_cast<double*>(all.data()), numbers * all.size()});
    return all;
}

std::vector<io::Column> lossColumns(const std::string& whose) {
    return {{"haemolysisIndex", "percent", "solute of " + whose + " that has left, over that inside at the start"},
            {"byPores", "percent", "the part that has left through pores"},
            {"byHoles", "percent", "the part that has left with the fluid through holes"}};
}

class HaemolysisObservation : public Observation {
  public:
    using Observation::Observation;

    bool leavesGaps() const override { return true; }  // of a cell without triangles or fluid

    std::vector<Row> observe(const Scene& scene, const Time&) override {
        const std::size_t types = scene.cells.types().size();
        const std::vector<Content> all = contents(scene);
        const auto pores = ofEachCell(scene, 3, [](const coupling::Cell& cell, double* out) {
            const membrane::Membrane& m = cell.membrane;
            out[0] = m.poreArea(), out[1] = out[0] / m.area();
            out[2] = m.pores().empty() ? 0 : *std::max_element(m.pores().begin(), m.pores().end());
        });
        std::vector<std::vector<double>> ofCells;
        Content cells;
        for (std::size_t c = 0; c < pores.size(); ++c) {
            const Content& in = all[c + 1];
            cells += in;
            ofCells.push_back({in.index(), in.byPores(), in.byHoles(), in.inside(), in.concentration(), pores[c][0],
                               pores[c][1], pores[c][2]});
        }
        std::vector<Row> rows = rowsByType(scene, 0, ofCells);
        const Content& out = all[0];
        rows.push_back({types,
                        {cells.index(), cells.byPores(), cells.byHoles(), out.solute + cells.released,
                         out.concentration(), cells.solute + out.solute}});
        return rows;
    }

    std::optional<Summary> summary(const Scene& scene, const Time&) override {
        const std::vector<Content> all = contents(scene);
        Summary summary;
        Content cells;
        for (std::size_t c = 1; c < all.size(); ++c) {
            cells += all[c];
            summary.figures["cells"][scene.cells.nameOf(static_cast<int>(c))] = {
                {"haemolysisIndex_percent", all[c].index()},
                {"byPores_percent", all[c].byPores()},
                {"byHoles_percent", all[c].byHoles()}};
        }
        summary.figures["haemolysisIndex_percent"] = cells.index();
        summary.figures["solute_kg"] = cells.solute + all[0].solute;
        summary.figures["mostPartsOfAStep"] = scene.solute->mostParts();
        summary.lines.push_back(fmt::format("haemolysis index {:.4g} %: {:.4g} % through pores, {:.4g} % through holes",
                                            cells.index(), cells.byPores(), cells.byHoles()));
        return summary;
    }
};

struct HaemolysisObserver : Observer {
    static const Schema<HaemolysisObserver>& schema() {
        static const Schema<HaemolysisObserver> s =
            Schema<HaemolysisObserver>("haemolysis", "solute that cells have lost, pores, haemolysis index")
                .include<ObserverSettings>();
        return s;
    }
    std::string whyNot(const Subject& subject) const override {
        if (subject.cells && !subject.solute)
            return "this observer follows the solute of the cells, and the fluid carries none; remove it, or add "
                   "'solute' to constant/fluid.yaml";
        return needsCells(subject);
    }
    std::vector<Table> tables(const SceneParts& parts) const override {
        std::vector<io::Column> each = lossColumns("this cell");
        each.insert(each.end(),
                    {{"solute", "kg", "solute inside"},
                     {"concentration", "kg_m3", "mean concentration of the fluid that was inside at the start"},
                     {"poreArea", "m2", "area of all pores; 0 in a torn cell"},
                     {"poreShare", "", "the same over the area of the membrane"},
                     {"poreShare_max", "", "largest share of any node"}});
        std::vector<io::Column> whole = lossColumns("all cells");
        whole.insert(whole.end(), {{"freeSolute", "kg", "solute outside the cells"},
                                   {"concentration_outside", "kg_m3",
                                    "mean concentration of the fluid that was outside at the start"},
                                   {"solute", "kg", "solute in all of the fluid; constant to rounding"}});
        std::vector<Table> all;
        for (const std::string& type : parts.cells) all.push_back({type, cellTable(each)});
        all.push_back({"case", whole});
        return all;
    }
    std::unique_ptr<Observation> begin(const Scene& scene) const override {
        return std::make_unique<HaemolysisObservation>(tables(SceneParts::of(scene)));
    }
};

CORPUSCLE_REGISTER(Observer, HaemolysisObserver, "haemolysis", "solute that cells have lost, pores, haemolysis index");

}  // namespace
}  // namespace corpuscle::observers
