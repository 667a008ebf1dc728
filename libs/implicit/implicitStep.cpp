#include "implicit/implicitStep.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/communicator.hpp"
#include "implicit/breakSearch.hpp"
#include "implicit/disturbance.hpp"
#include "implicit/movement.hpp"
#include "implicit/preconditioner.hpp"
#include "implicit/stepBudget.hpp"

namespace corpuscle::implicit {

using coupling::Immersed;
using coupling::Scene;
using particles::ParticleStore;
using particles::vectorAt;

namespace {

std::unique_ptr<Immersed> immersedIn(Scene& scene) {
    return !scene.cells.exist()
               ? nullptr
               : std::make_unique<Immersed>(scene.cells, scene.model(), *scene.system, scene.contacts.get());
}
std::unique_ptr<coupling::NoFlux> noFluxIn(Scene& scene) {
    return !scene.cells.exist() ? nullptr : std::make_unique<coupling::NoFlux>(scene.cells, scene.spacing);
}

template <class Real>
class Step final : public ImplicitStep {
  public:
    Step(Scene& scene, const Options& options)
        : ImplicitStep(immersedIn(scene), noFluxIn(scene)),
          scene_(scene),
          options_(options),
          system_(scene, options, options_.settings, immersed_.get(), noFlux_.get(),
                  isOnGrid(options.settings.preconditioner)),
          preconditioner_(makePreconditioner(options.settings.preconditioner, system_)),
          movement_(system_, options.shifting, noFlux_.get()),
          budget_(system_) {
        allowed_ = firstStep(options_.settings, scene.flow.rate);
        canRupture_ = scene.cells.canRupture();
        if (canRupture_) allowed_.breaks = state.breakLimit = startOfRupture / scene.flow.rate;
    }

    using ImplicitStep::advance;
    Made advance(double dt, double planned) override {
        planned_ = std::max(dt, planned);
        movement_.moveVelocities(-ahead());
        Made made = make(scene_.now, dt, isBackward() || isAfterBreak(), 0);
        movement_.moveVelocities(ahead());
        return made;
    }
    double largestDensityBalance() const override { return options_.largestBalance(); }

  private:
    using Field = typename System<Real>::Field;

    // Every step, not only halves.
    bool isBackward() const { return damped || options_.settings.method == "backwardEuler"; }
    bool isAfterBreak() const { return state.steps > 0 && state.sinceBreak == 0; }

    // start: time at which this part of the step begins [s].
    Made make(double start, double dt, bool backward, int halvings) {
        BreakSearch search(dt, scene_.flow.rate);
        Outcome outcome = Outcome::otherLength;
        for (long tries = 0; outcome == Outcome::otherLength; ++tries) {
            if (tries > 0) ++statistics.breakTries;
            outcome = attempt(start, search, halvings == 0 ? planned_ : dt, backward);
        }
        if (outcome == Outcome::made) return end(search);
        dt = search.length();
        if (halvings == mostHalvings)
            throw Failure(ExitCode::numerics,
                          fmt::format("step {}: {}, even in {} parts; take a smaller step in 'implicit' of "
                                      "system/numerics.yaml",
                                      state.steps + 1, fault_, 1 << halvings));
        ++statistics.halvings;
        Made made = make(start, 0.5 * dt, true, halvings + 1);
        if (isAfterBreak() || made.length < 0.5 * dt) return made;  // the same on all ranks
        Made later = make(start + 0.5 * dt, 0.5 * dt, true, halvings + 1);
        later.length += made.length;
        return later;
    }

    // Ends a step that has been made: balance, rupture, counts.
    Made end(const BreakSearch& search) {
        ++statistics.steps;
        statistics.mostIterations = std::max(statistics.mostIterations, std::exchange(sinceStep_, 0));
        const double dt = search.length();
        Made made{dt, coupling::endStep(scene_, options_, ++state.steps, dt)};
        ++state.sinceBreak, state.breakTime += dt;
        if (!canRupture_) return made;
        const bool some = Communicator(scene_.system->comm()).anyTrue(!made.broken.empty());
        if (some)
            state.breakLimit = 2 * std::max(state.breakTime, search.resolution());
        else
            state.breakLimit = 2 * (search.isShortened() ? dt : state.breakLimit);
        if (state.breakLimit >= options_.settings.step / scene_.flow.rate) state.breakLimit = 0;
        allowed_.breaks = state.breakLimit;
        if (!some) return made;
        ++statistics.breaks;
        if (search.isCoarse()) ++statistics.coarseBreaks;
        movement_.moveVelocities(ahead());
        movement_.stopAccelerating();
        state.behind = state.lastSpacing = state.breakTime = 0, state.sinceBreak = 0;
        return made;
    }

    enum class Outcome { made, failed, otherLength };
    // Tries one step. If it is not made, everything is where it was, and the reason is in fault_, or another length in
    // `search`.
    Outcome attempt(double start, BreakSearch& search, double planned, bool backward) {
        const double dt = search.length();
        const TimeDifference time = backward ? TimeDifference::backwardEuler(dt, state)
                                             : TimeDifference::midpoint(dt, state, hasAcceleration());
        scene_.driveAt(start + time.begin());
        movement_.depart(time);
        if (immersed_ && immersed_->freeDeparture() < 1) {
            fault_ = "membranes would meet on the way to where forces are taken";
            movement_.takeBack(time);
            return Outcome::failed;
        }
        system_.prepare(time);
        system_.findGuess(velocity_);
        system_.findResidual(velocity_, residual_);
        takeDivergence(divergence_.value);
        preconditioner_->prepare();
        if (!solve()) {
            movement_.takeBack(time);
            return Outcome::failed;
        }
        if (canRupture_ &&
            !search.accepts(findBreaks(*immersed_, scene_.system->comm(), time.begin(),
                                       system_.membranes()->velocities(), search.horizon(), search.resolution()))) {
            movement_.takeBack(time);
            return Outcome::otherLength;
        }
        const double bondRate =
            immersed_ ? largestOfRanks(largestBondRate(*immersed_, system_.membranes()->velocities())) : 0;
        allowed_ = allowedSteps(options_.settings, scene_.flow.rate, {dt, planned, isBackward(), immersed_ != nullptr},
                                hasAcceleration() ? unevenness() * difference() : 0, bondRate);
        allowed_.contact = allowedByContact(time);
        finish();
        return Outcome::made;
    }

    // Whether the acceleration between two midpoints is known. After the first step, and after the first since bonds
    // broke, this is so only if the flow starts fully developed. With cells or bodies, where walls or a body force
    // start the flow, and where the viscosity jumps, the acceleration of the first step is a single jump, because the
    // initial velocity does not include the effect of the forces.
    bool hasAcceleration() const { return state.sinceBreak > (startsDeveloped() ? 0 : 1); }
    bool startsDeveloped() const {
        return !immersed_ && !system_.rigid() && !scene_.flow.settles && !scene_.store().optional().viscosity;
    }
    // Time by which the velocity in the store is later than the midpoint of the last step.
    double ahead() const { return hasAcceleration() ? state.behind : 0; }

    void takeDivergence(Field& divergence) const {
        divergence.resize(system_.owned());
        for (std::size_t i = 0; i < divergence.size(); ++i) divergence[i] = static_cast<Real>(system_.divergence(i));
    }

    // Solves for the velocity of this step, and leaves that of the nodes in the term of the membranes.
    bool solve() {
        const double reference = std::max(state.reference, leastDisturbance(scene_));
        const double tolerance =
            options_.settings.tolerance * toleranceShare(options_.settings, scene_.flow.rate, planned_);
        for (int refinement = 0;; ++refinement) {
            system_.shared().distribute(residual_.data(), static_cast<int>(particles::fieldWidth));
            const Convergence c = solver_.solve(
                scene_.system->comm(), residual_, correction_, reference, tolerance,
                [&](const Field& z, Field& w) {
                    system_.product(z, w);
                    takeDivergence(divergence_.image);
                },
                [&](const Field& r, Field& z) { preconditioner_->apply(r, z); }, system_.copies(), &divergence_);
            statistics.innerIterations += preconditioner_->takeInnerIterations();
            statistics.iterations += c.iterations;
            sinceStep_ += c.iterations;
            if (!c.reached) {
                fault_ = fmt::format("the solver did not converge in {} iterations", c.iterations);
                return false;
            }
            for (std::size_t k = 0; k < velocity_.size(); ++k) velocity_[k] += correction_[k];
            if (scene_.budget.kept) budget_.addLeft(residual_, refinement == 0);
            if (fault_ = system_.whyNot(velocity_, system_.time().dt); !fault_.empty()) return false;
            if (system_.isLinear()) return true;
            const double enough = linearisation * linearisation * std::max(reference, c.energy);
            if (refinement == mostRefinements || findDefect() <= enough) return true;
            system_.takeDefect(residual_);
            ++statistics.refinements;
        }
    }

    // Puts the defect into residual_; returns the energy of the velocity that it causes, as the preconditioner
    // estimates it.
    double findDefect() {
        system_.findDefect(residual_);
        preconditioner_->apply(residual_, correction_);
        double energy = 0;
        system_.copies().forCounted(residual_.size(), [&](std::size_t k) {
            energy += static_cast<double>(residual_[k]) * static_cast<double>(correction_[k]);
        });
        return Communicator(scene_.system->comm()).sum(energy);
    }

    // Factor by which the second difference over steps of this length would be larger than that over the last three
    // midpoints.
    double unevenness() const {
        const TimeDifference& time = system_.time();
        return isBackward() || state.lastSpacing == 0 ? 1
                                                      : 2 * time.dt * time.dt / (time.h * (time.h + state.lastSpacing));
    }

    // Difference between the computed velocity and the extrapolated one (with backward Euler, the last one), divided by
    // the lengths of stepControl.hpp [1/s].
    double difference() const {
        const double h = isBackward() ? 0 : system_.time().h;  // time over which the other one is extrapolated
        const RigidUnknowns<Real>* const rigid = system_.rigid();
        const bool freeBodies = rigid && rigid->areSomeFree();
        if (!immersed_ && !freeBodies) return differenceOfFluid(h) / scene_.flow.length;
        double largest = 0;
        if (immersed_)
            largest = differenceOfCells(*immersed_, scene_.system->comm(), system_.membranes()->velocities(),
                                        h > 0 ? system_.membranes()->extrapolated() : immersed_->velocities());
        if (freeBodies) largest = std::max(largest, rigid->largestDifference(h, velocity_));
        return largest;
    }
    // Largest next step for which the way to the positions where it evaluates forces is free. The way from x* to the
    // end of this step, and on for dt, is examined.
    double allowedByContact(const TimeDifference& time) const {
        if (!immersed_ || !immersed_->contacts()) return 0;
        const double rest = time.dt - time.begin();
        const double free = immersed_->freeArrival(time.begin(), time.dt, system_.membranes()->velocities(), time.dt);
        if (free == 1) return 0;
        const double ahead = 0.9 * free * (rest + time.dt) - rest;  // free time beyond the end of this step
        return std::max(ahead / (time.isAtEnd() ? 1 : 0.5), 0.2 * time.dt);
    }
    double largestOfRanks(double value) const { return Communicator(scene_.system->comm()).max(value); }
    double differenceOfFluid(double h) const {  // root mean square
        const ParticleStore& s = scene_.store();
        double square = 0, count = 0;
        for (std::size_t i = 0; i < s.size(); ++i) {
            if (system_.isPrescribed(i) || system_.isOfBody(i)) continue;
            const Vec3 a(s.fx[i], s.fy[i], s.fz[i]);
            square += (vectorAt(velocity_, i) - s.velocity(i) - h * a).squaredNorm();
            ++count;
        }
        const std::vector<double> sums = Communicator(scene_.system->comm()).sum(std::vector<double>{square, count});
        return sums[1] > 0 ? std::sqrt(sums[0] / sums[1]) : 0;
    }

    // Completes the step with the computed velocity: forces on walls, density, positions, and the state for the next
    // step.
    void finish() {
        ParticleStore& s = scene_.store();
        const TimeDifference& time = system_.time();
        if (system_.rigid()) system_.findForcesOnBodies(velocity_);
        const boundary::Walls& walls = scene_.model().walls;
        std::vector<Vec3> onWalls(walls.count(), Vec3::Zero());
        rate_.resize(s.size());
        for (std::size_t i = 0; i < s.size(); ++i) {
            rate_[i] = system_.rigid() ? system_.divergence(i) : static_cast<double>(divergence_.value[i]);
            if (system_.isPrescribed(i))
                onWalls[static_cast<std::size_t>(walls.nearest(s.position(i)).number)] += vectorAt(residual_, i);
        }
        if (immersed_)
            for (const auto& on : system_.membranes()->forcesOnWalls())
                onWalls[static_cast<std::size_t>(on.wall)] += on.force;
        scene_.forces->setWallForces(std::move(onWalls));
        if (scene_.budget.kept) budget_.keep(velocity_, residual_, rate_);
        state.reference = disturbanceOf(system_, velocity_, rate_);
        for (std::size_t i = 0; i < s.size(); ++i) {
            s.densityRate[i] = -s.density[i] * rate_[i];
            s.density[i] = time.density(s.density[i], rate_[i]);
        }
        coupling::relaxDensities(scene_, system_.operators(), options_.densityRate, time.dt);
        scene_.moveSolute(time.dt, time.dt - time.begin());
        movement_.arrive(velocity_);
        state.behind = time.dt - time.begin(), state.lastSpacing = time.h;
    }

    Scene& scene_;
    Options options_;
    bool canRupture_ = false;
    std::string fault_;
    System<Real> system_;
    std::unique_ptr<Preconditioner<Real>> preconditioner_;
    Movement<Real> movement_;
    StepBudget<Real> budget_;
    ConjugateGradients<Real> solver_;
    double planned_ = 0;  // length of the step without an event that shortens it [s]
    long sinceStep_ = 0;  // iterations of all solves and attempts since the last step that was completed
    Field velocity_, residual_, correction_;
    typename ConjugateGradients<Real>::Carried divergence_;
    std::vector<double> rate_;  // divergence of the computed velocity
};

}  // namespace

std::unique_ptr<ImplicitStep> ImplicitStep::make(Scene& scene, const Options& options) {
    if (scene.system->precision() == particles::Precision::mixed) return std::make_unique<Step<float>>(scene, options);
    return std::make_unique<Step<double>>(scene, options);
}

}  // namespace corpuscle::implicit
