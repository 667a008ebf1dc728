// One contribution to a membrane's energy, chosen once at set-up; the virtual call is made once per membrane and step.
//
// A term sees node positions (unwrapped, contiguous) and a Network; it knows nothing of ranks, images or the fluid. It
// may keep a reference to the Network, whose lists shrink at rupture and grow again at a rollback, but has no other
// state.
#pragma once
#include <span>

#include "core/vec.hpp"
#include "membrane/stiffness.hpp"

namespace corpuscle::membrane {

class Term {
  public:
    virtual ~Term() = default;
    virtual void addForces(std::span<const Vec3> x, std::span<Vec3> f) const = 0;  // N
    virtual double energy(std::span<const Vec3> x) const = 0;                      // J
    // Adds to each triangle the part of its energy by this term, without a share (network.hpp), that tears it [J]; it
    // may be infinite.
    virtual void addTensileEnergy(std::span<const Vec3> /*x*/, std::span<double> /*ofTriangle*/) const {}
    // The second derivative of the energy, element by element.
    virtual void addStiffness(std::span<const Vec3> x, Definiteness definiteness, Stiffness& stiffness) const = 0;
    // Upper bound of the largest eigenvalue of the stiffness matrix without its geometric part [N/m], for limits of the
    // time step.
    virtual double maxStiffness(std::span<const Vec3> x) const = 0;
};

}  // namespace corpuscle::membrane
