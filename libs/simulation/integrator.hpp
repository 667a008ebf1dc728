// Advances a scene by time steps as large as every limit allows (sph/stepLimits.hpp).
//
// The explicit scheme's viscous and spring limits come from power iterations, at the start and every 1,000 steps; the acoustic limit is taken anew
// when lists are rebuilt. The implicit step is as large as the case says. A step that an event shortens
// (core/time.hpp) says nothing about the length of the next one.
#pragma once
#include <limits>
#include <memory>

#include "core/time.hpp"
#include "coupling/conjugateVerlet.hpp"
#include "coupling/scene.hpp"
#include "implicit/implicitStep.hpp"
#include "simulation/case.hpp"
#include "sph/rkl2.hpp"
#include "sph/stepLimits.hpp"
#include "sph/velocityVerlet.hpp"

namespace corpuscle::simulation {

// Name, length, and which one binds; for the log.
std::vector<std::vector<std::string>> limitRows(const sph::StepLimits& limits);

class Integrator {
  public:
    // The scene must stay where it is: its coupling and loads refer to it.
    Integrator(const Case& input, coupling::Scene& scene);

    void start(Time& time);  // forces at the initial state, first step
    struct State {
        double viscousRate = 0, membraneRate = 0, springRate2 = 0, dt = 0;
        implicit::ImplicitStep::State implicit;
        long conjugateSteps = 0;
    };
    State state(const Time& time) const;
    void resume(const State& state, Time& time);  // after a restart
    // The same where the scene has been put back within a run.
    void goBack(const State& state, Time& time);
    // From the next step that is chosen on: none longer than this [s], and of the implicit step backward Euler where damped.
    void shorten(double longest, bool damped);

    // One step of time.dt, shorter where one of the events comes before its end; then time is on and time.dt is what the limits allow next.
    // Collective. Throws Failure(numerics), on all ranks, where a step cannot be made.
    void advance(coupling::Scene& scene, Time& time, const std::vector<Event>& events = {});
    double tried() const { return tried_; }  // length of the last step, made or not, had no event shortened it [s]
    bool wasShortened() const { return shortened_; }  // the last step, by an event

    const sph::StepLimits& limits() const { return limits_; }
    double largestDensityBalance() const;
    long mostFallbacks() const;  // nodes of immersed membranes with Shepard's weights at once
    const implicit::ImplicitStep* implicitStep() const { return implicit_.get(); }

  private:
    void make();
    void makeExplicit();
    void makeConjugate();
    void makeRkl2();
    void estimateRates();
    void updateLimits(Time& time);
    sph::Account* account() { return scene_.account.kept ? &scene_.account : nullptr; }
    const Case& input_;
    coupling::Scene& scene_;
    std::unique_ptr<sph::ExplicitScheme> scheme_;  // one of the three
    sph::Rkl2* rkl2_ = nullptr;                    // that scheme, where it is one
    std::unique_ptr<coupling::ConjugateVerlet> conjugate_;
    std::unique_ptr<implicit::ImplicitStep> implicit_;
    sph::StepLimits limits_;
    double viscousRate_ = 0, membraneRate_ = 0, springRate2_ = 0;
    double largestBalance_ = 0;                                 // before the last way back
    long mostFallbacks_ = 0;                                    // likewise
    double longest_ = std::numeric_limits<double>::infinity();  // step, whatever the limits allow [s]
    double tried_ = 0;
    bool shortened_ = false;
    long rebuilds_ = -1;
};

}  // namespace corpuscle::simulation
