#include "coupling/adjointVerlet.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/communicator.hpp"
#include "core/powerIteration.hpp"
#include "coupling/insideShares.hpp"
#include "coupling/transport.hpp"
#include "particles/vectorField.hpp"
#include "sph/randomSigns.hpp"

namespace corpuscle::coupling {

using particles::ParticleStore;
using particles::RealArray;

namespace {

// Largest displacement of a node in a difference of membrane forces, over the mean bond length.
constexpr double probeInBonds = 1e-4;

template <class Real>
class Verlet final : public AdjointVerlet {
  public:
    Verlet(Scene& scene, const Options& options)
        : scene_(scene),
          options_(options),
          operators_(scene.model(), *scene.system, options.form),
          transport_(scene, options.shifting) {
        if (!scene.cells.exist()) return;
        immersed_ = std::make_unique<Immersed>(scene.cells, scene.model(), *scene.system);
        noFlux_ = std::make_unique<NoFlux>(scene.cells, scene.spacing);
    }

    void start() override {
        ParticleStore& s = scene_.store();
        for (auto* a : {&s.fx, &s.fy, &s.fz, &s.densityRate}) std::fill(a->begin(), a->end(), 0.0);
        evaluate(0);
        accelerate(0, 0);
        if (immersed_) immersed_->setVelocities(nodeVelocities());
    }

    std::vector<RuptureEvent> advance(double dt) override {
        const double half = 0.5 * dt;
        drift(half);
        if (scene_.system->mustRebuild()) scene_.system->rebuild();
        evaluate(half);
        accelerate(dt, half);
        scene_.moveSolute(dt, half);
        relaxDensities(scene_, operators_, options_.densityRate, dt);
        findMoves(dt);
        drift(half);
        move();
        return endStep(scene_, options_, ++steps_, dt);
    }

    double largestDensityBalance() const override { return options_.largestBalance(); }

    Rates rates(int iterations) override {
        Rates found;
        found.viscous = largestEigenvalue(iterations, [&] {
            operators_.apply(*scene_.system, field_, [](std::size_t, double) { return 0.0; });
            return -1.0;
        });
        if (!immersed_) return found;
        if (immersed_->isViscous())
            found.membrane = largestEigenvalue(iterations, [&] {
                Immersed::Vectors f(immersed_->force().size(), Vec3::Zero());
                immersed_->addViscousForces(nodeVelocities(), f);
                spreadAlone(f);
                return -1.0;
            });
        const Immersed::Vectors rest = immersed_->forceAt(Immersed::Vectors(immersed_->force().size(), Vec3::Zero()));
        found.spring2 = largestEigenvalue(iterations, [&] { return springForces(rest); });
        return found;
    }

  private:
    using Field = particles::AlignedVector<Real>;
    static constexpr std::size_t width = 4;
    static std::size_t at(std::size_t i) { return width * i; }

    const ParticleStore& store() const { return scene_.store(); }
    bool isFixed(std::size_t i) const { return operators_.isWall(i); }
    Immersed::Vectors nodeVelocities() const { return immersed_->interpolate(field_.data()); }  // P S field_

    void drift(double seconds) {
        ParticleStore& s = scene_.store();
        for (std::size_t i = 0; i < s.size(); ++i)
            s.x[i] += seconds * s.u[i], s.y[i] += seconds * s.v[i], s.z[i] += seconds * s.w[i];
        if (immersed_) immersed_->move(seconds);
    }

    // Forces and rates at u + extrapolation a and rho + extrapolation rhodot; the extrapolated density stays in the
    // store.
    void evaluate(double extrapolation) {
        ParticleStore& s = scene_.store();
        const std::size_t n = s.size();
        for (std::size_t i = 0; i < n; ++i) s.density[i] += extrapolation * s.densityRate[i];
        operators_.build(*scene_.system);
        if (immersed_) {
            immersed_->place(*scene_.system, operators_.volumes());
            noFlux_->find(*scene_.system, *immersed_, extrapolation);
        }
        operators_.setInside(*scene_.system, insideShares(scene_, noFlux_.get(), immersed_.get()));
        findPressures(scene_, options_.backgroundPressure, pressure_);
        field_.resize(width * n);
        for (std::size_t i = 0; i < n; ++i) put(i, s.velocity(i) + extrapolation * Vec3(s.fx[i], s.fy[i], s.fz[i]));
        operators_.apply(*scene_.system, field_, [&](std::size_t i, double) { return pressure_[i]; });
        const bool keeps = scene_.budget.kept;
        if (keeps) findRates();
        if (!immersed_) return;
        Immersed::Vectors f = immersed_->force();
        double viscous = 0;
        if (immersed_->isViscous()) {
            const Immersed::Vectors nodes = nodeVelocities(), elastic = keeps ? f : Immersed::Vectors();
            immersed_->addViscousForces(nodes, f);
            if (keeps)
                viscous =
                    immersed_->layout().sumOverOwned(scene_.cells, scene_.system->decomposition().rank(),
                                                     [&](std::size_t m) { return nodes[m].dot(f[m] - elastic[m]); });
        }
        immersed_->spread(std::move(f), operators_.force());
        if (keeps) addMembraneRates(viscous);
    }

    // Rates of the budget (sph/budget.hpp) at the velocities in field_: findRates for the forces of the fluid, before
    // those of membranes are added; then addMembraneRates for the latter.
    double power() const {
        double sum = 0;
        for (std::size_t i = 0; i < store().size(); ++i) sum += velocityUsed(i).dot(force(i));
        return sum;
    }
    void findRates() {
        rates_ = sph::Budget::zero(scene_.model().walls.count());
        double compression = 0;
        for (std::size_t i = 0; i < store().size(); ++i)
            compression -= operators_.volume(i) * pressure_[i] * operators_.divergence(i);
        fluidPower_ = power();
        rates_[sph::Budget::compression] = compression;
        rates_[sph::Budget::viscous] = -fluidPower_ - compression;
    }
    // own: power of the viscous forces of membranes, over the cells that this rank owns [W].
    void addMembraneRates(double own) {
        rates_[sph::Budget::inMembranes] = -own;
        rates_[sph::Budget::elastic] = own - (power() - fluidPower_);
    }
    void addRatesOfParticle(std::size_t i, const Vec3& middle) {
        const Vec3 u = velocityUsed(i), f = force(i), x = store().position(i) - middle;
        if (isFixed(i))
            sph::Budget::addWall(rates_, scene_.model().walls.nearest(store().position(i)).number, u, x, -f);
        else {
            const Vec3& g = scene_.model().bodyForce;
            if (!g.isZero()) sph::Budget::addBodyForce(rates_, u, x, scene_.mass(i) * g);
            rates_[sph::Budget::kinetic] += u.dot(f + scene_.mass(i) * g);
        }
    }
    Vec3 velocityUsed(std::size_t i) const { return {field_[at(i)], field_[at(i) + 1], field_[at(i) + 2]}; }
    Vec3 force(std::size_t i) const { return Vec3::Map(operators_.force().data() + at(i)); }

    // Advances velocity and density by the rates found, and sets the forces on walls. extrapolation: that by which the
    // density in the store was extrapolated [s].
    void accelerate(double dt, double extrapolation) {
        ParticleStore& s = scene_.store();
        const Vec3& g = scene_.model().bodyForce;
        const bool keeps = scene_.budget.kept;
        const Vec3 middle = scene_.system->box().middle();
        std::vector<Vec3> onWalls(scene_.model().walls.count(), Vec3::Zero());
        for (std::size_t i = 0; i < s.size(); ++i) {
            if (keeps) addRatesOfParticle(i, middle);
            const double rate = -s.density[i] * operators_.divergence(i);
            s.density[i] += dt * rate - extrapolation * s.densityRate[i];
            s.densityRate[i] = rate;
            const double* f = operators_.force().data() + at(i);
            if (isFixed(i)) {
                onWalls[static_cast<std::size_t>(scene_.model().walls.nearest(s.position(i)).number)] +=
                    Vec3(f[0], f[1], f[2]);
                continue;
            }
            const double inverse = 1 / scene_.mass(i);
            s.fx[i] = inverse * f[0] + g[0], s.fy[i] = inverse * f[1] + g[1], s.fz[i] = inverse * f[2] + g[2];
            s.u[i] += dt * s.fx[i], s.v[i] += dt * s.fy[i], s.w[i] += dt * s.fz[i];
            put(i, s.velocity(i));
        }
        scene_.forces->setWallForces(std::move(onWalls));
        if (keeps) scene_.budget.add(dt, rates_);
    }

    // Displacement of particles in addition to that by their velocity: shifting, less the part that would cross a
    // membrane. Also sets the velocities of nodes to those at the end of the step.
    void findMoves(double dt) {
        transport_.shift(operators_, dt);
        if (!immersed_) return;
        const Immersed::Vectors before = immersed_->velocities(), after = nodeVelocities();
        Immersed::Vectors mean = after;
        for (std::size_t m = 0; m < mean.size(); ++m) mean[m] = 0.5 * (before[m] + after[m]);
        immersed_->setVelocities(mean);
        const ParticleStore& s = store();
        transport_.holdAtMembranes(*noFlux_, dt, [&](std::size_t i) -> Vec3 {  // mean over the step
            return s.velocity(i) - 0.5 * dt * Vec3(s.fx[i], s.fy[i], s.fz[i]);
        });
        immersed_->setVelocities(after);
    }

    void move() {
        ParticleStore& s = scene_.store();
        for (std::size_t i = 0; i < s.size(); ++i) s.setPosition(i, s.position(i) + transport_[i]);
        if (immersed_) {
            immersed_->restoreVolume();
            noFlux_->keepSides(*scene_.system);
        }
        keepWithinWalls(scene_, [&](std::size_t i) { return operators_.wallGap(i); });
    }

    // Replaces the forces on the particles by those of the nodes alone.
    void spreadAlone(const Immersed::Vectors& f) {
        std::fill(operators_.force().begin(), operators_.force().end(), 0.0);
        immersed_->spread(f, operators_.force());
    }
    // Leaves S^T P times the change of the elastic force from `rest`, with nodes displaced along P S field_, in the
    // operators' force; returns the factor by which this is to be multiplied to give S^T P K P S field_.
    double springForces(const Immersed::Vectors& rest) {
        Immersed::Vectors displacement = nodeVelocities();
        double longest = 0;
        for (const Vec3& d : displacement) longest = std::max(longest, d.norm());
        longest = Communicator(scene_.system->comm()).max(longest);
        const double scale = longest > 0 ? probeInBonds * scene_.cells.meanBondLength() / longest : 1;
        for (Vec3& d : displacement) d *= scale;
        Immersed::Vectors f = immersed_->forceAt(displacement);
        for (std::size_t m = 0; m < f.size(); ++m) f[m] -= rest[m];
        spreadAlone(f);
        return -1 / scale;
    }

    // Largest eigenvalue of M^-1 A by power iterations, from a start that depends on particle ids only. image() leaves
    // a vector in the operators' force and returns the factor by which it is to be multiplied to give A field_.
    template <class Image>
    double largestEigenvalue(int iterations, Image&& image) {
        const ParticleStore& s = store();
        for (std::size_t i = 0; i < s.size(); ++i)
            put(i, isFixed(i)
                       ? Vec3(Vec3::Zero())
                       : Vec3(sph::randomSign(s.id[i], 0), sph::randomSign(s.id[i], 1), sph::randomSign(s.id[i], 2)));
        double square = findSquare();
        const auto normalise = [&] {
            const double length = std::sqrt(square);
            if (length == 0) return 0.0;
            for (Real& v : field_) v = static_cast<Real>(static_cast<double>(v) / length);
            return 1.0;
        };
        return corpuscle::largestEigenvalue(iterations, normalise, [&] {
            const double factor = image();
            for (std::size_t i = 0; i < s.size(); ++i) {
                const Vec3 f = particles::vectorAt(operators_.force(), i);
                put(i, isFixed(i) ? Vec3(Vec3::Zero()) : Vec3(factor / scene_.mass(i) * f));
            }
            return square = findSquare();
        });
    }
    double findSquare() const {
        double sum = 0;
        for (const Real v : field_) sum += static_cast<double>(v) * static_cast<double>(v);
        return Communicator(scene_.system->comm()).sum(sum);
    }

    void put(std::size_t i, const Vec3& v) { particles::setVector(field_, i, v); }

    Scene& scene_;
    Options options_;
    sph::Operators<Real> operators_;
    Field field_;  // velocities
    RealArray pressure_;
    Transport transport_;
    sph::Budget::Values rates_;  // budget rates of the last evaluation
    double fluidPower_ = 0;
};

}  // namespace

std::unique_ptr<AdjointVerlet> AdjointVerlet::make(Scene& scene, const Options& options) {
    if (scene.system->precision() == particles::Precision::mixed)
        return std::make_unique<Verlet<float>>(scene, options);
    return std::make_unique<Verlet<double>>(scene, options);
}

}  // namespace corpuscle::coupling
