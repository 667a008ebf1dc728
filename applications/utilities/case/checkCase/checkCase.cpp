// checkCase: everything about a case that can be known before it runs.
//
// Reads all dictionaries (every problem at once, exit code 2), then prints the dimensionless groups, what each integrator
// would cost, the particles, memory and disk it will take, and, if 0/ has been filled, every limit of the time step and the run time
// predicted from a short burst. Nothing is written.
//
// Sample runs:
//     checkCase -case tutorials/rbcShear/Ca0.02
//     mpirun -np 2 checkCase -case tutorials/rbcShear/Ca0.02
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <iostream>
#include <vector>

#include "membrane/moduli.hpp"
#include "simulation/cost.hpp"
#include "simulation/groups.hpp"
#include "simulation/retreat.hpp"
#include "simulation/safeRange.hpp"
#include "simulation/sceneBuilder.hpp"

using namespace corpuscle;
using nlohmann::ordered_json;

namespace {

constexpr int burstSteps = 20;

std::string mebibytes(double bytes) {
    return bytes < 1e9 ? fmt::format("{:.1f} MiB", bytes / (1 << 20)) : fmt::format("{:.2f} GiB", bytes / (1 << 30));
}

void reportGroups(Application& app, const simulation::Case& input, ordered_json& json) {
    std::vector<std::vector<std::string>> rows;
    for (const simulation::Group& g : simulation::dimensionlessGroups(input)) {
        rows.push_back({g.name, g.value, g.text});
        json["groups"][g.name] = g.number;
    }
    app.log().table({"group", "value", "meaning"}, rows);
    for (const std::string& words : simulation::outsideSafeRanges(input)) {
        app.log().warning("{}", words);
        json["outsideSafeRange"].push_back(words);
    }
}

void reportCosts(Application& app, const simulation::Case& input, ordered_json& json) {
    const std::vector<simulation::IntegratorCost> costs = simulation::predictCosts(input);
    app.log().table(simulation::costHeader(input), simulation::costRows(input, costs));
    app.log().table(simulation::limitHeader(costs), simulation::limitRows(costs));
    for (const simulation::IntegratorCost& cost : costs) {
        ordered_json& entry = json["integrators"][cost.name];
        entry = {{"step_s", cost.step().seconds}, {"limit", cost.step().name}, {"steps", cost.steps},
                 {"passes", cost.passes},         {"cost", cost.cost},         {"obstacle", cost.obstacle}};
        for (const sph::StepLimit& limit : cost.limits.all) entry["limits_s"][limit.name] = limit.seconds;
    }
    json["integrator"] = input.numerics.integrator;
}

void reportSize(Application& app, const simulation::Case& input, ordered_json& json) {
    const auto n = simulation::estimateParticles(input);
    const auto size = simulation::estimateSize(input);
    app.log().table(
        {"size", "value"},
        {{"fluid particles", std::to_string(n.fluid)},
         {"wall particles", std::to_string(n.walls)},
         {"membrane nodes", std::to_string(n.nodes)},
         {"body particles", std::to_string(n.bodies)},
         {"memory, all ranks", mebibytes(size.memory)},
         {"disk: results",
          fmt::format("{} ({} times of {})", mebibytes(size.perWrite * static_cast<double>(size.writes)), size.writes,
                      mebibytes(size.perWrite))},
         {"disk: checkpoints",
          fmt::format("{} ({} kept)", mebibytes(size.checkpoint * static_cast<double>(input.control.checkpoint.keep)),
                      input.control.checkpoint.keep)}});
    json["particles"] = {{"fluid", n.fluid}, {"walls", n.walls}, {"nodes", n.nodes}, {"bodies", n.bodies}};
    json["memory_B"] = size.memory;
    json["disk_B"] = size.perWrite * static_cast<double>(size.writes) +
                     size.checkpoint * static_cast<double>(input.control.checkpoint.keep);
}

void reportLaws(Application& app, const simulation::Case& input) {
    for (const simulation::CellSettings& cell : input.mesh.cells)
        app.log().info("cell {}\n{}", cell.name, membrane::describeConstants(input.membraneOf(cell), cell.edge));
}

// Moduli as the case states them and as the network has them.
void reportMembranes(Application& app, const coupling::Scene& scene) {
    for (const coupling::Cell& cell : scene.cells)
        app.log().info("cell {}: {} nodes\n{}", cell.membrane.name, cell.nodeCount(),
                       membrane::describe(membrane::measureModuli(cell.membrane.network(), cell.membrane.laws())));
}

void reportBodies(Application& app, const simulation::Case& input, const coupling::Scene& scene, ordered_json& json) {
    if (!scene.bodies) return;
    for (const bodies::Body& body : scene.bodies->all()) {
        app.log().info("body {}: {}, {} particles, volume {:.6g} m^3, mass {:.6g} kg", body.name,
                       input.bodies.types.at(body.type).motion.name, body.particles.size(), body.solid.volume,
                       body.solid.mass);
        json["bodies"][body.name] = {{"volume_m3", body.solid.volume}, {"mass_kg", body.solid.mass}};
    }
}

// Steps and seconds of the whole run after a burst of steps as long as at the start; those of rkl2 grow, with their stages.
std::pair<double, double> predictRun(const simulation::Case& input, double dt, int stages, double perStep) {
    if (stages == 0) {
        const double steps = simulation::duration(input) / dt;
        return {steps, steps * perStep};
    }
    for (const simulation::IntegratorCost& cost : simulation::predictCosts(input))
        if (cost.name == "rkl2") return {cost.steps, cost.passes * perStep / (stages + 1)};
    return {};
}

void reportRun(Application& app, const simulation::Case& input, ordered_json& json) {
    coupling::Scene scene = simulation::buildScene(input, app.communicator().handle());
    Time time = simulation::startTime(app, input);
    simulation::Integrator integrator(input, scene);
    integrator.start(time);
    reportMembranes(app, scene);
    reportBodies(app, input, scene, json);
    for (const sph::StepLimit& limit : integrator.limits().all) json["limits_s"][limit.name] = limit.seconds;
    app.log().table({"limit of the step", "dt", ""}, simulation::limitRows(integrator.limits()));
    json["binding"] = integrator.limits().binding().name;

    const double dt = time.dt;
    const auto begin = std::chrono::steady_clock::now();
    simulation::Retreat step(input, scene, time, integrator,
                             app.log());  // as the solver steps, and back where it would go back
    int made = 0;
    for (int tries = 0; made < burstSteps && tries < 2 * burstSteps && time.running(); ++tries) made += step.advance();
    const double perStep =
        app.communicator().max(std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count()) /
        std::max(1, made);
    const auto [steps, seconds] = predictRun(input, dt, integrator.limits().stages, perStep);
    const double particles = app.communicator().sum(static_cast<double>(scene.system->owned()));
    app.log().info("predicted: {:.4g} steps of {:.3g} s = {} on {} rank{} ({:.3g} million particle-steps per second)",
                   steps, seconds / steps, formatDuration(seconds), app.communicator().size(),
                   app.communicator().size() > 1 ? "s" : "", 1e-6 * particles / perStep);
    json["steps"] = steps;
    json["secondsPerStep"] = seconds / steps;
    json["predicted_s"] = seconds;
}

}  // namespace

int main(int argc, char* argv[]) {
    Application app("checkCase", "Checks a case and says what it will take, before anything runs.", argc, argv,
                    {.samples = {"checkCase -case tutorials/rbcShear/Ca0.02", "mpirun -np 2 checkCase"}});
    return app.run([&] {
        ordered_json json;
        const simulation::Case input = simulation::Case::read(app);
        reportGroups(app, input, json);
        reportLaws(app, input);
        reportCosts(app, input, json);
        reportSize(app, input, json);
        if (std::filesystem::exists(input.directory / "0" / "fluid.vtp"))
            reportRun(app, input, json);
        else
            app.log().info("limits of the step and run time need 0/: run {}particleFill, then checkCase again",
                           input.mesh.cells.empty() && input.mesh.bodies.empty() ? "" : "membraneMesh and ");
        app.log().info("Case OK.");
        if (app.json() && app.communicator().isRoot()) std::cout << json.dump(2) << '\n';
        return ExitCode::done;
    });
}
