// limitFlow: dmpFlow and sphFlow with steps that are a multiple of one limit of the explicit step, for the map of
// docs/stability.md. The solvers themselves take no more than `safety`, at most 1, of the least.
//
// Sample runs:
//     limitFlow -case myCase -limit viscous -times 1.1
//     limitFlow -case myCase -limit least -times 0.9
#include <algorithm>
#include <charconv>

#include "simulation/run.hpp"

using namespace corpuscle;

namespace {

double wantedStep(const sph::StepLimits& limits, const std::string& name, double times) {
    if (name == "least") return times * limits.binding().seconds;
    const auto limit =
        std::find_if(limits.all.begin(), limits.all.end(), [&](const auto& l) { return l.name == name; });
    if (limit == limits.all.end()) throw Failure(ExitCode::usage, "-limit " + name + ": this case has no such limit");
    return times * limit->seconds;
}

double numberOf(const std::string& text) {
    double number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc() || end != text.data() + text.size() || !(number > 0))
        throw Failure(ExitCode::usage, "-times " + text + ": a number above 0 is expected");
    return number;
}

Usage usage() {
    Usage all = simulation::solverUsage("limitFlow");
    all.options.push_back({"limit", "NAME", "viscous, membrane viscosity, spring, acoustic, body force, or least"});
    all.options.push_back({"times", "X", "steps are so many of that limit"});
    return all;
}

}  // namespace

int main(int argc, char* argv[]) {
    Application app("limitFlow", "A case stepped by a multiple of one limit of the explicit step.", argc, argv,
                    usage());
    return app.run([&] {
        const std::string name = app.value("limit").value_or("least");
        const double times = numberOf(app.value("times").value_or("1"));
        simulation::RunHooks hooks;
        hooks.beforeStep = [&](coupling::Scene&, Time& time, const simulation::Integrator& integrator) {
            time.dt = wantedStep(integrator.limits(), name, times);
        };
        return simulation::run(app, hooks);
    });
}
