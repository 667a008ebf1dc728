// dv/dt at the midpoint of an implicit step or at its end, and how far along it forces are evaluated
// (implicitStep.hpp).
//
//     dv/dt = c1 (v - u) - c2 a
// h: time from u to v,   a: acceleration between the midpoints of the last two steps
// name           | v is that at    | c1, c2                                            | exact for
// midpoint       | the midpoint    | (1 + 2w)/(h (1 + w)), w/(1 + w),   w = h/h_before | v of second degree in time
// backward Euler | the end         | 1/h, 0                                            | v of first degree in time
// In the first step, where h_before is 0, c2 is 0.
#pragma once
#include "implicit/term.hpp"

namespace corpuscle::implicit {

// What a restart needs in addition to the scene.
struct StepState {
    double behind = 0;       // time by which the velocity lags behind the positions [s]
    double lastSpacing = 0;  // h of the last step [s]; 0: no step before
    double reference = 0;    // energy of the disturbance of the flow (disturbance.hpp) [W]
    long steps = 0;
    long sinceBreak = 0;    // steps since the start, or since bonds broke last
    double breakTime = 0;   // time since then [s]
    double breakLimit = 0;  // limit of the next step after a break (stepControl.hpp) [s]; 0: none
};

struct TimeDifference {
    static constexpr double leadShare = 0.02;  // e/dt

    double dt = 0, share = 0.5;  // of dt, at which forces are evaluated
    Reach reach{};
    double h = 0, c1 = 0, c2 = 0;

    static TimeDifference backwardEuler(double dt, const StepState& last) {
        return TimeDifference(dt, 1, {dt, 0}, dt + last.behind, 0);
    }
    // leads: Reach::lead is used, because the velocity extrapolated from the last two steps includes the effect of the
    // forces.
    static TimeDifference midpoint(double dt, const StepState& last, bool leads) {
        const double middle = 0.5 * dt, h = middle + last.behind;
        return TimeDifference(dt, 0.5, {middle, leads ? leadShare * dt : 0}, h,
                              last.lastSpacing == 0 ? 0 : h / last.lastSpacing);
    }
    TimeDifference() = default;

    bool isAtEnd() const { return share == 1; }
    double begin() const { return share * dt; }  // from the beginning of the step to where forces are evaluated [s]
    // Density after the step. divergence: of v at that time.
    double density(double before, double divergence) const {
        return before *
               (isAtEnd() ? 1 / (1 + dt * divergence) : (1 - 0.5 * dt * divergence) / (1 + 0.5 * dt * divergence));
    }

  private:
    TimeDifference(double length, double at, Reach along, double spacing, double w)
        : dt(length), share(at), reach(along), h(spacing), c1((1 + 2 * w) / (spacing * (1 + w))), c2(w / (1 + w)) {}
};

}  // namespace corpuscle::implicit
