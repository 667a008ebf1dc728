// Scheme `modelName`: a fluid without cells, by symplectic Euler:
//     a, rhodot at x, u, rho;   u <- u + dt a,   rho <- rho + dt rhodot,   x <- x + dt u
// First order in dt; the limits of the step are those of velocity Verlet.
#include "schemes/explicitStepper.hpp"
#include "schemes/schemeParts.hpp"

namespace corpuscle::schemes {

namespace {

constexpr long stepsPerEstimate = 1000;

class ModelNameStepper final : public ExplicitStepper {
  public:
    ModelNameStepper(const NumericsSettings& numerics, coupling::Scene& scene)
        : ExplicitStepper(scene, numerics, stepsPerEstimate) {}

    double advance(double dt, double /*planned*/) override {
        particles::ParticleSystem& system = *scene_.system;
        if (system.mustRebuild()) {
            system.rebuild();
            scene_.forces->findWalls(system);
        }
        scene_.forces->evaluate(system, 0);
        particles::ParticleStore& s = system.store();
        for (std::size_t i = 0; i < s.size(); ++i) {
            s.setVelocity(i, s.velocity(i) + dt * Vec3(s.fx[i], s.fy[i], s.fz[i]));
            s.density[i] += dt * s.densityRate[i];
            s.setPosition(i, s.position(i) + dt * s.velocity(i));
        }
        return dt;
    }

  private:
    void startScheme() override { scene_.forces->findWalls(*scene_.system); }
    void resumeScheme(long /*count*/) override { scene_.forces->findWalls(*scene_.system); }
    long count() const override { return 0; }
    ExplicitRates estimate() override {
        ExplicitRates rates;
        rates.viscous = powerReserve * scene_.forces->viscousRate(*scene_.system, powerIterations);
        return rates;
    }
};

struct ModelName final : Scheme {
    static const Schema<ModelName>& schema() {
        static const Schema<ModelName> s("modelName", "symplectic Euler");
        return s;
    }

    Traits traits() const override { return {.state = "modelName"}; }

    void check(const CaseFacts& facts, const NumericsSettings& numerics, Problems& problems) const override {
        if (facts.hasCells || facts.hasBodies)
            problems.add(numericsFile, "integrator",
                         "found modelName, which is for a fluid alone, but system/mesh.yaml has cells or bodies; write "
                         "another integrator");
        if (numerics.isCorrected())
            problems.add(numericsFile, "operators",
                         "found corrected, which 'integrator: modelName' does not have; write operators: plain");
    }
    // `automatic` does not choose this scheme, since others cost as little and are more accurate.
    std::string unfit(const CaseFacts&, const NumericsSettings&) const override { return "it is of first order"; }
    std::vector<UnusedKey> unused(const NumericsSettings&) const override { return {unusedGuard()}; }

    sph::StepLimits limits(const CaseFacts& facts, const NumericsSettings& numerics, double /*t*/) const override {
        return verletLimits(facts, numerics, facts.soundSpeed);
    }
    double passes(const CaseFacts&, const NumericsSettings&, double /*dt*/) const override { return 1; }

    std::unique_ptr<Stepper> stepper(const CaseFacts&, const NumericsSettings& numerics,
                                     coupling::Scene& scene) const override {
        return std::make_unique<ModelNameStepper>(numerics, scene);
    }
};

CORPUSCLE_REGISTER(Scheme, ModelName, "modelName", "symplectic Euler, of first order; a fluid alone");

}  // namespace

}  // namespace corpuscle::schemes
