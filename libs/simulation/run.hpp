// A whole run, from reading the case to the exit code, for dmpFlow, sphFlow, and benchmarks and tests that step a case.
#pragma once
#include <functional>

#include "simulation/schedule.hpp"

namespace corpuscle::simulation {

struct RunHooks {
    // Called once the case has been read; throws if the case does not suit this program.
    std::function<void(const Case& input)> check = [](const Case&) {};
    // Called before each step, and again if a step was rolled back. Collective.
    std::function<void(coupling::Scene& scene, Time& time, const Integrator& integrator)> beforeStep =
        [](coupling::Scene&, Time&, const Integrator&) {};
};

ExitCode run(Application& app, const RunHooks& hooks = {});

}  // namespace corpuscle::simulation
