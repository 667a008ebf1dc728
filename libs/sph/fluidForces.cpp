#include "sph/fluidForces.hpp"

#include <cmath>

namespace corpuscle::sph {

using particles::Kind;
using particles::PairList;
using particles::ParticleStore;
using particles::ParticleSystem;
using particles::RealArray;

namespace {
// Morris' extrapolated wall velocity is bounded where a particle has come very close to the wall.
constexpr double smallestDistanceInSpacings = 0.25, betaMax = 10;
}  // namespace

FluidForces::FluidForces(const FluidModel& model, const ParticleSystem& system) : model_(model) {
    const double H = system.support();
    variant_ = {model.kernel->kind(), system.store().optional().mass, system.store().optional().viscosity};
    constants_.inverseSupport = 1 / H;
    constants_.gradientNormalisation = model.kernel->gradientNormalisation(H);
    constants_.mass = model.mass;
    if (model.walls.exist()) {
        constants_.normal[model.walls.axis] = 1;
        constants_.middle = 0.5 * (model.walls.low + model.walls.high);
        constants_.half = 0.5 * (model.walls.high - model.walls.low);
        constants_.smallestDistance = smallestDistanceInSpacings * system.spacing();
        constants_.betaMax = betaMax;
    }
    kernel_[0] = pairKernels().fluid(variant_, false);
    kernel_[1] = pairKernels().fluid(variant_, model.walls.exist());
}

template <class Velocity, class Pressure>
void FluidForces::pack(const ParticleStore& store, const RealArray& density, Velocity&& velocity, Pressure&& pressure) {
    const int fields = variant_.fields(), n = static_cast<int>(store.size());
    const bool varyingMass = variant_.varyingMass, varyingViscosity = variant_.varyingViscosity;
    const double viscous = varyingViscosity ? 1.0 : std::sqrt(2 * model_.viscosity);
    double* r = records_.data();
    for (int i = 0; i < n; ++i, r += fields) {
        r[0] = store.x[i], r[1] = store.y[i], r[2] = store.z[i];
        velocity(i, r + 3);
        r[6] = pressure(i);
        r[7] = viscous / density[i];
        if (varyingMass) r[8] = store.mass[i];
        if (varyingViscosity) r[fields - 1] = store.viscosity[i];
    }
    for (const int i : wallParticles_) records_[static_cast<std::size_t>(i) * static_cast<std::size_t>(fields) + 7] *= -1;
}

void FluidForces::run(ParticleSystem& system, double* const results[4]) {
    system.forEachPair(records_.data(), variant_.fields(), [&](PairList::Group group) {
        const std::vector<int>& blocks = system.list().blocks(group);
        const bool atWall = group == PairList::interiorAtWall || group == PairList::boundaryAtWall;
        kernel_[atWall](constants_, system.list().view(), blocks.data(), static_cast<int>(blocks.size()), records_.data(), results);
    });
}

void FluidForces::evaluate(ParticleSystem& system, double extrapolation) {
    ParticleStore& s = system.store();
    const auto n = static_cast<std::size_t>(system.owned());
    records_.resize((n + static_cast<std::size_t>(system.ghosts())) * static_cast<std::size_t>(variant_.fields()));
    pressure_.resize(n);
    density_.resize(n);
    const double e = extrapolation;
    for (std::size_t i = 0; i < n; ++i) density_[i] = s.density[i] + e * s.densityRate[i];
    model_.equationOfState->specificPressure(density_.data(), pressure_.data(), system.owned(), model_.density, model_.soundSpeed);
    pack(
        s, density_,
        [&](int i, double* velocity) {
            velocity[0] = s.u[i] + e * s.fx[i];
            velocity[1] = s.v[i] + e * s.fy[i];
            velocity[2] = s.w[i] + e * s.fz[i];
        },
        [&](int i) { return pressure_[i]; });
    double* const results[4] = {s.fx.data(), s.fy.data(), s.fz.data(), s.densityRate.data()};
    run(system, results);

    for (Vec3& f : wallForce_) f.setZero();
    for (const int i : wallParticles_) {
        const double mass = variant_.varyingMass ? s.mass[i] : model_.mass;
        wallForce_[model_.walls.isUpper(s.position(i))] += mass * Vec3(s.fx[i], s.fy[i], s.fz[i]);
    }
    if (!model_.bodyForce.isZero())
        for (std::size_t i = 0; i < n; ++i) s.fx[i] += model_.bodyForce[0], s.fy[i] += model_.bodyForce[1], s.fz[i] += model_.bodyForce[2];
    for (const int i : wallParticles_) s.fx[i] = s.fy[i] = s.fz[i] = 0;
}

void FluidForces::findWalls(const ParticleSystem& system) {
    wallParticles_.clear();
    if (!model_.walls.exist()) return;
    for (int i = 0; i < system.owned(); ++i)
        if (system.store().kindOf(i) == Kind::wall) wallParticles_.push_back(i);
}

double FluidForces::viscousRate(ParticleSystem& system, int iterations) {
    const ParticleStore& s = system.store();
    const auto n = static_cast<std::size_t>(system.owned());
    records_.resize((n + static_cast<std::size_t>(system.ghosts())) * static_cast<std::size_t>(variant_.fields()));
    RealArray vector[3], image[3], unused(n);
    for (int k = 0; k < 3; ++k) vector[k].resize(n), image[k].resize(n);
    const auto clearWalls = [&] {
        for (const int i : wallParticles_)
            for (auto& component : vector) component[i] = 0;
    };
    // Random signs from a hash of the particle's number: the same on any number of ranks.
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t k = 0; k < 3; ++k) {
            auto h = (static_cast<std::uint64_t>(s.id[i]) * 3 + k) * 0x9E3779B97F4A7C15ull;
            h = (h ^ (h >> 29)) * 0xBF58476D1CE4E5B9ull;
            vector[k][i] = (h >> 40) % 2 ? 1.0 : -1.0;
        }
    clearWalls();
    const auto norm = [&](const RealArray* v) {
        double sum = 0;
        for (int k = 0; k < 3; ++k)
            for (const double a : v[k]) sum += a * a;
        MPI_Allreduce(MPI_IN_PLACE, &sum, 1, MPI_DOUBLE, MPI_SUM, system.comm());
        return std::sqrt(sum);
    };
    double rate = 0;
    for (int it = 0; it < iterations; ++it) {
        const double length = norm(vector);
        if (length == 0) return 0;
        for (auto& component : vector)
            for (double& a : component) a /= length;
        pack(s, s.density, [&](int i, double* v) { for (int k = 0; k < 3; ++k) v[k] = vector[k][i]; }, [](int) { return 0.0; });
        double* const results[4] = {image[0].data(), image[1].data(), image[2].data(), unused.data()};
        run(system, results);
        std::swap(vector, image);
        clearWalls();
        rate = norm(vector);
    }
    return rate;
}

}  // namespace corpuscle::sph
