// checkCase: reports everything that can be known about a case before it runs.
//
// Reads all dictionaries (reporting every problem at once, exit code 2), then prints on one screen the case, the
// dimensionless groups, the resolution, the required memory and disk space, the cost of each integrator that can run
// the case, and, if 0/ has been filled, every limit of the time step and the run time predicted from a short burst of
// steps; at the end come warnings. -json has all of this, and more. Nothing is written.
//
// Sample runs:
//     checkCase -case tutorials/rbcShear/Ca0.02
//     mpirun -np 2 checkCase -case tutorials/rbcShear/Ca0.02
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <iostream>
#include <optional>
#include <vector>

#include "../../mesh/cellMeshes.hpp"
#include "core/buildInfo.hpp"
#include "core/machineMemory.hpp"
#include "io/polyData.hpp"
#include "membrane/moduli.hpp"
#include "schemes/cost.hpp"
#include "simulation/caseRules.hpp"
#include "simulation/checkpoint.hpp"
#include "simulation/groups.hpp"
#include "simulation/memoryLimit.hpp"
#include "simulation/restart.hpp"
#include "simulation/rollback.hpp"
#include "simulation/safeRange.hpp"
#include "simulation/sceneBuilder.hpp"
#include "simulation/schedule.hpp"
#include "simulation/size.hpp"

using namespace corpuscle;
using nlohmann::ordered_json;

namespace {

constexpr int burstSteps = 20;

// The lines printed, section by section, and the data for -json.
struct Report {
    Application& app;
    ordered_json json;
    std::vector<std::string> warnings;

    void section(const char* title) { app.log().info("{}", title); }
    // A line that is wider than the screen is broken at blanks; `hanging`: indentation of the continuation lines.
    void line(std::string text, std::size_t hanging = 4) {
        constexpr std::size_t width = 118;
        while (text.size() > width) {
            const std::size_t at = text.rfind(' ', width);
            if (at == std::string::npos || at <= hanging) break;
            app.log().info("  {}", text.substr(0, at));
            text = std::string(hanging, ' ') + text.substr(at + 1);
        }
        app.log().info("  {}", text);
    }
    // Aligned columns; without a header line if `header` is empty.
    void table(const std::vector<std::string>& header, const std::vector<std::vector<std::string>>& rows) {
        const std::vector<std::string> none(rows.empty() ? 0 : rows.front().size());
        const std::vector<std::string> lines = alignedTable(header.empty() ? none : header, rows);
        std::size_t last = 2 * (none.size() - 1);  // column in which the last column of the table begins
        for (std::size_t c = 0; c + 1 < none.size(); ++c) {
            std::size_t widest = header.empty() ? 0 : header[c].size();
            for (const auto& row : rows) widest = std::max(widest, row[c].size());
            last += widest;
        }
        for (std::size_t k = header.empty() ? 1 : 0; k < lines.size(); ++k) line(lines[k], last);
    }
};

std::string counted(std::size_t n, const std::string& word) {
    return fmt::format("{} {}{}", n, word, n > 1 ? "s" : "");
}

std::string vectorText(const Vec3& v) {
    return fmt::format("{} x {} x {}", formatQuantity(v[0], unit::metre), formatQuantity(v[1], unit::metre),
                       formatQuantity(v[2], unit::metre));
}

// Cells of the same shape, membrane and mesh, counted in one entry.
struct CellKind {
    const simulation::CellSettings* first;
    std::size_t count;
};
std::vector<CellKind> kindsOf(const simulation::Case& input) {
    std::vector<CellKind> kinds;
    for (const simulation::CellTypeSettings& cell : input.mesh.cells) {
        const auto same = std::find_if(kinds.begin(), kinds.end(), [&](const CellKind& kind) {
            return kind.first->type() == cell.type() && kind.first->edge == cell.edge &&
                   kind.first->shape.name == cell.shape.name && kind.first->shape->area() == cell.shape->area();
        });
        if (same == kinds.end())
            kinds.push_back({&cell, cell.placed.size()});
        else
            same->count += cell.placed.size();
    }
    return kinds;
}

std::string withoutLineEnds(std::string text) {
    while (text.ends_with('\n')) text.pop_back();
    for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos;) text.replace(at, 1, "; ");
    return text;
}

// "tension: onset 1e-6 N/m, modulus 0.1 N/m" of `type: tension` with its settings.
std::string settingsText(const Node& model) {
    std::string text = model.kind == Node::Kind::table ? model.find("type")->scalar : model.scalar;
    for (const auto& [key, value] : model.entries)
        if (key != "type")
            text += fmt::format("{}{} {}", text.find(':') == std::string::npos ? ": " : ", ", key, emitInLine(value));
    return text;
}

// The number of nodes of the mesh in 0/, if there is one; faults of the mesh are reported where it is used.
std::optional<long> nodesInMesh(const simulation::Case& input, const simulation::CellSettings& cell) {
    try {
        return static_cast<long>(io::readVtp(input.directory / "0" / (cell.name + ".vtp")).points.size());
    } catch (const Failure&) {
        return std::nullopt;
    }
}

// Refuses cells and bodies whose meshes in 0/ overlap, as particleFill does; with particles, reportRun finds them.
void findOverlaps(Report& report, const simulation::Case& input) {
    const auto isThere = [&](const auto& surface) {
        return std::filesystem::exists(input.directory / "0" / (surface.name + ".vtp"));
    };
    if (!std::all_of(input.mesh.cells.begin(), input.mesh.cells.end(), isThere) ||
        !std::all_of(input.mesh.bodies.begin(), input.mesh.bodies.end(), isThere))
        return;
    std::vector<geometry::TriangleMesh> cells, bodies;
    try {
        cells = utilities::placedCells(input, utilities::readCellMeshes(input));
        bodies = utilities::readBodyMeshes(input);
    } catch (const Failure& failure) {
        report.warnings.emplace_back(failure.what());
        return;
    }
    utilities::requireClear(input, cells, bodies);
}

void reportCase(Report& report, const simulation::Case& input) {
    report.section("Case");
    std::vector<std::vector<std::string>> rows;
    std::string periodic;
    for (int k = 0; k < 3; ++k)
        if (!input.hasWallsAcross(k)) periodic += (periodic.empty() ? "" : ", ") + std::string(1, "xyz"[k]);
    rows.push_back(
        {"flow",
         fmt::format(
             "{}{}{}", input.flowModel.name,
             input.flow.shearRate > 0 ? ", gammadot " + formatQuantity(input.flow.shearRate, unit::perSecond) : "",
             input.control.endStrain ? fmt::format(", to strain {:g}", *input.control.endStrain)
                                     : ", to t = " + formatQuantity(*input.control.endTime, unit::second))});
    rows.push_back({"domain", vectorText(input.mesh.domain.size) + ", periodic in " + periodic});
    const simulation::NumericsSettings& n = input.numerics;
    rows.push_back({"numerics",
                    fmt::format("{}, {}{} operators, {} precision", n.integrator,
                                input.mesh.cells.empty() ? "" : n.coupling + " coupling, ", n.operators, n.precision)});
    const simulation::ParticleEstimate count = simulation::estimateParticles(input);
    std::string particles = simulation::countText(count.fluid) + " of the fluid";
    if (count.walls > 0) particles += fmt::format(", {} in walls", simulation::countText(count.walls));
    if (count.bodies > 0) particles += fmt::format(", {} in bodies", simulation::countText(count.bodies));
    if (count.nodes > 0) particles += fmt::format(", {} on membranes", simulation::countText(count.nodes));
    rows.push_back({"particles", particles});
    double nodes = 0;
    for (const CellKind& kind : kindsOf(input)) {
        const simulation::CellSettings& cell = *kind.first;
        const std::optional<long> made = nodesInMesh(input, cell);
        const double each = made ? static_cast<double>(*made) : simulation::estimateNodes(cell);
        nodes += each * static_cast<double>(kind.count);
        rows.push_back({"cells", fmt::format("{} of {}: {}, edge {}, {}{} nodes each", kind.count, cell.type(),
                                             cell.shape.name, formatQuantity(cell.edge, unit::metre),
                                             made ? "" : "about ", simulation::countText(each))});
        const membrane::MembraneSettings& laws = input.membraneOf(cell);
        rows.push_back({"", withoutLineEnds(membrane::describeConstants(laws, cell.edge))});
        if (laws.pores) rows.push_back({"", "pores " + settingsText(writeChoice(laws.pores))});
    }
    if (const auto& solute = input.fluid.solute)
        rows.push_back({"solute", fmt::format("{} outside the cells, diffusivity {}, molecules of radius {}",
                                              formatQuantity(solute->concentration, unit::kilogramPerMetre3),
                                              formatQuantity(solute->diffusivity, unit::metre2PerSecond),
                                              formatQuantity(solute->radius, unit::metre))});
    report.table({}, rows);
    const auto whole = [](double number) { return static_cast<long>(std::min(number, 9e18)); };
    report.json["particles"] = {{"fluid", whole(count.fluid)},
                                {"walls", whole(count.walls)},
                                {"nodes", whole(count.nodes)},
                                {"bodies", whole(count.bodies)},
                                {"membraneNodes", whole(nodes)}};
}

// Groups whose symbol ends in /dx describe the resolution; the others describe the flow.
void reportGroups(Report& report, const simulation::Case& input) {
    std::vector<std::vector<std::string>> flow, resolution;
    for (const simulation::Group& g : simulation::dimensionlessGroups(input)) {
        (g.symbol.ends_with("/dx") ? resolution : flow).push_back({g.name, g.value, g.text});
        report.json["groups"][g.name] = g.number;
    }
    report.section("Dimensionless groups");
    report.table({}, flow);
    report.section("Resolution");
    report.table({}, resolution);
    for (const std::string& words : simulation::outsideSafeRanges(input)) {
        report.warnings.push_back(words);
        report.json["outsideSafeRange"].push_back(words);
    }
}

// Warns of mesh edges that do not suit any particle spacing.
void findEdges(Report& report, const simulation::Case& input) {
    constexpr double finest = 0.5, coarsest = 1.8;  // in spacings
    const auto check = [&](const std::string& what, double edge) {
        const double ratio = edge / input.spacing();
        if (ratio >= finest && ratio <= coarsest) return;
        report.warnings.push_back(fmt::format(
            "{}: the edge is {:.2g} dx ({} at a spacing of {}): {}. Write 'edge: 1 dx' to 'edge: 1.5 dx' in "
            "system/mesh.yaml, or a spacing of about {} in system/numerics.yaml",
            what, ratio, formatQuantity(edge, unit::metre), formatQuantity(input.spacing(), unit::metre),
            ratio < finest ? fmt::format("{:.0f} nodes for each particle on the surface, steps and memory for nothing",
                                         1 / (ratio * ratio))
                           : "particles pass between the nodes, which do not hold them back",
            formatQuantity(edge, unit::metre, 2)));
    };
    for (const CellKind& kind : kindsOf(input)) check("cell " + kind.first->name, kind.first->edge);
    for (const simulation::BodyPlaceSettings& body : input.mesh.bodies) check("body " + body.name, body.edge);
}

// Warns of a density, set by the given Re, that is far from that of any likely liquid.
void findDensity(Report& report, const simulation::Case& input) {
    constexpr double far = 100;
    const double ratio = input.flow.density / input.fluid.density;
    if (!input.flow.densityFromRe || (ratio <= far && ratio >= 1 / far)) return;
    report.warnings.push_back(fmt::format(
        "'inertia: {{Re: ...}}' of constant/flow.yaml sets the density to {:.3g} kg/m^3, {:.2g} times that of "
        "constant/fluid.yaml. "
        "Are shear rate ({}) and viscosity ({}) those that are meant? With the fluid's own density Re is {:.1g} of "
        "what is "
        "stated: write 'inertia: physical', whose cost does not depend on Re by the implicit step, or a Re nearer to "
        "that",
        input.flow.density, ratio, formatQuantity(input.flow.shearRate, unit::perSecond),
        formatQuantity(input.fluid.viscosity, unit::pascalSecond), 1 / ratio));
}

void reportCosts(Report& report, const simulation::Case& input) {
    const schemes::CaseFacts facts = input.facts();
    const std::vector<schemes::IntegratorCost> costs = schemes::predictCosts(input.written, facts);
    // Those that can run the case, and the one in use.
    std::vector<schemes::IntegratorCost> possible;
    for (const schemes::IntegratorCost& cost : costs) {
        ordered_json& entry = report.json["integrators"][cost.name];
        entry = {{"step_s", cost.step().seconds}, {"limit", cost.step().name}, {"steps", cost.steps},
                 {"passes", cost.passes},         {"cost", cost.cost},         {"whyNot", cost.whyNot}};
        for (const sph::StepLimit& limit : cost.limits.all) entry["limits_s"][limit.name] = limit.seconds;
        if (cost.whyNot.empty() || cost.name == input.numerics.integrator) possible.push_back(cost);
    }
    report.json["integrator"] = input.numerics.integrator;
    report.section("Step and cost");
    report.table(schemes::costHeader(facts),
                 schemes::costRows(possible, input.numerics.integrator, input.integratorChosen));
}

void reportSize(Report& report, const simulation::Case& input) {
    const int ranks = report.app.communicator().size();
    const auto size = simulation::estimateSize(input, ranks);
    const auto keep = static_cast<double>(input.control.checkpoint.keep);
    const std::optional<long> kept = input.control.write.keep;
    const double stored = kept ? std::min(static_cast<double>(*kept), size.writes) : size.writes;
    const double results = size.perWrite * stored, checkpoints = size.checkpoint * keep;
    report.section("Memory and disk");
    report.table(
        {},
        {{"memory", formatBytes(size.memory),
          fmt::format("on {}; the machine {} has {} free", counted(ranks, "rank"), machineInfo().host,
                      formatBytes(availableMemory().shared.bytes))},
         {"results", formatBytes(results),
          fmt::format("{}{} times of {}", simulation::countText(size.writes),
                      stored < size.writes ? fmt::format(", of which the last {} are kept,", *kept) : "",
                      formatBytes(size.perWrite))},
         {"checkpoints", formatBytes(checkpoints),
          fmt::format("the last {} are kept, of {}", input.control.checkpoint.keep, formatBytes(size.checkpoint))}});
    report.json["memory_B"] = size.memory;
    report.json["disk_B"] = results + checkpoints;
    report.json["results_B"] = results, report.json["checkpoint_B"] = size.checkpoint;
}

// Moduli measured on the networks, one line for each kind of cell.
void reportMembranes(Report& report, const coupling::Scene& scene) {
    std::vector<std::string> told;
    for (const coupling::CellType& type : scene.cells.types()) {
        const membrane::NetworkModuli m = membrane::measureModuli(type.membrane->network(), type.settings);
        report.json["cells"][type.name] = {{"count", type.places.size()}, {"nodes", type.nodes.size()},
                                           {"shearModulus_N_m", m.shear}, {"areaModulus_N_m", m.area},
                                           {"deviation", m.deviation},    {"shearAnisotropy", m.shearAnisotropy}};
        std::string text = fmt::format(
            "{} nodes; Gs {:.4g}, Ks {:.4g} of the closed form, varying by {:.2g} %, by direction down to {:.2f}",
            type.nodes.size(), m.shear / m.closedForm.shear, m.area / m.closedForm.area, 100 * m.deviation,
            m.shearAnisotropy);
        if (std::find(told.begin(), told.end(), text) != told.end()) continue;
        told.push_back(text);
        report.line(fmt::format("network of {}: {}", type.name, text));
    }
}

void reportBodies(Report& report, const simulation::Case& input, const coupling::Scene& scene) {
    if (!scene.bodies) return;
    for (const bodies::Body& body : scene.bodies->all()) {
        report.line(fmt::format("body {}: {}, {} particles, volume {:.6g} m^3, mass {:.6g} kg", body.name,
                                input.bodies.types.at(body.type).motion.name, body.particles.size(), body.solid.volume,
                                body.solid.mass));
        report.json["bodies"][body.name] = {{"volume_m3", body.solid.volume}, {"mass_kg", body.solid.mass}};
    }
}

// Number of steps and wall-clock time [s] of the whole run, with the mean step of the second half of the burst. For
// rkl2, whose steps and numbers of stages grow during a run, both follow from the predicted costs and the measured time
// of a step.
std::pair<double, double> predictRun(const simulation::Case& input, double dt, int stages, double perStep) {
    if (stages == 0) {
        const double steps = input.duration() / dt;
        return {steps, steps * perStep};
    }
    for (const schemes::IntegratorCost& cost : schemes::predictCosts(input.written, input.facts()))
        if (cost.name == input.numerics.integrator) return {cost.steps, cost.passes * perStep / (stages + 1)};
    return {};
}

// Reports from time to time how far the timing has come.
class Timing {
  public:
    explicit Timing(Report& report) : report_(report), last_(std::chrono::steady_clock::now()) {}
    void step(int made) {
        const auto now = std::chrono::steady_clock::now();
        if (now - last_ < pause) return;
        last_ = now;
        report_.line(fmt::format("timing: {} of {} steps", made, burstSteps));
    }

  private:
    static constexpr auto pause = std::chrono::seconds(10);
    Report& report_;
    std::chrono::steady_clock::time_point last_;
};

void reportRun(Report& report, const simulation::Case& input) {
    Application& app = report.app;
    coupling::Scene scene = simulation::buildScene(input, app.communicator().handle());
    Time time = simulation::startTime(app, input);
    simulation::Integrator integrator(input, scene);
    integrator.start(time);
    reportMembranes(report, scene);
    reportBodies(report, input, scene);
    std::string limits;
    for (const sph::StepLimit& limit : integrator.limits().all) {
        report.json["limits_s"][limit.name] = limit.seconds;
        limits += fmt::format("{}{} {}{}", limits.empty() ? "" : ", ", limit.name,
                              formatQuantity(limit.seconds, unit::second),
                              limit.name == integrator.limits().binding().name ? " (binds)" : "");
    }
    report.line("limits of the step: " + limits);
    report.json["binding"] = integrator.limits().binding().name;

    Timing timing(report);
    const auto begin = std::chrono::steady_clock::now();
    simulation::Rollback step(input, scene, time, integrator,
                              app.log());  // steps and rolls back as the solver does
    int made = 0;
    // The first steps of a run are longer or shorter than the later ones.
    std::pair<int, double> from{0, time.t};
    for (int tries = 0; made < burstSteps && tries < 2 * burstSteps && time.running(); ++tries) {
        if (made == burstSteps / 2 && from.first == 0) from = {made, time.t};
        made += step.advance();
        timing.step(made);
    }
    const double dt =
        made > from.first && time.t > from.second ? (time.t - from.second) / (made - from.first) : time.dt;
    const double perStep =
        app.communicator().max(std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count()) /
        std::max(1, made);
    const auto [steps, seconds] = predictRun(input, dt, integrator.limits().stages, perStep);
    const double particles = app.communicator().sum(static_cast<double>(scene.system->owned()));
    report.line(fmt::format("predicted: {:.4g} steps of {:.3g} s = {} on {} ({:.3g} million particle-steps per second)",
                            steps, seconds / steps, formatDuration(seconds),
                            counted(static_cast<std::size_t>(app.communicator().size()), "rank"),
                            1e-6 * particles / perStep));
    report.json["steps"] = steps;
    report.json["secondsPerStep"] = seconds / steps;
    report.json["predicted_s"] = seconds;
}

// The checkpoint from which the solver would continue, and whether it may; refused here for the same reasons as there.
void findCheckpoint(Report& report, const simulation::Case& input) {
    const MPI_Comm comm = report.app.communicator().handle();
    const auto checkpoint = simulation::chooseCheckpoint(input, input.control.startFrom, comm, report.app.log());
    if (checkpoint.empty()) return;
    for (const std::string& note : simulation::compareSettings(checkpoint, input, comm))
        report.line("note at the restart: " + note);
    report.line("a run goes on from " + checkpoint.string());
    report.json["checkpoint"] = checkpoint.string();
}

}  // namespace

int main(int argc, char* argv[]) {
    Application app("checkCase", "Checks a case and says what it will take, before anything runs.", argc, argv,
                    {.samples = {"checkCase -case tutorials/rbcShear/Ca0.02", "mpirun -np 2 checkCase"}});
    return app.run([&] {
        const simulation::Case input = simulation::Case::read(app);
        Report report{app, {}, {}};
        reportCase(report, input);
        reportGroups(report, input);
        findEdges(report, input);
        findDensity(report, input);
        for (const std::string& words : simulation::caseWarnings(input)) report.warnings.push_back(words);
        for (const std::string& note : simulation::caseNotes(input)) report.line("note: " + note);
        reportSize(report, input);
        simulation::requireMemory(app.communicator(), input);
        reportCosts(report, input);
        if (std::filesystem::exists(input.directory / "0" / "fluid.vtp")) {
            reportRun(report, input);
        } else {
            findOverlaps(report, input);
            report.line(fmt::format("limits of the step and run time need 0/: run {}particleFill, then checkCase again",
                                    input.mesh.cells.empty() && input.mesh.bodies.empty() ? "" : "membraneMesh and "));
        }
        findCheckpoint(report, input);
        for (const std::string& words : report.warnings) app.log().warning("{}", words);
        report.json["warnings"] = report.warnings;
        app.log().info("Case OK.");
        if (app.json() && app.communicator().isRoot()) std::cout << report.json.dump(2) << '\n';
        return ExitCode::done;
    });
}
