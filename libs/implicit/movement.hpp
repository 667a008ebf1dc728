// Moves the contents of a scene in an implicit step: to the positions where forces are evaluated, back from there, and
// to the end of the step with the computed velocity.
//
//     x* = x^n + share dt u                                       depart; takeBack undoes it. At the midpoint of steps,
//                                                                 nodes of cells are on the arc (coupling/arc.hpp)
//     x^(n+1) = x^n + dt v + shift,   a = (v - u)/h               arrive (timeDifference.hpp)
// Images that slide (core/periodicity.hpp) are moved to the same times. Between steps the store has the velocity at the
// end of the last step, u + (t - t_middle) a; the step first converts it back to that at the midpoint.
#pragma once
#include <optional>

#include "coupling/adjoint.hpp"
#include "coupling/noFlux.hpp"
#include "coupling/transport.hpp"
#include "implicit/system.hpp"

namespace corpuscle::implicit {

template <class Real>
class Movement {
  public:
    using Field = typename System<Real>::Field;

    // shifting: coefficient of the case. noFlux: null without cells. System and noFlux are kept by reference.
    Movement(System<Real>& system, std::optional<double> shifting, coupling::NoFlux* noFlux)
        : system_(system), noFlux_(noFlux), transport_(system.scene(), shifting) {}

    // Advances velocities by their accelerations, between the midpoint of a step and its end.
    void moveVelocities(double seconds);
    void stopAccelerating();  // sets accelerations to zero
    // Moves to the positions where forces are evaluated, and builds the lists there. Collective.
    void depart(const TimeDifference& time);
    void takeBack(const TimeDifference& time);
    // With the computed velocity v: positions, velocities and accelerations at the end of the step. Collective.
    void arrive(const Field& v);

  private:
    void moveFluid(double seconds);
    template <class Wrap>
    void countCrossings(Wrap&& wrap);
    System<Real>& system_;
    coupling::NoFlux* noFlux_;
    coupling::Transport transport_;
};

extern template class Movement<double>;
extern template class Movement<float>;

}  // namespace corpuscle::implicit
