// One effect on the fluid, as a term of the implicit system (implicitStep.hpp). At the positions x* at the midpoint of
// the step its force on the particles is linear in their velocity,
//
//     force(v) = load - A v,      A symmetric and positive semi-definite
// and the step needs no more of a term than this force, its linear part, and the diagonal of A for the preconditioner.
// Nonlinear terms are evaluated again with the computed velocity: the defect is the force at the positions to which
// this velocity leads, less the linear one.
//
// A scene has only the terms of what it contains. Fields of velocities and forces contain all particles that the rank
// knows, its own followed by those of other ranks (particles/sharedParticles.hpp). Terms add the forces on the rank's
// own particles; the term of the fluid comes last and adds up over the ranks, so that the forces on all particles are
// complete. Walls and bodies in given motion need no terms: their rows and columns are removed, and the forces on them
// are read from these rows.
//
// To add a term: derive from Term, with a test that A is symmetric and semi-definite, and put it into the list of
// System (system.hpp).
#pragma once
#include <stdexcept>
#include <string>
#include <vector>

#include "particles/particleStore.hpp"

namespace corpuscle::implicit {

// How far along the computed velocity v elastic forces are evaluated: from x* = x^n + middle u, they are evaluated at
// x* + middle (v - u) + lead (v - v0), with v0 extrapolated from the steps before. lead (v - v0) is of third order in
// the step and damps stiff modes (implicitStep.hpp).
struct Reach {
    double middle, lead = 0;  // [s]
    double total() const { return middle + lead; }
};

template <class Real>
class Term {
  public:
    using Field = particles::AlignedVector<Real>;  // four numbers per entry of the shared particles
    using Forces = particles::RealArray;           // the same [N]

    virtual ~Term() = default;

    // At x*, with up-to-date lists. Collective.
    virtual void prepare(const Reach& reach) = 0;
    // addForces for the extrapolated velocity v0, the first call after prepare. Stiff terms also take the part of the
    // lead that has v0 into their load. Collective.
    virtual void addFirstForces(const Field& v0, Forces& forces) { addForces(v0, forces); }
    // forces += load - A v, and forces -= A v. Collective.
    virtual void addForces(const Field& v, Forces& forces) = 0;
    virtual void addProduct(const Field& v, Forces& forces) = 0;
    // Diagonal of A for a particle, as a multiple of the unit matrix [N s/m]. 0 leaves the term to the preconditioner.
    virtual double diagonal(std::size_t) const { return 0; }

    // Why a step of dt with the computed velocity is too long; empty if it is not. The same on all ranks. Collective.
    virtual std::string whyNot(const Field&, double /*dt*/) { return {}; }
    // Nonlinear terms, after addFirstForces. addDefect: forces += defect; takeDefect: the defect, which is then solved
    // for, is added to the load. Collective.
    virtual bool isLinear() const { return true; }
    virtual void addDefect(Forces&) {}
    virtual void takeDefect() {}
    // w.(load - A v) [W], unless it is in the fluid's budget: energy that the flow v gives to the disturbance w. This
    // rank's share; collective.
    virtual double power(const Field& /*v*/, const Field& /*w*/) { return 0; }
    // w.(load - A v) [W] for the velocity v last computed, where images slide in both v and w; includes the forces
    // across the faces between images. divergence: of v. This rank's share; collective.
    virtual double slidingPower(const Field& /*v*/, const std::vector<double>& /*divergence*/, const Field& /*w*/) {
        throw std::logic_error("a term does not know images that slide");
    }
};

}  // namespace corpuscle::implicit
