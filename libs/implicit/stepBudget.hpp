// Contribution of an implicit step to the budget of energy and momentum (sph/budget.hpp): from the computed velocity v,
// the residual of the equations that the solver leaves, and the forces that keep prescribed velocities.
//
// The energy balance of the system is v.(A v - b) = - v.left, with left the residual. Where there are no bodies, the
// forces of all terms follow from the system without another application of its operators. v.L v is then exactly the
// part of their power that the power of pressure and membranes does not explain.
//
// Where images slide past each other with the velocity s, forces across the faces between them do work as walls do. Let
// w be a flow that is 0 up to the middle of the box and s above it, and whose images slide like those of v: it has no
// step across the faces. All forces, those across the faces included, have the power P(w) in this flow, which takes
// another application of the operators. With f the forces on the particles,
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

    // After each solve: adds the residual that it leaves, which the right-hand side of the next solve does not contain.
    void addLeft(const Field& residual, bool first);
    // Adds the rates of the step to the budget. residual: with the forces on walls; divergence: of v, at each own
    // particle. With bodies, the forces of the system must be those at v.
    void keep(const Field& v, const Field& residual, const std::vector<double>& divergence);

  private:
    void findStep();

    System<Real>& system_;
    Field left_, step_;  // left_: sum of the residuals; step_: w, where images slide
};

extern template class StepBudget<double>;
extern template class StepBudget<float>;

}  // namespace corpuscle::implicit
