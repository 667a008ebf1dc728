// Keeps the flow rate Q through a periodic vessel along x at a given one, Q0 f(t): the body force F follows.
//
// A flow that a force per mass F drives through a cross-section A obeys, as a whole,
//     A dQ'/dt = A F - A Q'/tau,   Q' = Q/A,  tau = k/(nu A),   k the conductance (boundary/wallShape)
// After each step of dt, which ended at t, Q is measured. With F unchanged, the next step would bring Q to Q* =
// Q + (Q - Q_before) exp(-dt/tau); it is to bring it to
//     Q** = Q + (1 - exp(-10 dt/tau)) (Q0 f(t) - Q) + Q0 (f(t + dt) - f(t))
// so that the force changes by dF = nu (Q** - Q*)/(k (1 - exp(-dt/tau))). Short steps thus approach Q0 within 0.1 tau,
// and long ones at once. k starts as that of the walls without cells. Where a step is longer than tau, k follows
// nu Q/F, since cells resist as well.
#pragma once
#include <vector>

#include "sph/flow.hpp"

namespace corpuscle::coupling {

struct Scene;

class FlowControl {
  public:
    // flow: with a flow rate, and a body force that gives this flow rate without cells.
    explicit FlowControl(const sph::FlowState& flow);

    Vec3 force() const { return {force_, 0, 0}; }  // per mass, in the next step [m/s^2]
    // After a step of dt, which has ended at t [s]. Collective.
    void follow(const Scene& scene, double t, double dt);

    // For checkpoints.
    std::vector<double> state() const { return {force_, before_, mobility_}; }
    void restore(const std::vector<double>& state);

  private:
    double force_ = 0;     // [m/s^2]
    double before_ = 0;    // flow rate after the last step [m^3/s]
    double mobility_ = 0;  // k/nu: flow rate in unit force, steady [m^2 s]
};

// The flow rate along x: the mean over all cross-sections [m^3/s]. Collective.
double flowRate(const Scene& scene);

}  // namespace corpuscle::coupling
