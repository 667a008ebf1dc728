// A scheme that steps particles by their accelerations: velocityVerlet.hpp, rkl2.hpp.
#pragma once

namespace corpuscle::sph {

class ExplicitScheme {
  public:
    virtual ~ExplicitScheme() = default;
    virtual void start() = 0;   // forces at the initial state; not after a restart, forces are part of the state
    virtual void resume() = 0;  // after a restart: everything that follows from lists, nothing that changes the state
    virtual void advance(double dt) = 0;
};

}  // namespace corpuscle::sph
