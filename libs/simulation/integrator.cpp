#include "simulation/integrator.hpp"

#include <algorithm>
#include <cmath>

namespace corpuscle::simulation {

using coupling::Scene;

namespace {
constexpr int powerIterations = 25;
constexpr double powerReserve = 1.03;  // power iterations approach the eigenvalue from below
constexpr long stepsPerEstimate = 1000, rkl2StepsPerEstimate = 100;

coupling::DensityBalance densityBalance(const Scene& scene) {
    double volume = scene.fluidBox.volume();
    if (scene.bodies)
        for (const bodies::Body& body : scene.bodies->all())
            if (body.cell == 0) volume -= body.solid.volume;
    return {volume, scene.model().density, scene.model().mass};
}
}  // namespace

std::vector<std::vector<std::string>> limitRows(const sph::StepLimits& limits) {
    const std::string stages = limits.stages > 0 ? ": " + std::to_string(limits.stages) + " stages" : "";
    const std::string binding = limits.binding().name;
    std::vector<std::vector<std::string>> rows;
    for (const sph::StepLimit& limit : limits.all)
        rows.push_back(
            {limit.name, formatQuantity(limit.seconds, unit::second), limit.name == binding ? "binding" + stages : ""});
    return rows;
}

Integrator::Integrator(const Case& input, Scene& scene) : input_(input), scene_(scene) { make(); }

void Integrator::make() {
    if (input_.numerics.isRkl2())
        makeRkl2();
    else if (input_.isConjugate())
        makeConjugate();
    else
        makeExplicit();
}

void Integrator::makeExplicit() {
    const Case& input = input_;
    Scene& scene = scene_;
    std::vector<sph::Load*> loads;
    if (!scene.cells.empty()) {
        scene.coupling = std::make_unique<coupling::DualIdentity>(
            scene.cells, scene.spacing, densityBalance(scene),
            coupling::DualIdentity::Intervals{input.numerics.guard, input.numerics.balanceInterval()});
        loads.push_back(scene.coupling.get());
    }
    if (scene.bodies) loads.push_back(scene.bodies.get());
    scheme_ =
        std::make_unique<sph::VelocityVerlet>(*scene.system, *scene.forces, scene.shifting.get(), loads, account());
}

void Integrator::makeConjugate() {
    const NumericsSettings& numerics = input_.numerics;
    coupling::ConjugateOptions options;
    if (!numerics.isCorrected()) options.form = sph::OperatorForm::plain;
    if (numerics.shifting) options.shifting = numerics.shifting->coefficient;
    if (numerics.balanceInterval() > 0) options.densityBalance = densityBalance(scene_);
    options.balanceInterval = numerics.balanceInterval();
    if (numerics.isImplicit())
        implicit_ = implicit::ImplicitStep::make(scene_, {options, numerics.implicit});
    else
        conjugate_ = coupling::ConjugateVerlet::make(scene_, options);
}

void Integrator::makeRkl2() {
    auto rkl2 = std::make_unique<sph::Rkl2>(*scene_.system, *scene_.forces, scene_.shifting.get(), account());
    rkl2_ = rkl2.get();
    scheme_ = std::move(rkl2);
}

Integrator::State Integrator::state(const Time& time) const {
    return {viscousRate_,
            membraneRate_,
            springRate2_,
            time.dt,
            implicit_ ? implicit_->state : implicit::ImplicitStep::State{},
            conjugate_ ? conjugate_->steps() : 0};
}

void Integrator::start(Time& time) {
    if (scheme_) scheme_->start();
    if (conjugate_) conjugate_->start();
    if (!implicit_) estimateRates();
    updateLimits(time);
}

void Integrator::resume(const State& state, Time& time) {
    if (scheme_) scheme_->resume();
    if (conjugate_) conjugate_->resume(state.conjugateSteps, scene_.putBack);
    if (implicit_) implicit_->resume(state.implicit, scene_.putBack);
    viscousRate_ = state.viscousRate;
    membraneRate_ = state.membraneRate;
    springRate2_ = state.springRate2;
    if (rkl2_) rkl2_->setRate(viscousRate_ / input_.numerics.safety);
    updateLimits(time);
    // The implicit step's limit follows from the case, which may have another shear rate now.
    time.dt = implicit_ ? std::min(state.dt, time.dt) : state.dt;
}

void Integrator::goBack(const State& state, Time& time) {
    largestBalance_ = largestDensityBalance();
    mostFallbacks_ = mostFallbacks();
    const auto statistics = implicit_ ? implicit_->statistics : implicit::ImplicitStep::Statistics{};
    rkl2_ = nullptr;
    scheme_.reset(), conjugate_.reset(), implicit_.reset(), scene_.coupling.reset();
    make();
    if (implicit_) implicit_->statistics = statistics;
    resume(state, time);
}

void Integrator::shorten(double longest, bool damped) {
    longest_ = longest;
    if (implicit_) implicit_->damped = damped;
}

void Integrator::advance(Scene& scene, Time& time, const std::vector<Event>& events) {
    const double dt = time.shorten(events);
    tried_ = time.dt, shortened_ = dt < time.dt;
    if (implicit_) {
        scene.broken = implicit_->advance(dt, time.dt);
        if (implicit_->noFlux()) scene.putBack = implicit_->noFlux()->crossings();
        time.advance(dt);
        updateLimits(time);
        return;
    }
    if (conjugate_) {
        scene.broken = conjugate_->advance(dt);
        if (conjugate_->noFlux()) scene.putBack = conjugate_->noFlux()->crossings();
    } else
        scheme_->advance(dt);
    if (scene.coupling) {
        scene.broken = scene.coupling->endStep(*scene.system, dt, account());
        scene.putBack = scene.coupling->guard().moves();
    }
    time.advance(dt);
    if (time.step % (rkl2_ ? rkl2StepsPerEstimate : stepsPerEstimate) == 0) estimateRates();
    if (rkl2_ || scene.system->rebuilds() != rebuilds_) updateLimits(time);
}

void Integrator::estimateRates() {
    if (conjugate_) {
        const coupling::ConjugateVerlet::Rates rates = conjugate_->rates(powerIterations);
        viscousRate_ = powerReserve * rates.viscous, membraneRate_ = powerReserve * rates.membrane;
        springRate2_ = powerReserve * rates.spring2;
        return;
    }
    viscousRate_ = powerReserve * scene_.forces->viscousRate(*scene_.system, powerIterations);
    if (rkl2_) rkl2_->setRate(viscousRate_ / input_.numerics.safety);
    if (!scene_.coupling) return;
    membraneRate_ = powerReserve * scene_.coupling->membraneRate(*scene_.system, powerIterations);
    springRate2_ = powerReserve * scene_.coupling->springRate2(*scene_.system, powerIterations);
}

double Integrator::largestDensityBalance() const {
    const double since = implicit_         ? implicit_->largestDensityBalance()
                         : conjugate_      ? conjugate_->largestDensityBalance()
                         : scene_.coupling ? scene_.coupling->densityBalance().largest()
                                           : 0;
    return std::max(since, largestBalance_);
}

long Integrator::mostFallbacks() const {
    const coupling::Immersed* immersed = implicit_    ? implicit_->immersed()
                                         : conjugate_ ? conjugate_->immersed()
                                                      : nullptr;
    return std::max(immersed ? immersed->mostFallbacks() : 0, mostFallbacks_);
}

void Integrator::updateLimits(Time& time) {
    if (implicit_) {
        limits_.all.clear();
        limits_.add("strain", input_.numerics.implicit.step / input_.flow.rate);
        if (implicit_->allowed().error > 0) limits_.add("error", implicit_->allowed().error);
        if (implicit_->allowed().bond > 0) limits_.add("bond strain", implicit_->allowed().bond);
        if (longest_ < std::numeric_limits<double>::infinity()) limits_.add("retreat", longest_);
        time.dt = limits_.binding().seconds;
        return;
    }
    const auto& s = scene_.store();
    const sph::FluidModel& model = scene_.model();
    double most = 0;
    for (std::size_t i = 0; i < s.size(); ++i)
        most = std::max(most, s.u[i] * s.u[i] + s.v[i] * s.v[i] + s.w[i] * s.w[i]);
    MPI_Allreduce(MPI_IN_PLACE, &most, 1, MPI_DOUBLE, MPI_MAX, scene_.system->comm());

    const double h = 0.5 * scene_.system->support(), safety = input_.numerics.safety;
    limits_.all.clear();
    if (rkl2_)
        input_.numerics.rkl2.addLimits(input_.flow, time.t, viscousRate_ / safety, limits_);
    else if (viscousRate_ > 0)
        limits_.add("viscous", safety / viscousRate_);
    const double drag = viscousRate_ + membraneRate_;
    if (membraneRate_ > 0) limits_.add("membrane viscosity", safety / drag);
    limits_.add("acoustic",
                (rkl2_ ? sph::Rkl2::acousticReach : 1) * sph::acousticStep(h, model.soundSpeed + std::sqrt(most)));
    if (!model.bodyForce.isZero()) limits_.add("body force", sph::bodyForceStep(h, model.bodyForce.norm()));
    if (springRate2_ > 0) limits_.add("spring", safety * sph::springStep(drag, springRate2_));
    if (longest_ < std::numeric_limits<double>::infinity()) limits_.add("retreat", longest_);
    time.dt = limits_.binding().seconds;
    if (rkl2_) limits_.stages = rkl2_->stages(time.dt);
    rebuilds_ = scene_.system->rebuilds();
}

}  // namespace corpuscle::simulation
