// Family of schemes: how a scene is advanced in time. A scheme is chosen by `integrator` of system/numerics.yaml, by
// its registered name; its settings are there in a table of that name.
//
// name, and file | scheme
// velocityVerlet | explicit (paper, Eqs 12 to 17); on adjoint operators where the case has them (adjointVerlet)
// rkl2           | explicit, with viscosity by super-time-stepping; for a fluid alone
// implicit       | one symmetric system for fluid and membranes in each step
//
// A scheme states what it can do, what it costs, and its defaults for absent keys; `stepper` makes the object that
// advances a scene (stepper.hpp). Nothing outside this library refers to a scheme by its name.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "core/registry.hpp"
#include "coupling/scene.hpp"
#include "schemes/caseFacts.hpp"
#include "sph/stepLimits.hpp"

namespace corpuscle::schemes {

class Stepper;
struct NumericsSettings;

// What the rest of a program needs to know of a scheme.
struct Traits {
    // Pair operators are adjoint to each other (sph/operators.hpp): volumes are conserved exactly, nodes lie between
    // particles, and particles are shifted and kept on their side of each membrane within every step.
    bool isAdjoint = false;
    bool listsEveryStep = false;  // neighbour lists are built at every step, without a skin
    bool solvesForBodies =
        false;  // velocities of rigid bodies are unknowns of the step: the step needs no limit of its own near bodies
    bool hasContact = false;      // membranes can have contact (coupling/cellContacts.hpp)
    bool knowsSlides = false;     // images of the box can slide (core/periodicity.hpp)
    bool hasDampedSteps = false;  // can continue by backward Euler (Stepper::damp)
    long stepsPerBalance = 10;    // steps between two balances of density, unless the case sets it
    long stepsPerKeptState = 50;  // steps between two states kept in memory for rollbacks
    long stepsPerLook = 10;       // steps between two state checks
    double nodeMemory = 1000;  // for each node of a cell, on each rank that holds the cell [bytes], to predict memory
    std::string stepKey = "safety";  // key of system/numerics.yaml that makes steps shorter
    // Kind of state in a checkpoint; a scheme can continue a run of another with the same kind.
    std::string state = "explicit";
};

class Scheme {
  public:
    static constexpr const char* familyName = "scheme";
    virtual ~Scheme() = default;

    virtual Traits traits() const = 0;

    // What absent or automatic keys stand for.
    virtual std::string usualCoupling(const CaseFacts& facts) const;
    virtual std::string usualOperators(const CaseFacts& facts, const NumericsSettings& numerics) const;
    // This scheme with its own settings resolved for the case; null: as they are written.
    virtual std::shared_ptr<const Scheme> settled(const CaseFacts&) const { return nullptr; }
    // The scheme that advances a case with these numerics; null: this one.
    virtual std::shared_ptr<const Scheme> variant(const CaseFacts&, const NumericsSettings&) const { return nullptr; }

    // Adds a problem for each thing in the case that the scheme cannot do.
    virtual void check(const CaseFacts& facts, const NumericsSettings& numerics, Problems& problems) const = 0;
    // Why `integrator: automatic` does not take this scheme, though it can be used; empty: it may be taken.
    virtual std::string unfit(const CaseFacts& facts, const NumericsSettings& numerics) const;
    // Keys of system/numerics.yaml, such as "shifting.steps", that have no effect with this scheme; why: the reason, as
    // "with ..., where ...".
    struct UnusedKey {
        std::string path, why;
    };
    virtual std::vector<UnusedKey> unused(const NumericsSettings& numerics) const = 0;

    // Predicted limits of the step at the time t [s].
    virtual sph::StepLimits limits(const CaseFacts& facts, const NumericsSettings& numerics, double t) const = 0;
    // Predicted passes over the pairs of particles in a step of dt [s] (cost.hpp).
    virtual double passes(const CaseFacts& facts, const NumericsSettings& numerics, double dt) const = 0;
    // The full step of the scheme, in a case whose first step is `first` [s].
    virtual double fullStep(const CaseFacts&, double first) const { return first; }

    // The scene is kept by reference. Collective.
    virtual std::unique_ptr<Stepper> stepper(const CaseFacts& facts, const NumericsSettings& numerics,
                                             coupling::Scene& scene) const = 0;
};

}  // namespace corpuscle::schemes
