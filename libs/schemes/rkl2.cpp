// For a fluid alone, with viscosity by super-time-stepping (sph/rkl2.hpp).
#include "sph/rkl2.hpp"

#include "schemes/explicitStepper.hpp"
#include "schemes/schemeParts.hpp"

namespace corpuscle::schemes {

namespace {

constexpr long stepsPerEstimate = 100;

class Rkl2Stepper final : public ExplicitStepper {
  public:
    Rkl2Stepper(const sph::Rkl2Settings& settings, const CaseFacts& facts, const NumericsSettings& numerics,
                coupling::Scene& scene)
        : ExplicitStepper(scene, numerics, stepsPerEstimate),
          settings_(settings),
          flow_(facts.flow),
          step_(*scene.system, *scene.forces, scene.shifting.get(), budget()) {}

    double advance(double dt, double /*planned*/) override {
        scene_.driveAt(scene_.now + 0.5 * dt);
        step_.advance(dt);
        if (!scene_.solute) return dt;
        if (scene_.system->mustRebuild()) {  // the step ends with a drift
            scene_.system->rebuild();
            step_.resume();
        }
        scene_.moveSolute(dt);
        return dt;
    }
    // Its limits depend on the time.
    bool limitsChange(long step) override {
        ExplicitStepper::limitsChange(step);
        return true;
    }
    int stages(double dt) const override { return step_.stages(dt); }

  private:
    void startScheme() override { step_.start(); }
    void resumeScheme(long /*count*/) override { step_.resume(); }
    long count() const override { return 0; }
    ExplicitRates estimate() override {
        ExplicitRates rates;
        rates.viscous = powerReserve * scene_.forces->viscousRate(*scene_.system, powerIterations);
        return rates;
    }
    void setRates(const ExplicitRates& rates) override { step_.setRate(rates.viscous / safety_); }
    void addLimits(const ExplicitMedium& medium, double t, sph::StepLimits& limits) const override {
        settings_.addLimits(flow_, t, rates_.viscous / safety_, limits);
        addOtherLimits(rates_, medium, sph::Rkl2::acousticReach, limits);
    }

    sph::Rkl2Settings settings_;
    sph::FlowState flow_;
    sph::Rkl2 step_;
};

struct Rkl2 final : Scheme, sph::Rkl2Settings {
    static const Schema<Rkl2>& schema() {
        static const Schema<Rkl2> s = Schema<Rkl2>("rkl2",
                                                   "super-time-stepping of viscosity; its step is set by sound "
                                                   "and by accuracy")
                                          .include<sph::Rkl2Settings>();
        return s;
    }

    Traits traits() const override { return {}; }

    void check(const CaseFacts& facts, const NumericsSettings& numerics, Problems& problems) const override {
        if (facts.hasCells)
            problems.add(numericsFile, "integrator",
                         "found rkl2, which is for a fluid alone, but system/mesh.yaml has cells; write "
                         "velocityVerlet, or implicit with coupling: immersed");
        if (facts.hasBodies)
            problems.add(numericsFile, "integrator",
                         "found rkl2, which is for a fluid alone, but system/mesh.yaml has bodies; write "
                         "velocityVerlet, or implicit");
        if (numerics.isCorrected())
            problems.add(numericsFile, "operators",
                         "found corrected, which 'integrator: rkl2' does not have; write operators: plain, or another "
                         "integrator");
    }

    std::vector<UnusedKey> unused(const NumericsSettings& numerics) const override {
        std::vector<UnusedKey> keys = unusedShifting();
        if (numerics.isImmersed()) keys.push_back(unusedGuard());
        return keys;
    }

    sph::StepLimits limits(const CaseFacts& facts, const NumericsSettings& numerics, double t) const override {
        const ExplicitRates rates{predictedRates(facts, numerics).viscous, 0, 0};
        sph::StepLimits limits;
        addLimits(facts.flow, t, rates.viscous / numerics.safety, limits);
        addOtherLimits(rates, predictedMedium(facts, numerics, facts.soundSpeed), sph::Rkl2::acousticReach, limits);
        return limits;
    }
    double passes(const CaseFacts& facts, const NumericsSettings& numerics, double dt) const override {
        return sph::LegendreStages::needed(predictedRates(facts, numerics).viscous / numerics.safety * dt) + 1;
    }

    std::unique_ptr<Stepper> stepper(const CaseFacts& facts, const NumericsSettings& numerics,
                                     coupling::Scene& scene) const override {
        return std::make_unique<Rkl2Stepper>(*this, facts, numerics, scene);
    }
};

CORPUSCLE_REGISTER(Scheme, Rkl2, "rkl2", "super-time-stepping");

}  // namespace

}  // namespace corpuscle::schemes
