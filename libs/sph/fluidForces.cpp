#include "sph/fluidForces.hpp"

#include <cmath>

#include "particles/sumOverPairs.hpp"

namespace corpuscle::sph {

using particles::Kind;
using particles::ParticleStore;
using particles::ParticleSystem;
using particles::Precision;
using particles::RealArray;

namespace {
// Morris' extrapolated wall velocity is bounded where a particle has come very close to the wall.
constexpr double smallestDistanceInSpacings = 0.25, betaMax = 10;
}  // namespace

FluidForces::FluidForces(const FluidModel& model, const ParticleSystem& system) : model_(model) {
    const double H = system.support();
    variant_ = {model.kernel->kind(), system.store().optional().mass, system.store().optional().viscosity};
    constants_.support = H;
    constants_.gradientNormalisation = model.kernel->gradientNormalisation(H);
    constants_.mass = model.mass;
    const bool walls = model.walls.exist();
    if (walls) {
        constants_.normal[model.walls.axis] = 1;
        constants_.middle = (0.5 * (model.walls.low + model.walls.high) - system.box().middle()[model.walls.axis]) / H;
        constants_.half = 0.5 * (model.walls.high - model.walls.low) / H;
        constants_.smallestDistance = smallestDistanceInSpacings * system.spacing() / H;
        constants_.betaMax = betaMax;
    }
    if (system.precision() == Precision::mixed)
        float_.away = pairKernels().fluidFloat(variant_, false),
        float_.atWall = pairKernels().fluidFloat(variant_, walls);
    else
        double_.away = pairKernels().fluid(variant_, false), double_.atWall = pairKernels().fluid(variant_, walls);
}

std::size_t FluidForces::bytes() const {
    return (double_.records.capacity() + sums_.capacity()) * sizeof(double) + float_.records.capacity() * sizeof(float);
}

template <class Velocity, class Pressure>
void FluidForces::run(ParticleSystem& system, const RealArray& density, Velocity&& velocity, Pressure&& pressure,
                      double* const results[4]) {
    if (system.precision() == Precision::mixed)
        run(float_, system, density, velocity, pressure, results);
    else
        run(double_, system, density, velocity, pressure, results);
}

template <class Real, class Velocity, class Pressure>
void FluidForces::run(Pairs<Real>& pairs, ParticleSystem& system, const RealArray& density, Velocity&& velocity,
                      Pressure&& pressure, double* const results[4]) {
    const ParticleStore& s = system.store();
    const auto n = static_cast<std::size_t>(system.owned()), fields = static_cast<std::size_t>(variant_.fields());
    pairs.records.resize((n + static_cast<std::size_t>(system.ghosts())) * fields);
    const double viscous = variant_.varyingViscosity ? 1.0 : std::sqrt(2 * model_.viscosity);
    const double support = constants_.support, inverseMass = 1 / constants_.mass;
    const particles::RecordFrame frame(system);
    Real* r = pairs.records.data();
    for (std::size_t i = 0; i < n; ++i, r += fields) {
        frame.position(i, r);
        velocity(i, r + 3);
        r[6] = static_cast<Real>(support * pressure(i));
        r[7] = static_cast<Real>(viscous / density[i]);
        if (variant_.varyingMass) r[8] = static_cast<Real>(s.mass[i] * inverseMass);
        if (variant_.varyingViscosity) r[fields - 1] = static_cast<Real>(s.viscosity[i]);
    }
    for (const int i : wallParticles_) pairs.records[static_cast<std::size_t>(i) * fields + 7] *= -1;
    particles::sumOverPairs(system, pairs.away, pairs.atWall, constants_, pairs.records, variant_.fields(), sums_,
                            results);
}

void FluidForces::evaluate(ParticleSystem& system, double extrapolation) {
    ParticleStore& s = system.store();
    const auto n = static_cast<std::size_t>(system.owned());
    pressure_.resize(n);
    density_.resize(n);
    const double e = extrapolation;
    for (std::size_t i = 0; i < n; ++i) density_[i] = s.density[i] + e * s.densityRate[i];
    model_.equationOfState->specificPressure(density_.data(), pressure_.data(), system.owned(), model_.density,
                                             model_.soundSpeed);
    double* const results[4] = {s.fx.data(), s.fy.data(), s.fz.data(), s.densityRate.data()};
    run(
        system, density_,
        [&]<class Real>(std::size_t i, Real* velocity) {
            velocity[0] = static_cast<Real>(s.u[i] + e * s.fx[i]);
            velocity[1] = static_cast<Real>(s.v[i] + e * s.fy[i]);
            velocity[2] = static_cast<Real>(s.w[i] + e * s.fz[i]);
        },
        [&](std::size_t i) { return pressure_[i]; }, results);

    for (Vec3& f : wallForce_) f.setZero();
    for (const int i : wallParticles_) {
        const double mass = variant_.varyingMass ? s.mass[i] : model_.mass;
        wallForce_[model_.walls.isUpper(s.position(i))] += mass * Vec3(s.fx[i], s.fy[i], s.fz[i]);
    }
    if (!model_.bodyForce.isZero())
        for (std::size_t i = 0; i < n; ++i)
            s.fx[i] += model_.bodyForce[0], s.fy[i] += model_.bodyForce[1], s.fz[i] += model_.bodyForce[2];
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
        double* const results[4] = {image[0].data(), image[1].data(), image[2].data(), unused.data()};
        run(
            system, s.density,
            [&]<class Real>(std::size_t i, Real* v) {
                for (int k = 0; k < 3; ++k) v[k] = static_cast<Real>(vector[k][i]);
            },
            [](std::size_t) { return 0.0; }, results);
        std::swap(vector, image);
        clearWalls();
        rate = norm(vector);
    }
    return rate;
}

}  // namespace corpuscle::sph
