#include "particles/particleSystem.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/together.hpp"
#include "particles/isa.hpp"

namespace corpuscle::particles {

namespace {
constexpr long rebuildsPerBalance = 50;
constexpr double tolerableImbalance = 1.05;
}  // namespace

ParticleSystem::ParticleSystem(MPI_Comm comm, const Box& box, ParticleStore::Optional fields, double support,
                               double skin, double spacing, Precision precision)
    : box_(box),
      periodicity_(box.periodicity()),
      support_(support),
      skin_(skin),
      spacing_(spacing),
      precision_(precision),
      store_(fields),
      decomposition_(comm, box),
      list_(blockLanes(precision)) {}

void ParticleSystem::slideImages(int axis, const Vec3& velocity) {
    slide_ = velocity;
    periodicity_.slide(axis, Vec3::Zero(), slide_);
}

void ParticleSystem::setOffset(const Vec3& offset) {
    Vec3 least = offset;
    for (int k = 0; k < 3; ++k)
        if (const double length = periodicity_.lengths()[k]; length > 0)
            least[k] -= length * std::nearbyint(least[k] / length);
    periodicity_.slide(periodicity_.slidingAxis(), least, slide_);
}

void ParticleSystem::start() {
    wrapAll();
    decomposition_.balance(store_);
    rebuild();
}

void ParticleSystem::wrap(std::size_t i) {
    Vec3 x = store_.position(i), u = store_.velocity(i);
    periodicity_.wrap(x, u);
    store_.setPosition(i, x), store_.setVelocity(i, u);
}

void ParticleSystem::resume(const std::vector<double>& bricks, long rebuilds) {
    rebuilds_ = rebuilds;
    decomposition_.restore(bricks);
    const Brick& brick = decomposition_.own();
    columns_ = Columns(brick.low[0], brick.high[0], brick.low[1], brick.high[1], 2 * spacing_);
    // The sort is stable, so particles that were saved in sorted order keep this order.
    const std::vector<int> order =
        columns_.sort(store_.xBuilt.data(), store_.yBuilt.data(), store_.zBuilt.data(), owned());
    store_.reorder(order);
    buildFrom(store_.xBuilt, store_.yBuilt, store_.zBuilt);
}

double ParticleSystem::largestDisplacement2() const {
    double most = 0;
    for (int i = 0; i < owned(); ++i) {
        const double dx = store_.x[i] - store_.xBuilt[i], dy = store_.y[i] - store_.yBuilt[i],
                     dz = store_.z[i] - store_.zBuilt[i];
        const double d2 = dx * dx + dy * dy + dz * dz;
        if (!(d2 <= std::numeric_limits<double>::max())) return std::numeric_limits<double>::infinity();  // NaN too
        most = std::max(most, d2);
    }
    return most;
}

bool ParticleSystem::mustRebuild() const { return mustRebuild(largestDisplacement2()); }

bool ParticleSystem::mustRebuild(double largestDisplacement2) const {
    double most = std::isnan(largestDisplacement2) ? std::numeric_limits<double>::infinity() : largestDisplacement2;
    MPI_Allreduce(MPI_IN_PLACE, &most, 1, MPI_DOUBLE, MPI_MAX, comm());
    return most > 0.25 * skin_ * skin_;
}

void ParticleSystem::rebuild() {
    std::string fault;
    for (std::size_t i = 0; i < store_.size(); ++i) {
        const Vec3 p = store_.position(i);
        if (!p.allFinite())
            fault = "particle " + std::to_string(store_.id[i]) + " has no finite position: the run has diverged";
        wrap(i);
    }
    throwTogether(comm(), !fault.empty(), fault, ExitCode::numerics);
    if (rebuilds_ % rebuildsPerBalance == rebuildsPerBalance - 1 &&
        decomposition_.imbalance(store_.size()) > tolerableImbalance)
        decomposition_.balance(store_);
    migrate(store_, decomposition_);
    const Brick& brick = decomposition_.own();
    columns_ = Columns(brick.low[0], brick.high[0], brick.low[1], brick.high[1], 2 * spacing_);
    store_.reorder(columns_.sort(store_.x.data(), store_.y.data(), store_.z.data(), owned()));
    store_.xBuilt = store_.x, store_.yBuilt = store_.y, store_.zBuilt = store_.z;
    buildFrom(store_.x, store_.y, store_.z);
    ++rebuilds_;
}

void ParticleSystem::buildFrom(const RealArray& x, const RealArray& y, const RealArray& z) {
    const double reach = support_ + skin_;
    const int n = owned();
    halo_.plan(x.data(), y.data(), z.data(), n, decomposition_, periodicity_, reach);
    const int g = halo_.ghostCount();
    const auto actsOnFluidOnly = [&](int i) {
        const Kind kind = store_.kindOf(static_cast<std::size_t>(i));
        return pairWithinBodies_ ? kind == Kind::wall : isBoundary(kind);
    };
    const auto total = static_cast<std::size_t>(n) + static_cast<std::size_t>(g);
    RealArray& records = buildRecords_;
    records.resize(total * 4);
    for (int i = 0; i < n; ++i) {
        double* r = records.data() + 4 * static_cast<std::size_t>(i);
        r[0] = x[i], r[1] = y[i], r[2] = z[i], r[3] = actsOnFluidOnly(i) ? 1.0 : 0.0;
    }
    halo_.exchange(records.data(), n, 4);

    RealArray(&position)[3] = buildPosition_;
    std::vector<unsigned char> wall(total);
    for (int k = 0; k < 3; ++k) {
        position[k].resize(total);
        for (std::size_t i = 0; i < total; ++i) position[k][i] = records[4 * i + static_cast<std::size_t>(k)];
    }
    for (std::size_t i = 0; i < total; ++i) wall[i] = records[4 * i + 3] > 0.5;

    const Brick& brick = decomposition_.own();
    ghostColumns_ =
        Columns(brick.low[0] - reach, brick.high[0] + reach, brick.low[1] - reach, brick.high[1] + reach, 2 * spacing_);
    const std::vector<int> order =
        ghostColumns_.sort(position[0].data() + n, position[1].data() + n, position[2].data() + n, g);
    halo_.reorder(order);
    std::vector<double> ghost(static_cast<std::size_t>(g));
    for (auto& axis : position) {
        for (int k = 0; k < g; ++k) ghost[k] = axis[n + order[k]];
        std::copy(ghost.begin(), ghost.end(), axis.begin() + n);
    }
    std::vector<unsigned char> ghostWall(static_cast<std::size_t>(g));
    for (int k = 0; k < g; ++k) ghostWall[k] = wall[n + order[k]];
    std::copy(ghostWall.begin(), ghostWall.end(), wall.begin() + n);
    if (std::find(wall.begin(), wall.end(), 1) == wall.end()) wall.clear();

    const double* const pointers[3] = {position[0].data(), position[1].data(), position[2].data()};
    list_.build(columns_, n, ghostColumns_, g, pointers, wall, halo_.imageOf(), brick, support_, reach);
    ++builds_;
}

std::size_t ParticleSystem::bytes() const { return store_.size() * store_.bytesPerParticle() + list_.bytes(); }

}  // namespace corpuscle::particles
