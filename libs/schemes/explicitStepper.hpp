// What the steppers of explicit schemes have in common: rates by power iterations, which a checkpoint keeps, and the
// limits that follow from them. Limits are recomputed when lists are rebuilt, rates every `stepsPerEstimate` steps.
#pragma once
#include "coupling/scene.hpp"
#include "schemes/explicitLimits.hpp"
#include "schemes/numericsSettings.hpp"
#include "schemes/stepper.hpp"

namespace corpuscle::schemes {

class ExplicitStepper : public Stepper {
  public:
    void start() override;
    // The three rates, and one number of the scheme itself.
    std::vector<double> state() const override;
    std::size_t stateSize() const override { return 4; }
    void resume(const std::vector<double>& state) override;
    bool limitsChange(long step) override;
    sph::StepLimits limits(double t) override;

  protected:
    static constexpr int powerIterations = 25;
    static constexpr double powerReserve = 1.03;  // power iterations approach the eigenvalue from below

    ExplicitStepper(coupling::Scene& scene, const NumericsSettings& numerics, long stepsPerEstimate);

    virtual void startScheme() = 0;
    virtual void resumeScheme(long count) = 0;
    virtual long count() const = 0;  // the number of the scheme itself in state()
    virtual ExplicitRates estimate() = 0;
    virtual void setRates(const ExplicitRates&) {}
    virtual void addLimits(const ExplicitMedium& medium, double t, sph::StepLimits& limits) const;
    sph::Budget* budget() { return scene_.budget.kept ? &scene_.budget : nullptr; }

    coupling::Scene& scene_;
    double safety_;
    ExplicitRates rates_;

  private:
    void setNewRates(const ExplicitRates& rates);
    long stepsPerEstimate_;
    long rebuilds_ = -1;  // number of rebuilds when the limits were computed
};

}  // namespace corpuscle::schemes
