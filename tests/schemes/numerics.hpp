// system/numerics.yaml with a few keys, as read by a case.
#pragma once
#include <gtest/gtest.h>

#include "schemes/choice.hpp"

namespace corpuscle::schemes {

struct WrittenNumerics {
    Node node;
    NumericsSettings settings;
    CaseFacts facts;  // of a fluid alone at rest, viscosity 1 mPa s

    explicit WrittenNumerics(const std::string& keys) {
        Problems problems;
        node = parseDictionary("spacing: 1 um\n" + keys, "system/numerics.yaml", problems);
        settings = read<NumericsSettings>(node, problems);
        problems.throwIfAny();
        facts.written = &node;
        facts.leastViscosity = facts.largestViscosity = facts.mostViscous = 1e-3;
    }
    WrittenNumerics(const WrittenNumerics&) = delete;
    WrittenNumerics& operator=(const WrittenNumerics&) = delete;

    // A sheared fluid, rho 1000 kg/m^3.
    void flow(double rate, double duration) {
        facts.flow.density = 1000, facts.flow.shearRate = facts.flow.rate = rate;
        facts.flow.speed = 1e-3, facts.flow.length = 1e-5;
        facts.soundSpeed = facts.adjointSoundSpeed = 0.1;
        facts.duration = duration;
    }
    NumericsSettings settled(const std::string& integrator) const {
        return schemes::settled(settings, facts, integrator);
    }
};

}  // namespace corpuscle::schemes
