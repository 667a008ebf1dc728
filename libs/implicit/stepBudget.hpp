// What an implicit step does for the budget of energy and momentum (sph/budget.hpp), from the velocity v found, what
// its solutions leave of the equations, and the forces that prescribe velocities.
//
// The energy balance of the system, v.(A v - b) = - v.left: all forces of the terms follow from it without another
// application, where there are no bodies. So v.L v is what their power and that of pressure and membranes do not
// explain, exactly.
//
// Where images slide past each other with the velocity s, forces across the faces between them do work as walls do.
// Let w be a flow whose images slide as those of v, 0 up to the middle of the box and s above it: across the faces it
// has no step. All forces f, those across the faces included, have the power P(w) in it, found by another application,
// and
//
//     sum w.f - P(w)
// is the power of the images (docs/theory/conservation.md).
#pragma once
#include "implicit/system.hpp"

namespace corpuscle::implicit {

template <class Real>
class StepBudget {
  public:
    using Field = typename System<Real>::Field;

    explicit StepBudget(System<Real>& system) : system_(system) {}

    // After each solution: what it leaves, which the next right-hand side does not take up.
    void addLeft(const Field& residual, bool first);
    // residual: with the forces on walls; divergence: of v, of each own particle. With bodies the system's forces are
    // those at v.
    void keep(const Field& v, const Field& residual, const std::vector<double>& divergence);

  private:
    void findStep();

    System<Real>& system_;
    Field left_, step_;  // step_: w, where images slide
};

extern template class StepBudget<double>;
extern template class StepBudget<float>;

}  // namespace corpuscle::implicit
