#include "schemes/adjointVerlet.hpp"

#include "coupling/adjointVerlet.hpp"
#include "schemes/explicitStepper.hpp"
#include "schemes/schemeParts.hpp"

namespace corpuscle::schemes {

namespace {

constexpr long stepsPerEstimate = 1000;

class AdjointVerletStepper final : public ExplicitStepper {
  public:
    AdjointVerletStepper(const NumericsSettings& numerics, coupling::Scene& scene)
        : ExplicitStepper(scene, numerics, stepsPerEstimate),
          step_(coupling::AdjointVerlet::make(scene, adjointOptions(numerics, scene))) {}

    double advance(double dt, double /*planned*/) override {
        scene_.driveAt(scene_.now + 0.5 * dt);
        scene_.broken = step_->advance(dt);
        if (step_->noFlux()) scene_.movedBack = step_->noFlux()->crossings();
        return dt;
    }
    double largestDensityBalance() const override { return step_->largestDensityBalance(); }
    long mostFallbacks() const override { return step_->immersed() ? step_->immersed()->mostFallbacks() : 0; }

  private:
    void startScheme() override { step_->start(); }
    void resumeScheme(long count) override { step_->resume(count, scene_.movedBack); }
    long count() const override { return step_->steps(); }
    ExplicitRates estimate() override {
        const coupling::AdjointVerlet::Rates rates = step_->rates(powerIterations);
        return {powerReserve * rates.viscous, powerReserve * rates.membrane, powerReserve * rates.spring2};
    }

    std::unique_ptr<coupling::AdjointVerlet> step_;
};

class AdjointVerlet final : public Scheme {
  public:
    Traits traits() const override { return {.isAdjoint = true, .nodeMemory = 4000, .state = "adjoint"}; }

    void check(const CaseFacts& facts, const NumericsSettings& numerics, Problems& problems) const override {
        const bool corrected = numerics.isCorrected();
        if (facts.hasCells && corrected && !numerics.isImmersed())
            problems.add(numericsFile, "operators",
                         "found corrected, which go with 'coupling: immersed'; write that, or operators: plain");
        checkShifting(numerics, problems);
        checkJumps(facts, numerics, problems);
        if (facts.hasBodies)
            problems.add(numericsFile, corrected ? "operators" : "coupling",
                         std::string("found ") + (corrected ? "corrected" : "immersed") +
                             ", but system/mesh.yaml has bodies, which 'integrator: velocityVerlet' moves with " +
                             (facts.hasCells ? "'coupling: dualIdentity' and " : "") +
                             "'operators: plain' only; write that, or integrator: implicit");
    }

    std::vector<UnusedKey> unused(const NumericsSettings& numerics) const override {
        std::vector<UnusedKey> keys;
        if (numerics.isImmersed()) keys.push_back(unusedGuard());
        keys.push_back(
            {"shifting.steps", std::string("with ") +
                                   (numerics.isCorrected() ? "'operators: corrected'" : "'coupling: immersed'") +
                                   ", where particles are shifted at every step"});
        return keys;
    }

    sph::StepLimits limits(const CaseFacts& facts, const NumericsSettings& numerics, double /*t*/) const override {
        return verletLimits(facts, numerics, facts.adjointSoundSpeed);
    }
    double passes(const CaseFacts&, const NumericsSettings&, double /*dt*/) const override { return 4; }

    std::unique_ptr<Stepper> stepper(const CaseFacts&, const NumericsSettings& numerics,
                                     coupling::Scene& scene) const override {
        return std::make_unique<AdjointVerletStepper>(numerics, scene);
    }
};

}  // namespace

std::shared_ptr<const Scheme> adjointVerlet() {
    static const auto scheme = std::make_shared<const AdjointVerlet>();
    return scheme;
}

}  // namespace corpuscle::schemes
