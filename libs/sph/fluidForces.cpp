#include "sph/fluidForces.hpp"

#include <algorithm>
#include <cmath>

#include "core/communicator.hpp"
#include "core/powerIteration.hpp"
#include "particles/sumOverPairs.hpp"
#include "sph/randomSigns.hpp"

namespace corpuscle::sph {

using particles::Kind;
using particles::ParticleStore;
using particles::ParticleSystem;
using particles::Precision;
using particles::RealArray;

FluidForces::FluidForces(const FluidModel& model, const ParticleSystem& system, RigidGroups* groups)
    : model_(model),
      groups_(groups),
      wallForces_(model.walls.count(), Vec3::Zero()),
      rates_(Budget::zero(model.walls.count())) {
    const double H = system.support();
    variant_ = {model.kernel->kind(), system.store().optional().mass, system.store().optional().viscosity,
                groups                ? Boundaries::bodies
                : model.walls.exist() ? Boundaries::walls
                                      : Boundaries::none};
    constants_.support = H;
    constants_.gradientNormalisation = model.kernel->gradientNormalisation(H);
    constants_.mass = model.mass;
    constants_.noSlip = NoSlip::of(system.spacing(), H);
    if (system.precision() == Precision::mixed)
        float_.away = pairKernels().fluidFloat(variant_, false),
        float_.atWall = pairKernels().fluidFloat(variant_, true);
    else
        double_.away = pairKernels().fluid(variant_, false), double_.atWall = pairKernels().fluid(variant_, true);
}

std::size_t FluidForces::bytes() const {
    return (double_.records.capacity() + sums_.capacity()) * sizeof(double) + float_.records.capacity() * sizeof(float);
}

template <class Velocity, class Pressure>
void FluidForces::run(ParticleSystem& system, const RealArray& density, const std::vector<RigidMotion>& motion,
                      Velocity&& velocity, Pressure&& pressure, double* const results[4]) {
    if (system.precision() == Precision::mixed)
        run(float_, system, density, motion, velocity, pressure, results);
    else
        run(double_, system, density, motion, velocity, pressure, results);
}

template <class Real, class Velocity, class Pressure>
void FluidForces::run(Pairs<Real>& pairs, ParticleSystem& system, const RealArray& density,
                      const std::vector<RigidMotion>& motion, Velocity&& velocity, Pressure&& pressure,
                      double* const results[4]) {
    const ParticleStore& s = system.store();
    const auto n = static_cast<std::size_t>(system.owned()), fields = static_cast<std::size_t>(variant_.fields());
    pairs.records.resize((n + static_cast<std::size_t>(system.ghosts())) * fields);
    const double viscous = variant_.varyingViscosity ? 1.0 : std::sqrt(2 * model_.viscosity);
    const double support = constants_.support, inverseMass = 1 / constants_.mass;
    const bool hasGap = variant_.boundaries != Boundaries::none;
    if (hasGap) model_.walls.findDistances(boundary::pointsOf(s), gap_);
    const particles::RecordFrame frame(system);
    Real* r = pairs.records.data();
    for (std::size_t i = 0; i < n; ++i, r += fields) {
        frame.position(i, r);
        velocity(i, r + 3);
        r[6] = static_cast<Real>(support * pressure(i));
        r[7] = static_cast<Real>(viscous / density[i]);
        if (variant_.varyingMass) r[8] = static_cast<Real>(s.mass[i] * inverseMass);
        if (variant_.varyingViscosity) r[variant_.varyingMass ? 9 : 8] = static_cast<Real>(s.viscosity[i]);
        if (hasGap) r[variant_.gap()] = static_cast<Real>(NoSlip::gap(gap_[i], support));
    }
    for (const auto& [i, wall] : wallParticles_) pairs.records[static_cast<std::size_t>(i) * fields + 7] *= -1;
    if (groups_) packGroups(pairs.records.data(), system.owned(), motion);
    particles::sumOverPairs(system, pairs.away, pairs.atWall, constants_, pairs.records, variant_.fields(), sums_,
                            results);
}

template <class Real>
void FluidForces::packGroups(Real* records, int owned, const std::vector<RigidMotion>& motion) const {
    const int fields = variant_.fields(), slope = variant_.slope();
    const double support = constants_.support;
    const auto record = [&](int particle) { return records + static_cast<long>(particle) * fields; };
    for (int i = 0; i < owned; ++i) std::fill_n(record(i) + slope, 4, Real(0));
    for (const RigidGroups::Member& m : groups_->members) {
        Real* r = record(m.particle);
        const Vec3 velocity = motion[static_cast<std::size_t>(m.group)].at(m.arm);
        for (int k = 0; k < 3; ++k) r[3 + k] = static_cast<Real>(velocity[k]);
        r[7] *= -1;
        r[slope + 3] = static_cast<Real>(m.depth / support);
    }
    for (const RigidGroups::Near& n : groups_->near) {
        Real* r = record(n.particle);
        const Vec3 rigid = motion[static_cast<std::size_t>(n.group)].at(n.arm);
        const double factor = support * n.inverseDistance;
        for (int k = 0; k < 3; ++k)
            r[slope + k] += static_cast<Real>(factor * (static_cast<double>(r[3 + k]) - rigid[k]));
    }
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
    if (keepsBudget_) {
        const RealArray *const velocity[3] = {&s.u, &s.v, &s.w}, *const rate[3] = {&s.fx, &s.fy, &s.fz};
        for (int k = 0; k < 3; ++k) {
            used_[k].resize(n);
            for (std::size_t i = 0; i < n; ++i) used_[k][i] = (*velocity[k])[i] + e * (*rate[k])[i];
        }
    }
    run(
        system, density_, groups_ ? groups_->motion : still_,
        [&]<class Real>(std::size_t i, Real* velocity) {
            velocity[0] = static_cast<Real>(s.u[i] + e * s.fx[i]);
            velocity[1] = static_cast<Real>(s.v[i] + e * s.fy[i]);
            velocity[2] = static_cast<Real>(s.w[i] + e * s.fz[i]);
        },
        [&](std::size_t i) { return pressure_[i]; }, results);

    if (groups_)
        groups_->wrenches =
            groups_->gather(groups_->motion, s.fx.data(), s.fy.data(), s.fz.data(), s.mass.data(), system.comm());
    if (keepsBudget_) findRates(system);
    for (Vec3& f : wallForces_) f.setZero();
    for (const auto& [i, wall] : wallParticles_) {
        const double mass = variant_.varyingMass ? s.mass[i] : model_.mass;
        wallForces_[static_cast<std::size_t>(wall)] += mass * Vec3(s.fx[i], s.fy[i], s.fz[i]);
    }
    if (!model_.bodyForce.isZero())
        for (std::size_t i = 0; i < n; ++i)
            s.fx[i] += model_.bodyForce[0], s.fy[i] += model_.bodyForce[1], s.fz[i] += model_.bodyForce[2];
    for (const auto& [i, wall] : wallParticles_) s.fx[i] = s.fy[i] = s.fz[i] = 0;
    if (groups_)
        for (const RigidGroups::Member& m : groups_->members)
            s.fx[m.particle] = s.fy[m.particle] = s.fz[m.particle] = 0;
}

// Uses the accelerations due to pairs alone: to be called before those of walls and members are set to zero and the
// body force is added.
void FluidForces::findRates(const ParticleSystem& system) {
    const ParticleStore& s = system.store();
    const Vec3 middle = system.box().middle(), &g = model_.bodyForce;
    std::fill(rates_.begin(), rates_.end(), 0.0);
    double power = 0, compression = 0, moving = 0;
    for (std::size_t i = 0; i < s.size(); ++i) {
        const Kind kind = s.kindOf(i);
        const double mass = variant_.varyingMass ? s.mass[i] : model_.mass;
        compression += mass * pressure_[i] * s.densityRate[i];
        if (kind == Kind::body) continue;
        const Vec3 force = mass * Vec3(s.fx[i], s.fy[i], s.fz[i]), u = velocityUsed(i);
        power += force.dot(u);
        if (kind == Kind::wall) {
            const Vec3 x = s.position(i);
            Budget::addWall(rates_, model_.walls.nearest(x).number, u, x - middle, -force);
            continue;
        }
        moving += force.dot(u);
        if (!g.isZero()) Budget::addBodyForce(rates_, u, s.position(i) - middle, mass * g);
    }
    if (groups_ && system.decomposition().rank() == 0)
        for (std::size_t b = 0; b < groups_->motion.size(); ++b)
            power += groups_->motion[b].linear.dot(groups_->wrenches[b].force) +
                     groups_->motion[b].angular.dot(groups_->wrenches[b].torque);
    rates_[Budget::compression] = compression;
    rates_[Budget::viscous] = -power - compression;
    rates_[Budget::kinetic] = moving + rates_[Budget::ofBodyForce];
}

void FluidForces::findWalls(const ParticleSystem& system) {
    wallParticles_.clear();
    if (!model_.walls.exist()) return;
    for (int i = 0; i < system.owned(); ++i)
        if (const ParticleStore& s = system.store(); s.kindOf(i) == Kind::wall)
            wallParticles_.push_back({i, model_.walls.nearest(s.position(i)).number});
}

void FluidForces::runViscosity(ParticleSystem& system, const RealArray (&velocity)[3],
                               const std::vector<RigidMotion>& motion, RealArray (&acceleration)[3]) {
    unused_.resize(static_cast<std::size_t>(system.owned()));
    double* const results[4] = {acceleration[0].data(), acceleration[1].data(), acceleration[2].data(), unused_.data()};
    run(
        system, system.store().density, motion,
        [&]<class Real>(std::size_t i, Real* v) {
            for (int k = 0; k < 3; ++k) v[k] = static_cast<Real>(velocity[k][i]);
        },
        [](std::size_t) { return 0.0; }, results);
}

void FluidForces::findViscosity(ParticleSystem& system, const RealArray (&velocity)[3], RealArray (&acceleration)[3]) {
    runViscosity(system, velocity, still_, acceleration);
    for (const auto& [i, wall] : wallParticles_)
        for (auto& component : acceleration) component[static_cast<std::size_t>(i)] = 0;
}

double FluidForces::viscousRate(ParticleSystem& system, int iterations) {
    const ParticleStore& s = system.store();
    const auto n = static_cast<std::size_t>(system.owned());
    RealArray vector[3], image[3];
    for (int k = 0; k < 3; ++k) vector[k].resize(n), image[k].resize(n);
    const auto clearWalls = [&] {
        for (const auto& [i, wall] : wallParticles_)
            for (auto& component : vector) component[i] = 0;
    };
    for (std::size_t i = 0; i < n; ++i)
        for (int k = 0; k < 3; ++k) vector[k][i] = randomSign(s.id[i], k);
    clearWalls();
    if (groups_)
        groups_->spread(std::vector<RigidMotion>(groups_->motion.size()), vector[0].data(), vector[1].data(),
                        vector[2].data());
    const auto findSquare = [&] {
        double sum = 0;
        for (const RealArray& component : vector)
            for (const double a : component) sum += a * a;
        return Communicator(system.comm()).sum(sum);
    };
    std::vector<RigidMotion> motion(groups_ ? groups_->motion.size() : 0);
    double square = findSquare();
    const auto normalise = [&] {
        const double length = std::sqrt(square);
        if (length == 0) return 0.0;
        for (auto& component : vector)
            for (double& a : component) a /= length;
        for (RigidMotion& m : motion) m.linear /= length, m.angular /= length;
        return 1.0;
    };
    return largestEigenvalue(iterations, normalise, [&] {
        runViscosity(system, vector, motion, image);
        std::swap(vector, image);
        clearWalls();
        if (groups_) {
            motion = groups_->response(groups_->gather(motion, vector[0].data(), vector[1].data(), vector[2].data(),
                                                       s.mass.data(), system.comm()));
            groups_->spread(motion, vector[0].data(), vector[1].data(), vector[2].data());
        }
        return square = findSquare();
    });
}

}  // namespace corpuscle::sph
