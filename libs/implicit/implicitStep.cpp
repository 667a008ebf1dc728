#include "implicit/implicitStep.hpp"

#include <fmt/core.h>

#include "core/communicator.hpp"
#include <algorithm>
#include <cmath>
#include <iterator>

#include "core/error.hpp"
#include "coupling/transport.hpp"
#include "implicit/coarseGrid.hpp"
#include "implicit/fluidTerm.hpp"
#include "implicit/membraneCorrection.hpp"
#include "implicit/membraneTerm.hpp"
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
          fluid_(scene, options.form),
          transport_(scene, options.shifting) {
        if (options.settings.preconditioner != "blockJacobi")
            grid_ = std::make_unique<CoarseGrid>(scene.fluidBox, CoarseGrid::spacingInParticles * scene.spacing);
        if (!scene.cells.empty()) {
            immersed_ = std::make_unique<Immersed>(scene.cells, scene.spacing);
            noFlux_ = std::make_unique<coupling::NoFlux>(scene.cells, scene.spacing);
            membranes_ = std::make_unique<MembraneTerm<Real>>(*immersed_, *scene.system, operators().volumes(),
                                                              options_.settings);
            terms_.push_back(membranes_.get());
        }
        if (scene.bodies) {
            rigid_ = std::make_unique<RigidUnknowns<Real>>(scene, operators(), grid_ != nullptr);
            terms_.push_back(rigid_.get());
        }
        terms_.push_back(&fluid_);
        allowed_ = firstStep(options_.settings, scene.flow.rate);
        isLinear_ = std::all_of(terms_.begin(), terms_.end(), [](const Term<Real>* term) { return term->isLinear(); });
    }

    using ImplicitStep::advance;
    Events advance(double dt, double planned) override {
        planned_ = std::max(dt, planned);
        moveVelocities(-ahead());
        Events events = make(dt, isBackward(), 0);
        moveVelocities(ahead());
        return events;
    }
    double largestDensityBalance() const override { return options_.largestBalance(); }

  private:
    using Field = particles::AlignedVector<Real>;
    using Vectors = Immersed::Vectors;
    static constexpr std::size_t width = 4;
    static std::size_t at(std::size_t i) { return width * i; }

    const ParticleStore& store() const { return scene_.store(); }
    double mass(std::size_t i) const { return scene_.mass(i); }
    sph::Operators<Real>& operators() { return fluid_.operators(); }
    const sph::Operators<Real>& operators() const { return fluid_.operators(); }
    bool isFixed(std::size_t i) const { return operators().isWall(i); }
    // Fields have entries of these, then what bodies have. Those of others hold what their ranks have, to rounding, where the solver and
    // the terms see them.
    particles::SharedParticles& shared() { return operators().shared(); }
    std::size_t entries() const { return operators().shared().entries(); }
    Copies copies() const { return {width * store().size(), width * entries()}; }

    bool isBackward() const { return backward_ || damped; }  // every step, not only halves
    Events make(double dt, bool backward, int halvings) {
        if (attempt(dt, halvings == 0 ? planned_ : dt, backward)) {
            ++statistics.steps;
            return coupling::endStep(scene_, options_, ++state.steps, dt);
        }
        if (halvings == mostHalvings)
            throw Failure(ExitCode::numerics,
                          fmt::format("step {}: {}, even in {} parts; take a smaller step in 'implicit' of "
                                      "system/numerics.yaml",
                                      state.steps + 1, fault_, 1 << halvings));
        ++statistics.halvings;
        Events events = make(0.5 * dt, true, halvings + 1), later = make(0.5 * dt, true, halvings + 1);
        std::move(later.begin(), later.end(), std::back_inserter(events));
        return events;
    }

    // False, and everything where it was, where it fails for the reason in fault_.
    bool attempt(double dt, double planned, bool backward) {
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
        const double bondRate = immersed_ ? largestBondRate(scene_.cells, membranes_->velocities()) : 0;
        allowed_ = allowedSteps(options_.settings, scene_.flow.rate, {dt, planned, isBackward()},
                                hasAcceleration() ? unevenness(dt) * difference() : 0, bondRate);
        finish(dt, share);
        return true;
    }

    void setTimes(double dt, double share) {
        ends_ = share == 1;
        reach_ = {share * dt, !ends_ && hasAcceleration() ? leadShare * dt : 0};
        h_ = reach_.middle + state.behind;
        const double w = ends_ || state.lastSpacing == 0 ? 0 : h_ / state.lastSpacing;
        c1_ = (1 + 2 * w) / (h_ * (1 + w)), c2_ = w / (1 + w);
    }

    // Whether the velocities of two middles are known. After the first step only where the flow begins as it goes on: beside
    // cells and bodies, where walls or a body force set in and where the viscosity jumps, its acceleration is the jump from
    // a velocity that did not know of the forces, which does not go on.
    bool hasAcceleration() const { return state.steps > (beginsAsItGoesOn() ? 0 : 1); }
    bool beginsAsItGoesOn() const {
        return !immersed_ && !rigid_ && !scene_.flow.settles && !store().optional().viscosity;
    }
    // By how much the store's velocity is later than the middle of the last step.
    double ahead() const { return hasAcceleration() ? state.behind : 0; }
    // Along the acceleration: between the middle of a step and its end.
    void moveVelocities(double seconds) {
        ParticleStore& s = scene_.store();
        for (std::size_t i = 0; i < s.size(); ++i)
            s.setVelocity(i, s.velocity(i) + seconds * Vec3(s.fx[i], s.fy[i], s.fz[i]));
        if (rigid_) rigid_->moveVelocities(seconds);
    }

    void moveBy(double seconds) {
        ParticleStore& s = scene_.store();
        for (std::size_t i = 0; i < s.size(); ++i) s.setPosition(i, s.position(i) + seconds * s.velocity(i));
        if (immersed_) immersed_->move(seconds);
    }

    void prepare() {
        for (auto term = terms_.rbegin(); term != terms_.rend(); ++term) (*term)->prepare(reach_);  // the fluid's first
        if (noFlux_) noFlux_->find(*scene_.system, immersed_->touched());
    }

    // forces_ = what add(term) of each gives, the fluid's last.
    template <class Add>
    void sumTerms(Add&& add) {
        forces_.assign(width * entries(), 0.0);
        for (Term<Real>* term : terms_) add(*term);
    }

    // Of the guess: residual_ = right-hand side - A guess. Along with it, where the preconditioner gives zero: the divergence as the fourth number,
    // and the whole force in the rows of walls. Both are linear in the velocity, so that the solver carries them to those of the velocity found.
    void findResidual() {
        const ParticleStore& s = store();
        const std::size_t n = s.size();
        const std::size_t length = width * entries() + (rigid_ ? rigid_->length() : 0);
        guess_.resize(length), residual_.resize(length);
        for (std::size_t i = 0; i < n; ++i) {
            const double ahead = isFixed(i) ? 0 : h_;
            const Vec3 u = s.velocity(i) + ahead * Vec3(s.fx[i], s.fy[i], s.fz[i]);
            put(guess_, i, u);
        }
        if (rigid_) rigid_->extrapolate(h_, guess_);
        shared().distribute(guess_.data(), width);
        sumTerms([&](Term<Real>& term) { term.addFirstForces(guess_, forces_); });
        const Vec3& g = scene_.model().bodyForce;
        for (std::size_t i = 0; i < n; ++i) {
            const Vec3 a(s.fx[i], s.fy[i], s.fz[i]), change = get(guess_, i) - s.velocity(i);
            const Vec3 f = vector(forces_, i) + mass(i) * (g + c2_ * a - c1_ * change);
            put(residual_, i, isFixed(i) ? vector(forces_, i) : f, operators().divergence(i));
        }
        if (rigid_) rigid_->putResidual(c1_, c2_, guess_, forces_, residual_);
    }

    // The velocity of this step in guess_, that of the nodes in the membranes' term.
    bool solve(double dt) {
        const double reference = std::max(state.reference, leastReference());
        for (int refinement = 0;; ++refinement) {
            shared().distribute(residual_.data(), width);
            const Convergence c = solver_.solve(
                scene_.system->comm(), residual_, correction_, reference, options_.settings.tolerance,
                [&](const Field& z, Field& w) { apply(z, w); }, [&](const Field& r, Field& z) { precondition(r, z); },
                copies());
            statistics.innerIterations += membraneCorrection_.takeIterations();
            statistics.iterations += c.iterations;
            statistics.mostIterations = std::max<long>(statistics.mostIterations, c.iterations);
            if (!c.reached) {
                fault_ = fmt::format("the solver did not converge in {} iterations", c.iterations);
                return false;
            }
            for (std::size_t k = 0; k < guess_.size(); ++k) guess_[k] += correction_[k];
            if (scene_.account.kept) addLeft(refinement == 0);
            for (Term<Real>* term : terms_)
                if (fault_ = term->refusal(guess_, dt); !fault_.empty()) return false;
            if (isLinear_) return true;
            const double enough = linearisation * linearisation * std::max(reference, c.energy);
            if (refinement == mostRefinements || findDefect() <= enough) return true;
            takeDefect();
            ++statistics.refinements;
        }
    }

    // By which factor the second difference over steps of this length would be larger than that over the last three middles.
    double unevenness(double dt) const {
        return isBackward() || state.lastSpacing == 0 ? 1 : 2 * dt * dt / (h_ * (h_ + state.lastSpacing));
    }

    // By which the velocity found differs from the extrapolated one, with backward Euler from the last, over the lengths of stepControl.hpp [1/s].
    double difference() const {
        const double h = isBackward() ? 0 : h_;  // over which the other one is extrapolated
        const bool freeBodies = rigid_ && rigid_->areSomeFree();
        if (!immersed_ && !freeBodies) return differenceOfFluid(h) / scene_.flow.length;
        double largest = 0;
        if (immersed_)
            largest = largestDifference(scene_.cells, membranes_->velocities(),
                                        h > 0 ? membranes_->extrapolated() : immersed_->velocities());
        if (freeBodies) largest = std::max(largest, rigid_->largestDifference(h, guess_));
        return largest;
    }
    double differenceOfFluid(double h) const {  // root mean square
        const ParticleStore& s = store();
        double sums[2] = {0, 0};
        for (std::size_t i = 0; i < s.size(); ++i) {
            if (isFixed(i) || (rigid_ && rigid_->isMember(i))) continue;
            const Vec3 a(s.fx[i], s.fy[i], s.fz[i]);
            sums[0] += (get(guess_, i) - s.velocity(i) - h * a).squaredNorm();
            ++sums[1];
        }
        MPI_Allreduce(MPI_IN_PLACE, sums, 2, MPI_DOUBLE, MPI_SUM, scene_.system->comm());
        return sums[1] > 0 ? std::sqrt(sums[0] / sums[1]) : 0;
    }

    // What solutions leave of the equations, which the next right-hand side does not take up.
    void addLeft(bool first) {
        left_.resize(residual_.size());
        for (std::size_t k = 0; k < left_.size(); ++k) left_[k] = residual_[k] + (first ? Real(0) : left_[k]);
    }

    // What the terms' forces at the places found differ from the linear ones, as residual_ of what moves; the energy of the velocity that
    // it makes, by the preconditioner.
    double findDefect() {
        sumTerms([&](Term<Real>& term) { term.addDefect(forces_); });
        for (std::size_t i = 0; i < store().size(); ++i)
            if (!isFixed(i)) put(residual_, i, vector(forces_, i), static_cast<double>(residual_[at(i) + 3]));
        if (rigid_) rigid_->putForces(forces_, residual_);
        precondition(residual_, correction_);
        double energy = 0;
        copies().forCounted(residual_.size(), [&](std::size_t k) {
            energy += static_cast<double>(residual_[k]) * static_cast<double>(correction_[k]);
        });
        return Communicator(scene_.system->comm()).sum(energy);
    }

    // What is solved for then belongs to the terms' load, and to the force on walls.
    void takeDefect() {
        for (Term<Real>* term : terms_) term->takeDefect();
        for (std::size_t i = 0; i < store().size(); ++i)
            if (isFixed(i))
                put(residual_, i, get(residual_, i) + vector(forces_, i), static_cast<double>(residual_[at(i) + 3]));
    }

    void apply(const Field& z, Field& w) {
        sumTerms([&](Term<Real>& term) { term.addProduct(z, forces_); });
        for (std::size_t i = 0; i < entries(); ++i)
            put(w, i, rows_[at(i)] * get(z, i) - vector(forces_, i),
                i < store().size() ? -operators().divergence(i) : 0);
        if (rigid_) rigid_->putProduct(c1_, z, forces_, w);
    }

    void factorise() {
        const std::size_t n = store().size();
        inverse_.resize(entries()), rows_.resize(width * entries());
        const auto diagonal = [&](std::size_t i) {
            double sum = 0;
            for (const Term<Real>* term : terms_) sum += term->diagonal(i);
            return sum;
        };
        for (std::size_t i = 0; i < n; ++i) {
            const double inertia = isFixed(i) ? 0 : c1_ * mass(i);
            rows_[at(i)] = inertia;
            Vec3::Map(&rows_[at(i) + 1]) = store().position(i);
            inverse_[i] = isFixed(i) ? Real(0) : static_cast<Real>(1 / (inertia + diagonal(i)));
        }
        if (rigid_) rigid_->factorise(c1_, diagonal, inverse_);
        shared().distribute(inverse_.data(), 1);
        shared().distribute(rows_.data(), width);
        if (grid_) placeOnGrid();
        withMembrane_ = immersed_ && isMembraneStiff();
        if (withMembrane_) immersed_->placeOthers(*scene_.system, shared(), operators().volumes());
    }
    bool isMembraneStiff() const {
        const std::string& named = options_.settings.preconditioner;
        const double fluid = scene_.model().viscosity * scene_.spacing;  // around a node
        return named == "withMembrane" ||
               (named == "automatic" && immersed_->meanResistance(reach_.total()) > stiffMembrane * fluid);
    }
    void placeOnGrid() {
        const sph::FluidModel& model = scene_.model();
        const double bulk = model.equationOfState->bulkModulus(model.density, model.density, model.soundSpeed);
        grid_->setCoefficients(c1_ * model.density, model.viscosity, reach_.total() * bulk);
        grid_->begin(store().size(), entries() - store().size());
        for (std::size_t i = 0; i < entries(); ++i)
            if (rows_[at(i)] > 0) grid_->place(i, Vec3::Map(&rows_[at(i) + 1]));
    }
    void precondition(const Field& r, Field& z) {
        preconditionParticles(rigid_ ? rigid_->distribute(r) : r, z);
        if (rigid_) rigid_->project(z);
    }
    void preconditionParticles(const Field& r, Field& z) {
        if (withMembrane_) {
            membraneCorrection_.apply(scene_.system->comm(), *immersed_, *grid_, reach_.total(), inverse_,
                                      store().size(), r, z);
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
            rate_[i] = rigid_ ? operators().divergence(i) : static_cast<double>(residual_[at(i) + 3]);
            if (isFixed(i)) walls[scene_.model().walls.isUpper(s.position(i))] += get(residual_, i);
        }
        scene_.forces->setWallForces(walls[0], walls[1]);
        if (scene_.account.kept) keepAccount(dt);
        findReference();
        for (std::size_t i = 0; i < n; ++i) {
            s.densityRate[i] = -s.density[i] * rate_[i];
            s.density[i] *= ends_ ? 1 / (1 + dt * rate_[i]) : (1 - 0.5 * dt * rate_[i]) / (1 + 0.5 * dt * rate_[i]);
        }
        moveParticles(dt, share);
    }

    // The energy balance of the system, v.(A v - b) = - v.left: all forces of the terms follow from it without another application, where there
    // are no bodies. So v.L v is what their power and that of pressure and membranes do not explain, exactly (sph/account.hpp).
    void keepAccount(double dt) {
        using sph::Account;
        const ParticleStore& s = store();
        const Vec3 &g = scene_.model().bodyForce, middle = scene_.system->box().middle();
        Account::Values rates{};
        double power = 0;  // of the terms on everything that moves, walls included
        for (std::size_t i = 0; i < s.size(); ++i) {
            rates[Account::compression] -= operators().volume(i) * fluid_.pressure(i, rate_[i]) * rate_[i];
            const Vec3 x = s.position(i);
            if (isFixed(i)) {
                const Vec3 u = s.velocity(i), f = get(residual_, i);
                power += u.dot(f);
                Account::addWall(rates, scene_.model().walls.isUpper(x), u, x - middle, -f);
                continue;
            }
            const Vec3 v = get(guess_, i), a(s.fx[i], s.fy[i], s.fz[i]);
            if (rigid_) power += v.dot(vector(forces_, i));
            if (rigid_ && rigid_->isMember(i)) continue;
            const Vec3 inertia = mass(i) * (c1_ * (v - s.velocity(i)) - c2_ * a), byBodyForce = mass(i) * g;
            const Vec3 left = rigid_ ? Vec3(vector(forces_, i) + byBodyForce - inertia) : get(left_, i);
            if (!rigid_) power += v.dot(left + inertia - byBodyForce);
            Account::addBodyForce(rates, v, x - middle, byBodyForce);
            rates[Account::kinetic] += v.dot(inertia);
            rates[Account::ofSolver] += v.dot(left);
        }
        if (rigid_) power += rigid_->addRates(c1_, c2_, guess_, rates);
        if (membranes_ && scene_.system->decomposition().rank() == 0) membranes_->addRates(rates);
        rates[Account::viscous] =
            -power - rates[Account::compression] - rates[Account::elastic] - rates[Account::inMembranes];
        scene_.account.add(dt, rates);
    }

    // What the system has as their forces at the velocity found, so that they are what changes momentum. The solver does not carry them: rows of
    // particles of bodies are empty.
    void findForcesOnBodies() {
        sumTerms([&](Term<Real>& term) { term.addForces(guess_, forces_); });
        rigid_->findWrenches(forces_);
    }

    void moveParticles(double dt, double share) {
        ParticleStore& s = scene_.store();
        const std::size_t n = s.size();
        transport_.shift(operators(), dt);
        if (immersed_) {
            immersed_->move(-share * dt);
            immersed_->setVelocities(membranes_->velocities());
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
                sum -= w.dot(vector(forces_, i));
            else
                sum += mass(i) * w.dot(c1_ * (s.velocity(i) - flow) + c2_ * a + g);
            sum += operators().volume(i) * fluid_.pressure(i) * rate_[i];
            put(disturbance, i, w);
            put(undisturbed, i, flow);
        }
        sum = Communicator(scene_.system->comm()).sum(sum);
        for (Term<Real>* term : terms_) sum += term->power(undisturbed, disturbance);
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
    bool backward_, isLinear_, withMembrane_ = false, ends_ = false;  // ends_: everything at the end of this step
    std::string fault_;
    FluidTerm<Real> fluid_;
    std::unique_ptr<MembraneTerm<Real>> membranes_;  // none without cells
    std::unique_ptr<RigidUnknowns<Real>> rigid_;     // none without bodies
    std::vector<Term<Real>*> terms_;                 // of these, the fluid's last
    std::unique_ptr<CoarseGrid> grid_;
    MembraneCorrection<Real> membraneCorrection_;
    ConjugateGradients<Real> solver_;
    Reach reach_{};
    double planned_ = 0;              // length of the step but for an event [s]
    double h_ = 0, c1_ = 0, c2_ = 0;  // of dv/dt
    Field guess_, residual_, correction_, inverse_, left_;
    RealArray rows_;            // c1 times mass, 0 where the velocity is prescribed; place where its own rank has it
    RealArray forces_;          // of the terms, at the velocity given to them last
    std::vector<double> rate_;  // divergence of the velocity found
    coupling::Transport transport_;
};

}  // namespace

std::unique_ptr<ImplicitStep> ImplicitStep::make(Scene& scene, const Options& options) {
    if (scene.system->precision() == particles::Precision::mixed) return std::make_unique<Step<float>>(scene, options);
    return std::make_unique<Step<double>>(scene, options);
}

}  // namespace corpuscle::implicit
