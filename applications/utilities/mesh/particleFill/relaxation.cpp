#include "relaxation.hpp"

#include <algorithm>
#include <limits>

#include "../cellMeshes.hpp"
#include "geometry/boundsIndex.hpp"
#include "geometry/periodicSurface.hpp"
#include "particles/sumOverPairs.hpp"
#include "simulation/sceneBuilder.hpp"

namespace corpuscle::utilities {

using geometry::TriangleMesh;
using particles::Kind;

namespace {

constexpr double strength = 0.02, largestInSpacings = 0.1;

// Distance of each point from the nearest membrane, with periodic images; infinity beyond `reach`.
std::vector<double> distances(const std::vector<Vec3>& points, const std::vector<TriangleMesh>& cells, double reach,
                              const Periodicity& period) {
    std::vector<double> distance(points.size(), std::numeric_limits<double>::infinity());
    const auto near = geometry::pointsNear(points, cells, reach, period);
    for (std::size_t c = 0; c < cells.size(); ++c) {
        const geometry::TriangleTree grid(cells[c], reach);
        const geometry::NearestImages images(grid, cells[c].nodes, period);
        for (const std::size_t i : near[c])
            if (const auto nearest = images.nearest(points[i]))
                distance[i] = std::min(distance[i], std::abs(nearest.at.distance));
    }
    return distance;
}

class SpreadSum {
  public:
    void add(double value) { ++n_, sum_ += value, square_ += value * value; }
    Spread spread() const {
        if (n_ == 0) return {};
        const double n = static_cast<double>(n_), mean = sum_ / n;
        return {n_, mean, std::sqrt(std::max(0.0, square_ / n - mean * mean))};
    }

  private:
    long n_ = 0;
    double sum_ = 0, square_ = 0;
};

}  // namespace

Relaxation::Relaxation(const simulation::Case& input, MPI_Comm comm, const std::vector<Vec3>& fluid,
                       const std::vector<Vec3>& walls, const std::vector<TriangleMesh>& cells)
    : input_(input),
      system_(comm, input.particleBox(), {.mass = true}, input.support(), input.skin(), input.spacing()) {
    const double near = reachInSpacings * input.spacing(), beyond = near + input.support(),
                 rim = beyond + input.support();
    const Periodicity period = input.particleBox().periodicity();
    const std::vector<double> fluidDistance = distances(fluid, cells, rim, period),
                              wallDistance = distances(walls, cells, rim, period);
    for (std::size_t i = 0; i < fluid.size(); ++i)
        if (const double d = fluidDistance[i]; d < rim) {
            fluidIndex_.push_back(i);
            add(Kind::fluid,
                d < near     ? Zone::near
                : d < beyond ? Zone::beyond
                             : Zone::rim,
                fluid[i], input.particleVolume());
        }
    for (std::size_t i = 0; i < walls.size(); ++i)
        if (wallDistance[i] < rim) add(Kind::wall, Zone::fixed, walls[i], input.particleVolume());
    for (const TriangleMesh& cell : cells) {
        const std::vector<double> volumes = simulation::nodeVolumes(cell.vertexAreas(), input.spacing());
        for (std::size_t k = 0; k < volumes.size(); ++k) add(Kind::membrane, Zone::fixed, cell.nodes[k], volumes[k]);
    }
    system_.start();
}

void Relaxation::add(Kind kind, Zone zone, const Vec3& x, double volume) {
    particles::ParticleStore& s = system_.store();
    const std::size_t i = s.size();
    s.resize(i + 1);
    s.setPosition(i, x);
    s.density[i] = input_.flow.density;
    s.mass[i] = input_.flow.density * volume;
    s.id[i] = static_cast<std::int64_t>(i);
    s.kind[i] = static_cast<std::int64_t>(kind);
    zone_.push_back(zone);
}

void Relaxation::sums() {
    if (system_.mustRebuild()) system_.rebuild();
    const particles::ParticleStore& s = system_.store();
    const auto n = static_cast<std::size_t>(system_.owned());
    records_.resize((n + static_cast<std::size_t>(system_.ghosts())) * 4);
    for (auto& d : disorder_) d.resize(n);
    const particles::RecordFrame frame(system_);
    for (std::size_t i = 0; i < n; ++i) {
        double* r = records_.data() + 4 * i;
        frame.position(i, r);
        r[3] = s.mass[i] / s.density[i];
    }
    const sph::Kernel& kernel = *input_.numerics.kernel;
    const double support = input_.support();
    const sph::DisorderConstants constants{support, kernel.normalisation(support),
                                           kernel.gradientNormalisation(support)};
    double* const results[4] = {disorder_[0].data(), disorder_[1].data(), disorder_[2].data(), disorder_[3].data()};
    const auto pairs = sph::pairKernels().disorder(kernel.kind(), system_.precision());
    particles::sumOverPairs(system_, pairs, pairs, constants, records_, 4, sums_, results);
}

Evenness Relaxation::evenness() {
    sums();
    SpreadSum near, beyond;
    for (std::size_t i = 0; i < system_.store().size(); ++i) {
        if (zoneOf(i) == Zone::near) near.add(disorder_[3][i]);
        if (zoneOf(i) == Zone::beyond) beyond.add(disorder_[3][i]);
    }
    return {near.spread(), beyond.spread()};
}

void Relaxation::sweep() {
    sums();
    particles::ParticleStore& s = system_.store();
    const double factor = strength * input_.support() * input_.support(), bound = largestInSpacings * input_.spacing();
    for (std::size_t i = 0; i < s.size(); ++i) {
        if (zoneOf(i) != Zone::near) continue;
        Vec3 move = factor * Vec3(disorder_[0][i], disorder_[1][i], disorder_[2][i]);
        if (const double length = move.norm(); length > bound) move *= bound / length;
        s.setPosition(i, s.position(i) + move);
    }
}

std::vector<std::pair<std::size_t, Vec3>> Relaxation::moved() const {
    std::vector<std::pair<std::size_t, Vec3>> places;
    const particles::ParticleStore& s = system_.store();
    for (std::size_t i = 0; i < s.size(); ++i)
        if (zoneOf(i) == Zone::near)
            places.emplace_back(fluidIndex_[static_cast<std::size_t>(s.id[i])],
                                system_.periodicity().wrap(s.position(i)));
    return places;
}

}  // namespace corpuscle::utilities
