// Observer `cellFreeLayer`: thickness of the layer beside the walls that cells leave free. Files: cellFreeLayer.csv and
// slices.csv, which has a row for each slice.
//
// The vessel is divided into slices along x, and each slice into sectors: by the angle about the axis of the box, or,
// between two planes, into strips beside either of them. In each sector
//     d = least distance of a node of a membrane from the walls
// is where the core of cells ends; its mean is taken over all sectors in which there is a node. In slices that hold no
// cell there is no core: `covered` is the share of sectors that have one. This is meant for one vessel along the axis
// of the box, not for branches beside it.
//
// setting | meaning                            | default
// slices  | number of slices                   | 20
// sectors | of each slice; strips at each plane | 8
//
// Numbers to compare with: a core of viscosity mu_c in a tube of radius R, beside a layer of the viscosity mu of plasma
// and the thickness d, has the apparent viscosity mu/(1 - (1 - d/R)^4 (1 - mu/mu_c)) and the tube haematocrit
// (1 - d/R)^2 times its own.
#include <cmath>
#include <limits>
#include <numbers>

#include "core/communicator.hpp"
#include "observers/cells.hpp"
#include "observers/observer.hpp"

namespace corpuscle::observers {

namespace {

constexpr double none = std::numeric_limits<double>::infinity();

class CellFreeLayerObservation : public Observation {
  public:
    CellFreeLayerObservation(std::vector<Table> tables, int slices, int sectors)
        : Observation(std::move(tables)), slices_(slices), sectors_(sectors) {}

    bool leavesGaps() const override { return true; }  // slices without cells
    std::vector<Row> observe(const Scene& scene, const Time&) override {
        const particles::Box& box = scene.fluidBox;
        const std::vector<double> least = findLeast(scene);
        const std::size_t each = least.size() / static_cast<std::size_t>(slices_);
        double sum = 0, squares = 0, count = 0, thinnest = none;
        std::vector<Row> rows(1);
        for (int k = 0; k < slices_; ++k) {
            double own = 0, number = 0;
            for (std::size_t s = 0; s < each; ++s)
                if (const double d = least[static_cast<std::size_t>(k) * each + s]; d < none)
                    own += d, ++number, squares += d * d, thinnest = std::min(thinnest, d);
            sum += own, count += number;
            rows.push_back({1, {box.low[0] + (k + 0.5) * box.size()[0] / slices_, mean(own, number)}});
        }
        const double thickness = mean(sum, count);
        rows[0] = {0,
                   {thickness, std::sqrt(std::max(0.0, mean(squares, count) - thickness * thickness)),
                    count > 0 ? thinnest : std::numeric_limits<double>::quiet_NaN(),
                    count / static_cast<double>(least.size())}};
        return rows;
    }

  private:
    static double mean(double sum, double count) {
        return count > 0 ? sum / count : std::numeric_limits<double>::quiet_NaN();
    }
    // Least distance of a node from the walls, by slice and sector. Collective.
    std::vector<double> findLeast(const Scene& scene) const {
        const boundary::Walls& walls = scene.flow.walls;
        const bool planes = walls.count() == 2;
        const particles::Box& box = scene.fluidBox;
        const int along = planes ? 3 - scene.flow.gradient : 0;  // across the strips; x is 0, so that y and z remain
        const auto sectorOf = [&](const Vec3& x) {
            if (planes)
                return walls.nearest(x).number * sectors_ +
                       indexOf((box.wrap(x[along], along) - box.low[along]) / box.size()[along], sectors_);
            const Vec3 r = x - box.middle();
            return indexOf(std::atan2(r[2], r[1]) / (2 * std::numbers::pi) + 0.5, sectors_);
        };
        const int each = planes ? 2 * sectors_ : sectors_;
        std::vector<double> least(static_cast<std::size_t>(slices_) * static_cast<std::size_t>(each), none);
        const int rank = scene.system->decomposition().rank();
        for (const coupling::Cell& cell : scene.cells) {
            if (!cell.isOwnedBy(rank)) continue;
            for (const Vec3& x : cell.membrane.position) {
                const int slice = indexOf((box.wrap(x[0], 0) - box.low[0]) / box.size()[0], slices_);
                double& d = least[static_cast<std::size_t>(slice) * static_cast<std::size_t>(each) +
                                  static_cast<std::size_t>(sectorOf(x))];
                d = std::min(d, walls.distance(Vec3(box.wrap(x[0], 0), x[1], x[2])));
            }
        }
        return Communicator(scene.system->comm()).min(std::move(least));
    }
    static int indexOf(double share, int count) { return std::clamp(static_cast<int>(share * count), 0, count - 1); }

    int slices_, sectors_;
};

struct CellFreeLayerObserver : Observer {
    int slices = 20, sectors = 8;

    static const Schema<CellFreeLayerObserver>& schema() {
        static const Schema<CellFreeLayerObserver> s =
            Schema<CellFreeLayerObserver>("cellFreeLayer", "thickness of the layer beside the walls without cells")
                .include<ObserverSettings>()
                .integer("slices", &CellFreeLayerObserver::slices, "number of slices along x",
                         {.fallback = "20", .range = between(1, 10000)})
                .integer("sectors", &CellFreeLayerObserver::sectors,
                         "of each slice, by the angle about the axis of the box; strips at each of two planes",
                         {.fallback = "8", .range = between(1, 10000)});
        return s;
    }
    std::string whyNot(const Subject& subject) const override {
        if (!subject.channel && !subject.planeWalls)
            return "this observer looks at the layer beside walls, and the flow has none; remove it, or give the flow "
                   "of constant/flow.yaml walls";
        return needsCells(subject);
    }
    std::vector<Table> tables(const SceneParts&) const override {
        return {{"cellFreeLayer",
                 {{"thickness", "m", "mean over all sectors with cells; nan without any"},
                  {"deviation", "m", "standard deviation over the sectors"},
                  {"least", "m", "the least of all"},
                  {"covered", "", "share of the sectors with cells"}}},
                {"slices",
                 {{"position", "m", "middle of the slice on the x axis"},
                  {"thickness", "m", "mean over the sectors of the slice; nan without cells"}}}};
    }
    std::unique_ptr<Observation> begin(const Scene& scene) const override {
        return std::make_unique<CellFreeLayerObservation>(tables(SceneParts::of(scene)), slices, sectors);
    }
};

CORPUSCLE_REGISTER(Observer, CellFreeLayerObserver, "cellFreeLayer",
                   "thickness of the layer beside the walls without cells");

}  // namespace
}  // namespace corpuscle::observers
