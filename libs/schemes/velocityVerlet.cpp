// Velocity Verlet of the paper (sph/velocityVerlet.hpp), whose loads are rigid bodies and the dual identity of nodes.
// With corrected operators or immersed membranes, velocity Verlet on adjoint operators takes its place
// (adjointVerlet.hpp).
#include "sph/velocityVerlet.hpp"

#include "schemes/adjointVerlet.hpp"
#include "schemes/explicitStepper.hpp"
#include "schemes/schemeParts.hpp"

namespace corpuscle::schemes {

namespace {

constexpr long stepsPerEstimate = 1000;

class VelocityVerletStepper final : public ExplicitStepper {
  public:
    VelocityVerletStepper(const NumericsSettings& numerics, coupling::Scene& scene)
        : ExplicitStepper(scene, numerics, stepsPerEstimate) {
        std::vector<sph::Load*> loads;
        scene.coupling.reset();
        if (scene.cells.exist()) {
            scene.coupling = std::make_unique<coupling::DualIdentity>(
                scene.cells, scene.spacing, densityBalance(scene),
                coupling::DualIdentity::Intervals{numerics.guard, numerics.balanceInterval()});
            loads.push_back(scene.coupling.get());
        }
        if (scene.bodies) loads.push_back(scene.bodies.get());
        step_ =
            std::make_unique<sph::VelocityVerlet>(*scene.system, *scene.forces, scene.shifting.get(), loads, budget());
    }

    double advance(double dt, double /*planned*/) override {
        scene_.driveAt(scene_.now + dt);
        step_->advance(dt);
        scene_.moveSolute(dt);
        if (!scene_.coupling) return dt;
        scene_.broken = scene_.coupling->endStep(*scene_.system, dt, budget());
        scene_.movedBack = scene_.coupling->guard().moves();
        return dt;
    }
    double largestDensityBalance() const override {
        return scene_.coupling ? scene_.coupling->densityBalance().largest() : 0;
    }

  private:
    void startScheme() override { step_->start(); }
    void resumeScheme(long count) override {
        step_->resume();
        if (!scene_.coupling) return;
        scene_.coupling->restore(count);
        scene_.coupling->guard().restore(scene_.movedBack);
    }
    long count() const override { return scene_.coupling ? scene_.coupling->steps() : 0; }
    ExplicitRates estimate() override {
        ExplicitRates rates;
        rates.viscous = powerReserve * scene_.forces->viscousRate(*scene_.system, powerIterations);
        if (!scene_.coupling) return rates;
        rates.membrane = powerReserve * scene_.coupling->membraneRate(*scene_.system, powerIterations);
        rates.spring2 = powerReserve * scene_.coupling->springRate2(*scene_.system, powerIterations);
        return rates;
    }

    std::unique_ptr<sph::VelocityVerlet> step_;
};

struct VelocityVerlet final : Scheme {
    static const Schema<VelocityVerlet>& schema() {
        static const Schema<VelocityVerlet> s("velocityVerlet", "velocity Verlet");
        return s;
    }

    Traits traits() const override { return {}; }

    std::string usualOperators(const CaseFacts& facts, const NumericsSettings& numerics) const override {
        return numerics.isImmersed() && facts.hasCells && !facts.hasBodies ? "corrected" : "plain";
    }
    std::shared_ptr<const Scheme> variant(const CaseFacts& facts, const NumericsSettings& numerics) const override {
        return numerics.isCorrected() || (numerics.isImmersed() && facts.hasCells) ? adjointVerlet() : nullptr;
    }

    void check(const CaseFacts&, const NumericsSettings&, Problems&) const override {}

    std::vector<UnusedKey> unused(const NumericsSettings& numerics) const override {
        std::vector<UnusedKey> keys = unusedShifting();
        if (numerics.isImmersed()) keys.push_back(unusedGuard());
        return keys;
    }

    sph::StepLimits limits(const CaseFacts& facts, const NumericsSettings& numerics, double /*t*/) const override {
        return verletLimits(facts, numerics, facts.soundSpeed);
    }
    double passes(const CaseFacts&, const NumericsSettings&, double /*dt*/) const override { return 1; }

    std::unique_ptr<Stepper> stepper(const CaseFacts&, const NumericsSettings& numerics,
                                     coupling::Scene& scene) const override {
        return std::make_unique<VelocityVerletStepper>(numerics, scene);
    }
};

CORPUSCLE_REGISTER(Scheme, VelocityVerlet, "velocityVerlet",
                   "explicit, of second order; its step is limited by viscosity, sound and the membranes' stiffness");

}  // namespace

}  // namespace corpuscle::schemes
