// One symmetric positive-definite system for the velocity at the midpoint of the step (implicit/implicitStep.hpp).
#include <fmt/format.h>

#include "implicit/implicitStep.hpp"
#include "schemes/schemeParts.hpp"
#include "schemes/stepper.hpp"

namespace corpuscle::schemes {

namespace {

// The step that resolves the time scale on which the flow itself changes [s]; 0: no limit. The start of a flow that
// settles is not resolved if the run goes on for far longer: as for a cell in a tube, where the flow settles in
// microseconds and the cell travels for tenths of a second.
double longestStep(const CaseFacts& facts) {
    constexpr double stepsPerTransient = 40, stepsPerChange = 16, transientsOfAStart = 100;
    const double drive = facts.flow.drive ? facts.flow.drive->changesIn() / stepsPerChange : 0;
    if (facts.flow.transient == 0 || (facts.flow.settles && facts.duration > transientsOfAStart * facts.flow.transient))
        return drive;
    const double own = facts.flow.transient / stepsPerTransient;
    return drive > 0 ? std::min(drive, own) : own;
}

class ImplicitStepper final : public Stepper {
  public:
    ImplicitStepper(const implicit::ImplicitSettings& settings, const NumericsSettings& numerics, double fullStep,
                    coupling::Scene& scene)
        : scene_(scene),
          fullStep_(fullStep),
          step_(implicit::ImplicitStep::make(scene, {adjointOptions(numerics, scene), settings})) {}

    void start() override {}
    std::vector<double> state() const override {
        const implicit::ImplicitStep::State& s = step_->state;
        return {
            s.behind,    s.lastSpacing, s.reference, static_cast<double>(s.steps), static_cast<double>(s.sinceBreak),
            s.breakTime, s.breakLimit};
    }
    std::size_t stateSize() const override { return 7; }
    void resume(const std::vector<double>& state) override {
        step_->resume({state.at(0), state.at(1), state.at(2), std::lround(state.at(3)), std::lround(state.at(4)),
                       state.at(5), state.at(6)},
                      scene_.movedBack);
    }
    // The limit follows from the case, whose shear rate may have been changed for the restart.
    double resumedStep(double kept, double allowed) const override { return std::min(kept, allowed); }

    double advance(double dt, double planned) override {
        implicit::ImplicitStep::Made made = step_->advance(dt, planned);
        scene_.broken = std::move(made.broken);
        if (step_->noFlux()) scene_.movedBack = step_->noFlux()->crossings();
        return made.length;
    }
    void damp(bool damped) override { step_->damped = damped; }
    long tries() const override { return step_->statistics.steps + step_->statistics.halvings; }

    bool limitsChange(long /*step*/) override { return true; }
    sph::StepLimits limits(double /*t*/) override {
        sph::StepLimits limits;
        limits.add("strain", fullStep_);
        if (const double error = step_->allowed().error; error > 0)
            limits.add(
                "error", error,
                "nodes of the membrane or bodies change their velocity faster than 'implicit.error' of "
                "system/numerics.yaml allows: take a larger one, or a finer mesh, or look for a membrane that is "
                "far stiffer than the flow (Ca)");
        if (const double bond = step_->allowed().bond; bond > 0)
            limits.add("bond strain", bond,
                       "a bond changes its length faster than 'implicit.bondStrain' of system/numerics.yaml allows: "
                       "look for edges far below the spacing in 0/ (checkMesh), take a larger 'edge' in "
                       "system/mesh.yaml, or a larger bondStrain");
        if (const double contact = step_->allowed().contact; contact > 0)
            limits.add("contact", contact,
                       "membranes come near each other or a wall faster than the law of constant/contact.yaml holds "
                       "them off: take a larger reach, or more strength");
        if (const double breaks = step_->allowed().breaks; breaks > 0)
            limits.add(
                "breaks", breaks,
                "cells can break: the first steps are short, and so are those while bonds break in quick succession. "
                "If it "
                "goes on, the membrane bears far less than what the flow does to it: in constant/membranes.yaml take a "
                "greater limit or fractureEnergy, or in constant/flow.yaml a smaller shear rate");
        return limits;
    }

    double largestDensityBalance() const override { return step_->largestDensityBalance(); }
    long mostFallbacks() const override { return step_->immersed() ? step_->immersed()->mostFallbacks() : 0; }
    void takeOver(const Stepper& before) override {
        step_->statistics = static_cast<const ImplicitStepper&>(before).step_->statistics;
    }
    void report(RunRecord& record, Log& log, long steps) const override {
        const auto& statistics = step_->statistics;
        const auto number = static_cast<double>(std::max(1L, steps));
        const double perStep = static_cast<double>(statistics.iterations) / number,
                     inner = static_cast<double>(statistics.innerIterations) / number;
        record.set("performance", "iterationsPerStep", perStep);
        record.set("performance", "innerIterationsPerStep", inner);
        record.set("extremes", "mostIterations", statistics.mostIterations);
        record.set("performance", "refinements", statistics.refinements);
        record.set("performance", "halvings", statistics.halvings);
        log.info(
            "implicit step: {:.1f} iterations per step, {} at most; {:.1f} inner ones on the nodes; refined {} times, "
            "halved {} times",
            perStep, statistics.mostIterations, inner, statistics.refinements, statistics.halvings);
        if (statistics.breaks == 0 && statistics.breakTries == 0) return;
        record.set("performance", "stepsThatBreak", statistics.breaks);
        record.set("performance", "triesForBreaks", statistics.breakTries);
        record.set("performance", "coarseBreaks", statistics.coarseBreaks);
        log.info("rupture: {} steps ended where bonds broke, found in {} further tries; {} could not be found closely",
                 statistics.breaks, statistics.breakTries, statistics.coarseBreaks);
    }

  private:
    coupling::Scene& scene_;
    double fullStep_;
    std::unique_ptr<implicit::ImplicitStep> step_;
};

struct Implicit final : Scheme, implicit::ImplicitSettings {
    static const Schema<Implicit>& schema() {
        static const Schema<Implicit> s = Schema<Implicit>("implicit", "the implicit step; its size is set by accuracy")
                                              .include<implicit::ImplicitSettings>();
        return s;
    }

    Traits traits() const override {
        return {.isAdjoint = true,
                .listsEveryStep = true,
                .solvesForBodies = true,
                .hasContact = true,
                .knowsSlides = true,
                .hasDampedSteps = true,
                .stepsPerBalance = 1,
                .stepsPerKeptState = 5,
                .stepsPerLook = 1,
                .nodeMemory = 6000,  // 4800 to 6900: springs to Helfrich's bending, whose stiffness reaches further
                .stepKey = "implicit.step",
                .state = "implicit"};
    }

    std::string usualCoupling(const CaseFacts&) const override { return "immersed"; }
    std::string usualOperators(const CaseFacts&, const NumericsSettings&) const override { return "corrected"; }
    std::shared_ptr<const Scheme> settled(const CaseFacts& facts) const override {
        const double longest = longestStep(facts) * facts.flow.rate;
        if (longest <= 0 || facts.isWritten("implicit.step") || step <= longest) return nullptr;
        auto shorter = std::make_shared<Implicit>(*this);
        shorter->step = longest;
        return shorter;
    }

    void check(const CaseFacts& facts, const NumericsSettings& numerics, Problems& problems) const override {
        if (facts.hasCells && !numerics.isImmersed())
            problems.add(numericsFile, "coupling",
                         "found dualIdentity, which goes with 'integrator: velocityVerlet'; write coupling: immersed");
        checkShifting(numerics, problems);
        checkJumps(facts, numerics, problems);
    }
    std::string unfit(const CaseFacts& facts, const NumericsSettings& numerics) const override {
        const double longest = longestStep(facts);
        if (longest > 0 && fullStep(facts, 0) > (1 + 1e-9) * longest)
            return fmt::format(
                "its steps do not follow the flow, which changes within {}; implicit.step at most {:.2g} would",
                formatQuantity(facts.flow.drive ? std::min(facts.flow.drive->changesIn(), facts.flow.transient)
                                                : facts.flow.transient,
                               unit::second),
                longest * facts.flow.rate);
        return Scheme::unfit(facts, numerics);
    }
    std::vector<UnusedKey> unused(const NumericsSettings&) const override {
        const std::string with = "with 'integrator: implicit', ";
        return {{"safety", with + "where 'implicit.step' sets the step"},
                {"skin", with + "where lists are built at every step"},
                unusedGuard(),
                {"shifting.steps", with + "where particles are shifted at every step"}};
    }

    sph::StepLimits limits(const CaseFacts& facts, const NumericsSettings&, double /*t*/) const override {
        sph::StepLimits limits;
        limits.add("strain", fullStep(facts, 0));
        return limits;
    }
    double passes(const CaseFacts& facts, const NumericsSettings&, double /*dt*/) const override {
        constexpr double overhead = 3.5, perIteration = 2, iterations = 4, iterationsWithin = 12;
        return overhead + perIteration * (facts.hasCells || facts.hasBodies ? iterationsWithin : iterations);
    }
    double fullStep(const CaseFacts& facts, double /*first*/) const override { return step / facts.flow.rate; }

    std::unique_ptr<Stepper> stepper(const CaseFacts& facts, const NumericsSettings& numerics,
                                     coupling::Scene& scene) const override {
        return std::make_unique<ImplicitStepper>(*this, numerics, fullStep(facts, 0), scene);
    }
};

CORPUSCLE_REGISTER(Scheme, Implicit, "implicit", "the implicit step");

}  // namespace

}  // namespace corpuscle::schemes
