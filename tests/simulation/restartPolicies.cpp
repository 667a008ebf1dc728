// Every setting of a case declares what a change of it means for a continued run.
#include <gtest/gtest.h>

#include <map>
#include <set>

#include "simulation/restart.hpp"

namespace corpuscle::simulation {
namespace {

std::map<std::string, AtRestart> allSettings() {
    std::map<std::string, AtRestart> all;
    for (const auto& [file, dictionary] : restartDictionaries())
        for (const DeclaredSetting& setting : declaredSettings(dictionary))
            all[file + ": " + setting.key] = setting.policy;
    return all;
}

TEST(RestartPolicies, NoSettingIsForgotten) {
    const auto all = allSettings();
    EXPECT_GT(all.size(), 150u);
    for (const auto& [key, policy] : all)
        EXPECT_NE(policy, AtRestart::undeclared)
            << key
            << " does not say what a change of it means at a restart: add it to an atRestart(...) of its schema, "
            << "or to one around it (AtRestart, core/settings.hpp)";
}

TEST(RestartPolicies, StandWhereTheyWereDecided) {
    const auto all = allSettings();
    for (const auto& [key, policy] : std::map<std::string, AtRestart>{
             {"system/numerics.yaml: kernel", AtRestart::fixed},
             {"system/numerics.yaml: kernel.lucy.support", AtRestart::fixed},
             {"system/numerics.yaml: spacing", AtRestart::fixed},
             {"system/numerics.yaml: safety", AtRestart::noted},
             {"system/numerics.yaml: implicit.step", AtRestart::noted},
             {"system/numerics.yaml: shifting.coefficient", AtRestart::noted},
             {"system/mesh.yaml: domain.size", AtRestart::fixed},
             {"system/mesh.yaml: cells[].shape", AtRestart::fixed},
             {"system/mesh.yaml: cells[].shape.sphere.radius", AtRestart::fixed},
             {"system/mesh.yaml: cells[].axis", AtRestart::fixed},
             {"system/mesh.yaml: bodies[].centre", AtRestart::fixed},
             {"system/mesh.yaml: fill.seed", AtRestart::fixed},
             {"constant/flow.yaml: shear.Ca", AtRestart::noted},
             {"constant/flow.yaml: poiseuille.bodyForce", AtRestart::noted},
             {"constant/flow.yaml: shear.walls.planes.normal", AtRestart::fixed},
             {"constant/membranes.yaml: <name>.bonds.harmonic.k", AtRestart::noted},
             {"constant/membranes.yaml: <name>.interior.viscosityRatio", AtRestart::fixed},
             {"constant/bodies.yaml: <name>.motion", AtRestart::noted},
             {"system/control.yaml: endStrain", AtRestart::free},
             {"system/control.yaml: write.strain", AtRestart::free},
             {"system/observers.yaml: <name>", AtRestart::free},
         }) {
        ASSERT_TRUE(all.contains(key)) << key;
        EXPECT_EQ(all.at(key), policy) << key << " is " << nameOf(all.at(key));
    }
}

// At a restart, these settings are compared by values that restart.cpp derives from them; any other setting with this
// policy would not be compared at all.
TEST(RestartPolicies, WhatIsResolvedIsDerived) {
    std::set<std::string> resolved;
    for (const auto& [key, policy] : allSettings())
        if (policy == AtRestart::resolved) resolved.insert(key);
    EXPECT_EQ(resolved,
              (std::set<std::string>{"constant/fluid.yaml: density", "constant/fluid.yaml: viscosity",
                                     "constant/flow.yaml: leesEdwards.inertia.Re",
                                     "constant/flow.yaml: shear.inertia.Re", "system/numerics.yaml: integrator"}));
}

}  // namespace
}  // namespace corpuscle::simulation
