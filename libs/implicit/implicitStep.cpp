#include "implicit/implicitStep.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "core/error.hpp"
#include "coupling/transport.hpp"
#include "implicit/coarseGrid.hpp"
#include "implicit/membraneCorrection.hpp"
#include "implicit/rigidUnknowns.hpp"
#include "implicit/stepControl.hpp"

namespace corpuscle::implicit {

using coupling::Immersed;
using coupling::Scene;
using Events = std::vector<coupling::RuptureEvent>;
using particles::ParticleStore;
using particles::RealArray;

namespace {

template <class Real>
class Step final : public ImplicitStep {
  public:
    Step(Scene& scene, const Options& options)
        : scene_(scene),
          options_(options),
          backward_(options.settings.method == "backwardEuler"),
          operators_(scene.model(), *scene.system, options.form),
          transport_(scene, options.shifting) {
        if (options.settings.preconditioner != "blockJacobi")
            grid_ = std::make_unique<CoarseGrid>(scene.fluidBox, CoarseGrid::spacingInParticles * scene.spacing);
        if (scene.bodies) rigid_ = std::make_unique<RigidUnknowns<Real>>(scene, grid_ != nullptr);
        if (scene.cells.empty()) return;
        immersed_ = std::make_unique<Immersed>(scene.cells, scene.spacing);
        noFlux_ = std::make_unique<coupling::NoFlux>(scene.cells, scene.spacing);
    }

    Events advance(double dt) override { return advance(dt, backward_, 0); }
    double largestDensityBalance() const override { return options_.largestBalance(); }

  private:
    using Field = particles::AlignedVector<Real>;
    using Vectors = Immersed::Vectors;
    static constexpr std::size_t width = 4;
    static std::size_t at(std::size_t i) { return width * i; }

    const ParticleStore& store() const { return scene_.store(); }
    double mass(std::size_t i) const { return scene_.mass(i); }
    bool isFixed(std::size_t i) const { return operators_.isWall(i); }

    Events advance(double dt, bool backward, int halvings) {
        if (attempt(dt, backward)) {
            ++statistics.steps;
            return coupling::endStep(scene_, options_, ++state.steps, dt);
        }
        if (halvings == mostHalvings)
            throw Failure(ExitCode::numerics,
                          fmt::format("step {}: {}, even in {} parts; take a smaller step in 'implicit' of "
                                      "system/numerics.yaml",
                                      state.steps + 1, fault_, 1 << halvings));
        ++statistics.halvings;
        Events events = advance(0.5 * dt, true, halvings + 1), later = advance(0.5 * dt, true, halvings + 1);
        std::move(later.begin(), later.end(), std::back_inserter(events));
        return events;
    }

    // False, and everything where it was, where it fails for the reason in fault_.
    bool attempt(double dt, bool backward) {
        const double share = backward ? 1 : 0.5;  // of dt, at which forces are taken
        setTimes(dt, share);
        moveBy(share * dt);
        if (rigid_) rigid_->depart(share * dt);
        scene_.system->rebuild();
        prepare();
        findResidual();
        factorise();
        if (!solve(dt)) {
            moveBy(-share * dt);
            if (rigid_) rigid_->takeBack();
            return false;
        }
        if (immersed_) {
            const bool extrapolated = state.steps > 1;  // with an acceleration
            allowed_ = allowedSteps(options_.settings, scene_, dt, ends_, nodes_, extrapolated ? guessed_ : nodes_);
        }
        finish(dt, share);
        return true;
    }

    void setTimes(double dt, double share) {
        time_ = share * dt;
        ends_ = share == 1;
        h_ = time_ + state.behind;
        const double w = ends_ || state.lastSpacing == 0 ? 0 : h_ / state.lastSpacing;
        c1_ = (1 + 2 * w) / (h_ * (1 + w)), c2_ = w / (1 + w);
    }

    void moveBy(double seconds) {
        ParticleStore& s = scene_.store();
        for (std::size_t i = 0; i < s.size(); ++i) s.setPosition(i, s.position(i) + seconds * s.velocity(i));
        if (immersed_) immersed_->move(seconds);
    }

    void prepare() {
        const ParticleStore& s = store();
        const std::size_t n = s.size();
        operators_.build(*scene_.system);
        findPressures(scene_, pressure_);
        bulk_.resize(n);
        const sph::FluidModel& model = scene_.model();
        for (std::size_t i = 0; i < n; ++i)
            bulk_[i] = model.equationOfState->bulkModulus(s.density[i], model.density, model.soundSpeed);
        if (rigid_) rigid_->find(operators_);
        if (!immersed_) return;
        immersed_->build(*scene_.system, operators_.volumes());
        noFlux_->find(*scene_.system, immersed_->touched());
    }

    // Of the guess: residual_ = right-hand side - A guess. Along with it, where the preconditioner gives zero: the divergence as the fourth number,
    // and the whole force in the rows of walls. Both are linear in the velocity, so that the solver carries them to those of the velocity found.
    void findResidual() {
        const ParticleStore& s = store();
        const std::size_t n = s.size();
        const std::size_t length = width * n + (rigid_ ? rigid_->length() : 0);
        guess_.resize(length), residual_.resize(length);
        for (std::size_t i = 0; i < n; ++i) {
            const double ahead = isFixed(i) ? 0 : h_;
            const Vec3 u = s.velocity(i) + ahead * Vec3(s.fx[i], s.fy[i], s.fz[i]);
            put(guess_, i, u);
        }
        if (rigid_) rigid_->extrapolate(h_, guess_);
        operators_.apply(*scene_.system, guess_,
                         [&](std::size_t i, double rate) { return pressure_[i] - time_ * bulk_[i] * rate; });
        RealArray& force = operators_.force();
        if (immersed_) {
            load_ = immersed_->force();
            immersed_->addStiffness(time_, immersed_->velocities(), load_);  // of f(x) at x* + time (v - u_m)
            Vectors f = load_;
            guessed_ = immersed_->interpolate(guess_.data());
            immersed_->addResistance(time_, guessed_, f);
            immersed_->spread(std::move(f), force);
        }
        if (rigid_) rigid_->addContinuation(guess_, force);
        const Vec3& g = scene_.model().bodyForce;
        for (std::size_t i = 0; i < n; ++i) {
            const Vec3 a(s.fx[i], s.fy[i], s.fz[i]), change = get(guess_, i) - s.velocity(i);
            const Vec3 f = vector(force, i) + mass(i) * (g + c2_ * a - c1_ * change);
            put(residual_, i, isFixed(i) ? vector(force, i) : f, operators_.divergence(i));
        }
        if (rigid_) rigid_->putResidual(c1_, c2_, guess_, force, residual_);
    }

    // The velocity of this step in guess_, that of the nodes in nodes_.
    bool solve(double dt) {
        const double reference = std::max(state.reference, leastReference());
        for (int refinement = 0;; ++refinement) {
            const Convergence c = solver_.solve(
                scene_.system->comm(), residual_, correction_, reference, options_.settings.tolerance,
                [&](const Field& z, Field& w) { apply(z, w); }, [&](const Field& r, Field& z) { precondition(r, z); });
            statistics.innerIterations = membraneCorrection_.iterations();
            statistics.iterations += c.iterations;
            statistics.mostIterations = std::max<long>(statistics.mostIterations, c.iterations);
            if (!c.reached) {
                fault_ = fmt::format("the solver did not converge in {} iterations", c.iterations);
                return false;
            }
            for (std::size_t k = 0; k < guess_.size(); ++k) guess_[k] += correction_[k];
            if (!immersed_) return true;
            nodes_ = immersed_->interpolate(guess_.data());
            if (const double change = largestBondRate(scene_.cells, nodes_) * dt;
                change > options_.settings.bondStrain) {
                fault_ =
                    fmt::format("a bond would change its length by {:.3g}, more than 'implicit.bondStrain'", change);
                return false;
            }
            const double enough = linearisation * linearisation * std::max(reference, c.energy);
            if (refinement == mostRefinements || findDefect() <= enough) return true;
            takeDefect();
            ++statistics.refinements;
        }
    }

    // What the membranes' forces at the places found differ from the linear ones, as residual_ of what moves; the energy of the velocity that
    // it makes, by the preconditioner.
    double findDefect() {
        Vectors displacement = nodes_;
        const Vectors before = immersed_->velocities();
        for (std::size_t m = 0; m < nodes_.size(); ++m) displacement[m] = time_ * (nodes_[m] - before[m]);
        defect_ = immersed_->forceAt(displacement);
        Vectors linear = load_;
        immersed_->addStiffness(-time_, nodes_, linear);
        for (std::size_t m = 0; m < defect_.size(); ++m) defect_[m] -= linear[m];
        RealArray& force = operators_.force();
        std::fill(force.begin(), force.end(), 0.0);
        immersed_->spread(defect_, force);
        for (std::size_t i = 0; i < store().size(); ++i)
            if (!isFixed(i)) put(residual_, i, vector(force, i), static_cast<double>(residual_[at(i) + 3]));
        if (rigid_) rigid_->putForces(force, residual_);
        precondition(residual_, correction_);
        double energy = 0;
        for (std::size_t k = 0; k < residual_.size(); ++k)
            energy += static_cast<double>(residual_[k]) * static_cast<double>(correction_[k]);
        return coupling::sumOverRanks(energy, scene_.system->comm());
    }

    // What is solved for then belongs to the membranes' load, and to the force on walls.
    void takeDefect() {
        for (std::size_t m = 0; m < defect_.size(); ++m) load_[m] += defect_[m];
        for (std::size_t i = 0; i < store().size(); ++i)
            if (isFixed(i))
                put(residual_, i, get(residual_, i) + vector(operators_.force(), i),
                    static_cast<double>(residual_[at(i) + 3]));
    }

    void apply(const Field& z, Field& w) {
        operators_.apply(*scene_.system, z, [&](std::size_t i, double rate) { return -time_ * bulk_[i] * rate; });
        if (immersed_) {
            Vectors f(load_.size(), Vec3::Zero());
            immersed_->addResistance(time_, immersed_->interpolate(z.data()), f);
            immersed_->spread(std::move(f), operators_.force());
        }
        if (rigid_) rigid_->addContinuation(z, operators_.force());
        const std::size_t n = store().size();
        for (std::size_t i = 0; i < n; ++i) {
            const Vec3 inertia = isFixed(i) ? Vec3(Vec3::Zero()) : Vec3(c1_ * mass(i) * get(z, i));
            put(w, i, inertia - vector(operators_.force(), i), -operators_.divergence(i));
        }
        if (rigid_) rigid_->putProduct(c1_, z, operators_.force(), w);
    }

    // Diagonal blocks of the fluid, multiples of the unit matrix. Those of the membrane make it worse: near it they hold back all that is
    // not smooth along it (docs/implicit.md, Figures).
    void factorise() {
        const std::size_t n = store().size();
        inverse_.resize(n);
        for (std::size_t i = 0; i < n; ++i) inverse_[i] = isFixed(i) ? Real(0) : static_cast<Real>(1 / diagonal(i));
        const auto withoutMass = [&](std::size_t i) { return diagonal(i) - c1_ * mass(i); };
        if (rigid_) rigid_->factorise(c1_, withoutMass, inverse_);
        if (grid_) placeOnGrid();
        withMembrane_ = immersed_ && isMembraneStiff();
    }
    bool isMembraneStiff() const {
        const std::string& named = options_.settings.preconditioner;
        const double fluid = scene_.model().viscosity * scene_.spacing;  // around a node
        return named == "withMembrane" ||
               (named == "automatic" && immersed_->meanResistance(time_) > stiffMembrane * fluid);
    }
    void placeOnGrid() {
        const sph::FluidModel& model = scene_.model();
        const double bulk = model.equationOfState->bulkModulus(model.density, model.density, model.soundSpeed);
        grid_->setCoefficients(c1_ * model.density, model.viscosity, time_ * bulk);
        grid_->begin(inverse_.size());
        for (std::size_t i = 0; i < inverse_.size(); ++i)
            if (!isFixed(i)) grid_->place(i, store().position(i));
    }
    double diagonal(std::size_t i) const {
        return c1_ * mass(i) + operators_.viscousDiagonal(i) + time_ * bulk_[i] * operators_.bulkDiagonal(i);
    }
    void precondition(const Field& r, Field& z) {
        preconditionParticles(rigid_ ? rigid_->distribute(r) : r, z);
        if (rigid_) rigid_->project(z);
    }
    void preconditionParticles(const Field& r, Field& z) {
        if (withMembrane_) {
            membraneCorrection_.apply(scene_.system->comm(), *immersed_, *grid_, time_, inverse_, r, z);
            return;
        }
        for (std::size_t i = 0; i < inverse_.size(); ++i) {
            for (std::size_t k = 0; k < 3; ++k) z[at(i) + k] = inverse_[i] * r[at(i) + k];
            z[at(i) + 3] = 0;
        }
        if (grid_) grid_->add(scene_.system->comm(), r.data(), z.data());
    }

    // With the velocity found: density, places, what the walls feel; the state of the next step. Divergences and the forces on walls are in
    // residual_.
    void finish(double dt, double share) {
        ParticleStore& s = scene_.store();
        const std::size_t n = s.size();
        if (rigid_) findForcesOnBodies();
        Vec3 walls[2] = {Vec3::Zero(), Vec3::Zero()};
        rate_.resize(n);
        for (std::size_t i = 0; i < n; ++i) {
            rate_[i] = rigid_ ? operators_.divergence(i) : static_cast<double>(residual_[at(i) + 3]);
            if (isFixed(i)) walls[scene_.model().walls.isUpper(s.position(i))] += get(residual_, i);
        }
        scene_.forces->setWallForces(walls[0], walls[1]);
        findReference();
        for (std::size_t i = 0; i < n; ++i) {
            s.densityRate[i] = -s.density[i] * rate_[i];
            s.density[i] *= ends_ ? 1 / (1 + dt * rate_[i]) : (1 - 0.5 * dt * rate_[i]) / (1 + 0.5 * dt * rate_[i]);
        }
        moveParticles(dt, share);
    }

    // What the system has as their forces at the velocity found, so that they are what changes momentum. The solver does not carry them: rows of
    // particles of bodies are empty.
    void findForcesOnBodies() {
        operators_.apply(*scene_.system, guess_,
                         [&](std::size_t i, double rate) { return pressure_[i] - time_ * bulk_[i] * rate; });
        if (immersed_) {
            Vectors f = load_;
            immersed_->addResistance(time_, nodes_, f);
            immersed_->spread(std::move(f), operators_.force());
        }
        rigid_->addContinuation(guess_, operators_.force());
        rigid_->findWrenches(operators_.force());
    }

    void moveParticles(double dt, double share) {
        ParticleStore& s = scene_.store();
        const std::size_t n = s.size();
        transport_.shift(operators_, dt);
        if (immersed_) {
            immersed_->move(-share * dt);
            immersed_->setVelocities(nodes_);
            transport_.holdAtMembranes(*noFlux_, dt, [&](std::size_t i) { return get(guess_, i); });
            immersed_->move(dt);
            immersed_->restoreVolume();
        }
        for (std::size_t i = 0; i < n; ++i) {
            const Vec3 v = isFixed(i) ? s.velocity(i) : get(guess_, i), u = s.velocity(i);
            s.setPosition(i, s.position(i) + dt * v - share * dt * u + transport_[i]);
            const Vec3 a = (v - u) / h_;
            s.fx[i] = a[0], s.fy[i] = a[1], s.fz[i] = a[2];
            s.setVelocity(i, v);
        }
        if (rigid_) rigid_->arrive(dt, h_, guess_);
        if (noFlux_) noFlux_->keepSides(*scene_.system);
        state.behind = dt - share * dt, state.lastSpacing = h_;
    }

    // Energy of the disturbance w of the affine flow by the same form, w.A w = w.(b - A affine), where A of an affine flow is c1 M and what
    // resists it in the membranes.
    void findReference() {
        const ParticleStore& s = store();
        double sum = 0;
        const Vec3& g = scene_.model().bodyForce;
        Field &disturbance = correction_, &undisturbed = residual_;
        for (std::size_t i = 0; i < s.size(); ++i) {
            const Vec3 flow = affine(s.position(i)), w = isFixed(i) ? Vec3::Zero() : Vec3(get(guess_, i) - flow);
            const Vec3 a(s.fx[i], s.fy[i], s.fz[i]);
            if (rigid_ && rigid_->isMember(i))  // stress within the body resists what is not rigid
                sum -= w.dot(vector(operators_.force(), i));
            else
                sum += mass(i) * w.dot(c1_ * (s.velocity(i) - flow) + c2_ * a + g);
            sum += operators_.volume(i) * pressure_[i] * rate_[i];
            put(disturbance, i, w);
            put(undisturbed, i, flow);
        }
        sum = coupling::sumOverRanks(sum, scene_.system->comm());
        if (immersed_) {
            const Vectors w = immersed_->interpolate(disturbance.data());
            Vectors f = load_;
            immersed_->addResistance(time_, immersed_->interpolate(undisturbed.data()), f);
            for (std::size_t m = 0; m < w.size(); ++m) sum += w[m].dot(f[m]);
        }
        state.reference = std::abs(sum);
    }
    Vec3 affine(const Vec3& x) const {
        return scene_.flow.shearRate > 0 ? scene_.flow.velocity(x) : Vec3(Vec3::Zero());
    }
    double leastReference() const {
        const double rate = scene_.flow.rate;
        return 1e-10 * scene_.model().viscosity * rate * rate * scene_.fluidBox.volume();
    }

    static Vec3 get(const Field& f, std::size_t i) { return {f[at(i)], f[at(i) + 1], f[at(i) + 2]}; }
    static Vec3 vector(const RealArray& f, std::size_t i) { return {f[at(i)], f[at(i) + 1], f[at(i) + 2]}; }
    static void put(Field& f, std::size_t i, const Vec3& v, double fourth = 0) {
        for (int k = 0; k < 3; ++k) f[at(i) + static_cast<std::size_t>(k)] = static_cast<Real>(v[k]);
        f[at(i) + 3] = static_cast<Real>(fourth);
    }

    Scene& scene_;
    Options options_;
    bool backward_, withMembrane_ = false, ends_ = false;  // ends_: everything at the end of this step
    std::string fault_;
    sph::Operators<Real> operators_;
    std::unique_ptr<CoarseGrid> grid_;
    std::unique_ptr<RigidUnknowns<Real>> rigid_;  // none without bodies
    MembraneCorrection<Real> membraneCorrection_;
    ConjugateGradients<Real> solver_;
    double time_ = 0, h_ = 0, c1_ = 0, c2_ = 0;  // share dt, and of dv/dt
    Field guess_, residual_, correction_, inverse_;
    RealArray pressure_;
    std::vector<double> bulk_, rate_;  // bulk modulus; divergence of the velocity found
    coupling::Transport transport_;
    Vectors load_;             // f(x*) + time k u_m, and what refinements have added
    Vectors defect_;           // of the velocity found last
    Vectors guessed_, nodes_;  // velocities of the nodes: extrapolated, and found
};

}  // namespace

std::unique_ptr<ImplicitStep> ImplicitStep::make(Scene& scene, const Options& options) {
    if (scene.system->precision() == particles::Precision::mixed) return std::make_unique<Step<float>>(scene, options);
    return std::make_unique<Step<double>>(scene, options);
}

}  // namespace corpuscle::implicit
