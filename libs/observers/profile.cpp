// Observer `profile`: mean velocity and density of the fluid's particles in slabs across an axis, and which part of the
// fluid is inside cells (haematocrit); one file, profile.csv, with one row for each slab at each output. Slabs divide
// the fluid between the walls evenly. In gnuplot, after `set datafile columnheaders`:
//     plot 'profile.csv' using 4:3 every ::N*n::N*n+N-1 with linespoints      (output n, N slabs, u over position)
//
// setting | meaning                           | default
// axis    | across the slabs: x, y or z       | z
// bins    | number of slabs                   | 32
//
// Numbers to compare with, at the middle of a slab: u = gammadot g in plane Couette flow;
// u = b rho/(2 mu) (g - low)(high - g) in plane Poiseuille flow, from which b rho/(2 mu) width^2/12 is subtracted for
// the mean over the slab.
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/communicator.hpp"
#include "observers/observer.hpp"

namespace corpuscle::observers {

namespace {

class ProfileObservation : public Observation {
  public:
    ProfileObservation(std::vector<Table> tables, int axis, int bins)
        : Observation(std::move(tables)), axis_(axis), bins_(bins) {}

    bool leavesGaps() const override { return true; }
    std::vector<Row> observe(const Scene& scene, const Time&) override {
        constexpr std::size_t numbers = 7;
        const bool hasCells = scene.cells.exist();
        const particles::ParticleStore& s = scene.store();
        const particles::Box& box = scene.fluidBox;
        const double low = box.low[axis_], width = box.size()[axis_] / bins_;
        std::vector<double> sums(numbers * static_cast<std::size_t>(bins_), 0.0);
        for (std::size_t i = 0; i < s.size(); ++i) {
            if (s.kindOf(i) != particles::Kind::fluid) continue;
            const double bin = std::floor((box.wrap(s.position(i)[axis_], axis_) - low) / width);
            double* const sum = sums.data() + numbers * static_cast<std::size_t>(std::clamp(bin, 0.0, bins_ - 1.0));
            sum[0] += s.u[i], sum[1] += s.v[i], sum[2] += s.w[i];
            sum[3] += s.density[i];
            sum[4] += 1;
            const double volume = scene.mass(i) / s.density[i];
            sum[5] += volume;
            if (hasCells && s.side[i] > 0) sum[6] += volume;
        }
        sums = Communicator(scene.system->comm()).sum(std::move(sums));
        std::vector<Row> rows;
        for (int b = 0; b < bins_; ++b) {
            const double* const sum = sums.data() + numbers * static_cast<std::size_t>(b);
            const double scale = sum[4] > 0 ? 1 / sum[4] : std::numeric_limits<double>::quiet_NaN();
            std::vector<double> row{low + (b + 0.5) * width, sum[0] * scale, sum[1] * scale,
                                    sum[2] * scale,          sum[3] * scale, sum[4]};
            if (hasCells) row.push_back(sum[6] * scale / (sum[5] * scale));
            rows.push_back({0, std::move(row)});
        }
        return rows;
    }

  private:
    int axis_, bins_;
};

struct ProfileObserver : Observer {
    std::string axis = "z";
    int bins = 32;

    static const Schema<ProfileObserver>& schema() {
        static const Schema<ProfileObserver> s =
            Schema<ProfileObserver>("profile", "mean velocity and density of the fluid in slabs")
                .include<ObserverSettings>()
                .word("axis", &ProfileObserver::axis, {"x", "y", "z"}, "across the slabs", {.fallback = "z"})
                .integer("bins", &ProfileObserver::bins, "number of slabs", {.fallback = "32", .range = atLeast(1)});
        return s;
    }
    std::vector<Table> tables(const SceneParts& parts) const override {
        std::vector<io::Column> columns{
            {"position", "m", "middle of the slab on the axis across the slabs"},
            {"u", "m_s", "mean of the velocity along x over the fluid's particles in the slab; nan without any"},
            {"v", "m_s", "mean of the velocity along y"},
            {"w", "m_s", "mean of the velocity along z"},
            {"density", "kg_m3", "mean density"},
            {"count", "", "particles of the fluid in the slab"}};
        if (!parts.cells.empty())
            columns.push_back({"haematocrit", "", "volume of the fluid inside cells over that of all fluid"});
        return {{"profile", std::move(columns)}};
    }
    std::unique_ptr<Observation> begin(const Scene& scene) const override {
        return std::make_unique<ProfileObservation>(tables(SceneParts::of(scene)), axis[0] - 'x', bins);
    }
};

CORPUSCLE_REGISTER(Observer, ProfileObserver, "profile", "mean velocity and density of the fluid in slabs");

}  // namespace
}  // namespace corpuscle::observers
