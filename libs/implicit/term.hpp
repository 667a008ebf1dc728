// What acts on the fluid, as one term of the implicit system (implicitStep.hpp). At the places x* in the middle of the
// step its force on the particles is linear in their velocity,
//
//     force(v) = load - A v,      A symmetric and positive semi-definite
// and the step asks of it no more than these, and the diagonal of A for the preconditioner. What is not linear is
// looked at again with the velocity found: the defect is its force at the places that this velocity leads to, less the
// linear one.
//
// A scene has the terms of what is in it, and none of what is not. Velocities and forces are of all particles that the
// rank knows, those of other ranks behind its own (particles/sharedParticles.hpp). Terms add what acts on the rank's
// own; the fluid's comes last and adds up over the ranks, so that the forces on all of them are whole. Walls and bodies
// with given motions need none: their rows and columns are taken out, and what acts on them is read off there.
//
// To add one: derive from Term, with a test that A is symmetric and semi-definite, and put it into the list of System
// (system.hpp).
#pragma once
#include <stdexcept>
#include <string>
#include <vector>

#include "particles/particleStore.hpp"

namespace corpuscle::implicit {

// How far along the velocity v found the elastic part of a force is taken, from x* = x^n + middle u: at x* + middle (v
// - u) + lead (v - v0), with v0 extrapolated from the steps before. lead (v - v0) is of third order in the step, and
// damps what is stiff (implicitStep.hpp).
struct Reach {
    double middle, lead = 0;  // [s]
    double total() const { return middle + lead; }
};

template <class Real>
class Term {
  public:
    using Field = particles::AlignedVector<Real>;  // four numbers an entry of the shared particles
    using Forces = particles::RealArray;           // the same [N]

    virtual ~Term() = default;

    // At x*, where lists are up to date. Collective.
    virtual void prepare(const Reach& reach) = 0;
    // addForces of the extrapolated velocity, which the load takes up where it is stiff. The first after prepare.
    // Collective.
    virtual void addFirstForces(const Field& v0, Forces& forces) { addForces(v0, forces); }
    // forces += load - A v, and forces -= A v. Collective.
    virtual void addForces(const Field& v, Forces& forces) = 0;
    virtual void addProduct(const Field& v, Forces& forces) = 0;
    // Of A [N s/m], as a multiple of the unit matrix. 0 leaves it to the preconditioner to know better.
    virtual double diagonal(std::size_t) const { return 0; }

    // Of the velocity found: why a step of dt with it is too long; empty where it is not. The same on all ranks.
    // Collective.
    virtual std::string whyNot(const Field&, double /*dt*/) { return {}; }
    // Terms that are not linear, after addFirstForces: forces += defect; what is solved for then belongs to the load.
    // Collective.
    virtual bool isLinear() const { return true; }
    virtual void addDefect(Forces&) {}
    virtual void takeDefect() {}
    // w.(load - A v) [W] where it is not in the fluid's budget: energy that the flow v gives to the disturbance w. Of
    // this rank's share; collective.
    virtual double power(const Field& /*v*/, const Field& /*w*/) { return 0; }
    // w.(load - A v) [W] of the velocity v found last, where images slide as in v and in w: with what acts across the
    // faces between images. divergence: of v. Of this rank's share; collective.
    virtual double slidingPower(const Field& /*v*/, const std::vector<double>& /*divergence*/, const Field& /*w*/) {
        throw std::logic_error("a term does not know images that slide");
    }
};

}  // namespace corpuscle::implicit
