// What an implicit step does for the budget of energy and momentum (sph/budget.hpp), from the velocity v found, what
// its solutions leave of the equations, and the forces that prescribe velocities.
//
// The energy balance of the system, v.(A v - b) = - v.left: all forces of the terms follow from it without another
// application, where there are no bodies. So v.L v is what their power and that of pressure and membranes do not
// explain, exactly.
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
    System<Real>& system_;
    Field left_;
};

extern template class StepBudget<double>;
extern template class StepBudget<float>;

}  // namespace corpuscle::implicit
