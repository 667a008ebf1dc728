// Family of schemes: how a scene is advanced in time. A scheme is chosen by `integrator` of system/numerics.yaml, by
// its registered name; its settings stand there in a table of that name.
//
// name, and file | scheme
// velocityVerlet | explicit (paper, Eqs 12 to 17); on adjoint operators where the case has them (adjointVerlet)
// rkl2           | explicit, its viscosity by super-time-stepping; a fluid alone
// implicit       | one symmetric system for fluid and membranes in each step
//
// A scheme says what it can do, what it costs and what it stands for where a key is absent; `stepper` makes what steps
// a scene (stepper.hpp). Nothing outside this library asks for a scheme by its name.
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

// What the rest of a program has to know of a scheme.
struct Traits {
    // Pair operators are adjoint to each other (sph/operators.hpp): volumes are kept exactly, nodes lie between
    // particles, which are shifted and held to their side of each membrane within every step.
    bool isAdjoint = false;
    bool listsEveryStep = false;  // neighbour lists are built at every step, without a skin
    bool solvesForBodies =
        false;  // velocities of rigid bodies are unknowns of the step: near bodies need no limit of their own
    bool hasContact = false;         // membranes can have contact (coupling/cellContacts.hpp)
    bool knowsSlides = false;        // images of the box can slide (core/periodicity.hpp)
    bool hasDampedSteps = false;     // can go on by backward Euler (Stepper::damp)
    long stepsPerBalance = 10;       // between two balances of density, unless the case says
    long stepsPerKeptState = 50;     // between two states in memory that a run can go back to
    long stepsPerLook = 10;          // between two looks at the state for faults
    double nodeMemory = 1000;        // of a node of a cell, on each rank that holds the cell [bytes], to predict memory
    std::string stepKey = "safety";  // of system/numerics.yaml: takes shorter steps
    std::string state = "explicit";  // what a checkpoint keeps; schemes with the same can follow each other
};

class Scheme {
  public:
    static constexpr const char* familyName = "scheme";
    virtual ~Scheme() = default;

    virtual Traits traits() const = 0;

    // What absent or automatic keys stand for.
    virtual std::string usualCoupling(const CaseFacts& facts) const;
    virtual std::string usualOperators(const CaseFacts& facts, const NumericsSettings& numerics) const;
    // With its own settings as the case means them; null: as they are written.
    virtual std::shared_ptr<const Scheme> settled(const CaseFacts&) const { return nullptr; }
    // That steps these numerics; null: itself.
    virtual std::shared_ptr<const Scheme> variant(const CaseFacts&, const NumericsSettings&) const { return nullptr; }

    // Adds a problem for each thing in the case that it cannot do.
    virtual void check(const CaseFacts& facts, const NumericsSettings& numerics, Problems& problems) const = 0;
    // Why `integrator: automatic` does not take it, though it can; empty: it may.
    virtual std::string unfit(const CaseFacts& facts, const NumericsSettings& numerics) const;
    // Keys of system/numerics.yaml, "shifting.steps", that mean nothing to it, with the reason: "with ..., where ...".
    struct UnusedKey {
        std::string path, why;
    };
    virtual std::vector<UnusedKey> unused(const NumericsSettings& numerics) const = 0;

    // Predicted limits of its step at the time t [s].
    virtual sph::StepLimits limits(const CaseFacts& facts, const NumericsSettings& numerics, double t) const = 0;
    // Predicted passes over the pairs of particles in a step of dt [s] (cost.hpp).
    virtual double passes(const CaseFacts& facts, const NumericsSettings& numerics, double dt) const = 0;
    // The step that it asks for in a case whose first is `first` [s].
    virtual double fullStep(const CaseFacts&, double first) const { return first; }

    // The scene must stay where it is. Collective.
    virtual std::unique_ptr<Stepper> stepper(const CaseFacts& facts, const NumericsSettings& numerics,
                                             coupling::Scene& scene) const = 0;
};

}  // namespace corpuscle::schemes
