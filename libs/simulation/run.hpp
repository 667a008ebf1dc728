// A run from its case to its end: what dmpFlow, sphFlow, benchmarks and tests that step a case have in common.
#pragma once
#include <functional>

#include "simulation/schedule.hpp"

namespace corpuscle::simulation {

struct RunHooks {
    // Once the case has been read; throws what is wrong with it for this program.
    std::function<void(const Case& input)> check = [](const Case&) {};
    // Before each step, once or again where a step has been taken back. Collective.
    std::function<void(coupling::Scene& scene, Time& time, const Integrator& integrator)> beforeStep =
        [](coupling::Scene&, Time&, const Integrator&) {};
};

ExitCode run(Application& app, const RunHooks& hooks = {});

}  // namespace corpuscle::simulation
