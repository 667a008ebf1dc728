// What a scheme knows of a case: all that its step, its cost and the reasons why it cannot be used depend on.
#pragma once
#include "core/dictionary.hpp"
#include "sph/flow.hpp"

namespace corpuscle::schemes {

struct CaseFacts {
    bool hasCells = false, hasBodies = false;
    bool hasContact = false;  // of membranes (constant/contact.yaml)
    bool slides = false;      // images of the box slide (core/periodicity.hpp)
    // State of the flow; at rest until constant/flow.yaml has been resolved.
    sph::FlowState flow;
    double leastViscosity = 0, largestViscosity = 0;  // of the fluid outside cells [Pa s]
    double mostViscous = 0;                           // the largest viscosity, inside cells too [Pa s]
    double springRate2 = 0;  // of the stiffest membrane: M^-1 K of its nodes as particles [1/s^2]
    // Speed of sound [m/s]: for schemes in which the stiffness of membranes and the viscosity around bodies count, and
    // (adjointSoundSpeed) for those that conserve volumes exactly.
    double soundSpeed = 0, adjointSoundSpeed = 0;
    double duration = 0;            // of the whole run [s]; 0 until the flow is known
    const Node* written = nullptr;  // system/numerics.yaml as it was read; null: it was not

    // Whether system/numerics.yaml has this key, such as "implicit.step".
    bool isWritten(const std::string& path) const { return find(path) != nullptr; }
    const Node* find(const std::string& path) const;
};

}  // namespace corpuscle::schemes
