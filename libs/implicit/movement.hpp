// How an implicit step moves what is in a scene: to where its forces are taken, back from there, and to its end with
// the velocity found.
//
//     x* = x^n + share dt u                                       departs, or takes it back; nodes of cells in the
//                                                                 middle of a step on the arc (coupling/arc.hpp)
//     x^(n+1) = x^n + dt v + shift,   a = (v - u)/h               arrives (timeDifference.hpp)
// Images that slide (core/periodicity.hpp) move along in time.
// The state between steps has the velocity at its end, u + (t - t_middle) a; the step takes it back to that of the
// middle first.
#pragma once
#include <optional>

#include "coupling/noFlux.hpp"
#include "coupling/transport.hpp"
#include "implicit/system.hpp"

namespace corpuscle::implicit {

template <class Real>
class Movement {
  public:
    using Field = typename System<Real>::Field;

    // shifting: coefficient of the case. noFlux: null without cells. All must stay where they are.
    Movement(System<Real>& system, std::optional<double> shifting, coupling::NoFlux* noFlux)
        : system_(system), noFlux_(noFlux), transport_(system.scene(), shifting) {}

    // Velocities along their accelerations, between the middle of a step and its end.
    void moveVelocities(double seconds);
    // To the places at which forces are taken, and lists there. Collective.
    void depart(const TimeDifference& time);
    void takeBack(const TimeDifference& time);
    // With the velocity v found: places, velocities and accelerations at the end of the step. Collective.
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
