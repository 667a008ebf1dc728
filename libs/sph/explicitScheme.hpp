// A scheme that steps particles by their accelerations: velocityVerlet.hpp, rkl2.hpp.
#pragma once

namespace corpuscle::sph {

class ExplicitScheme {
  public:
    virtual ~ExplicitScheme() = default;
    // Computes the forces at the initial state; not called after a restart, since forces are part of the saved state.
    virtual void start() = 0;
    // After a restart: restores everything that follows from the neighbour lists, without changing the state.
    virtual void resume() = 0;
    virtual void advance(double dt) = 0;
};

}  // namespace corpuscle::sph
