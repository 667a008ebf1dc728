#include "simulation/startingPoint.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "core/atomicFile.hpp"
#include "core/runRecord.hpp"
#include "core/together.hpp"
#include "core/writable.hpp"
#include "simulation/memoryLimit.hpp"
#include "simulation/restart.hpp"
#include "simulation/sceneBuilder.hpp"

namespace corpuscle::simulation {

void setEnds(Time& time, const ControlSettings& control) {
    time.endTime = control.endTime;
    time.endStrain = control.endStrain;
}

Time startTime(const Application& app, const Case& input) {
    Time time;
    time.shearRate = input.flow.shearRate;
    setEnds(time, input.control);
    if (const auto steps = app.integer("steps", 1)) time.lastStep = *steps;
    return time;
}

namespace {

void reportFinished(Application& app, const Case& input, const StartingPoint& from) {
    const std::string key = input.control.endTime ? "endTime" : "endStrain";
    const std::string reason = from.time.endReason() + " is reached by " + from.checkpoint.string();
    app.log().info(
        "The case is finished: {}. Nothing was changed.\n"
        "To go on, raise '{}' in system/control.yaml, or for one run: -set system/control.yaml:/{}=...\n"
        "To start anew: -set system/control.yaml:/startFrom=firstTime",
        reason, key, key);
    if (!app.json()) return;
    RunRecord record(input.directory / "run.json", app.name(), app.communicator());
    record.set("", "status", "finished");
    record.set("", "reason", reason);
    record.print();
}

// Whether run.json shows that a run was killed, or its disk was full, when it had written its last checkpoint: what
// follows then (summaries, run.json, log) is made up for.
bool wasCutShort(const Case& input, const Communicator& communicator) {
    bool cut = false;
    onRoot(communicator.handle(), [&] {
        const std::filesystem::path file = input.directory / "run.json";
        std::error_code none;
        if (!std::filesystem::exists(file, none)) return;
        const auto record = nlohmann::json::parse(readFile(file), nullptr, false);
        const auto status = record.is_object() ? record.value("status", nlohmann::json()) : nlohmann::json();
        cut = status == "running" || status == "failed";
    });
    return communicator.anyTrue(cut);
}

// The files that a run will write, by their temporary names, which are the longest.
std::vector<std::filesystem::path> outputs(const Case& input, int ranks) {
    std::vector<std::string> streams{"fluid"};
    for (const CellSettings& cell : input.mesh.cells) streams.push_back(cell.name);
    for (const BodyPlaceSettings& body : input.mesh.bodies) streams.push_back(body.name);
    std::vector<std::filesystem::path> files{input.directory / "run.json.0000000.tmp",
                                             input.directory / "checkpoints" / ".000000.h5.part"};
    for (const std::string& name : streams)
        files.push_back(input.directory / "results" / name / (name + "_000000") /
                        fmt::format(".{}_000000_{}.vtp.part", name, ranks - 1));
    for (const auto& observer : input.observers.models)
        files.push_back(input.directory / "postProcessing" / observer.first / "observer.csv.0000000.tmp");
    return files;
}

}  // namespace

void requireOutput(const Application& app, const Case& input) {
    requireWritable(app.communicator(), outputs(input, app.communicator().size()));
}

StartingPoint prepare(Application& app, const Case& input) {
    const MPI_Comm comm = app.communicator().handle();
    requireMemory(app.communicator(), input);
    if (!app.has("dry-run")) requireOutput(app, input);
    StartingPoint from;
    from.time = startTime(app, input);
    if (!app.has("dry-run")) app.lockCase();
    from.checkpoint = chooseCheckpoint(input, app.value("restart").value_or(input.control.startFrom), comm, app.log());
    if (from.checkpoint.empty()) {
        from.scene = buildScene(input, comm);
        return from;
    }
    from.notes = compareSettings(from.checkpoint, input, comm);
    from.scene = emptyScene(input, comm);
    from.state = readCheckpoint(from.checkpoint, input, from.scene, from.time);
    if (from.time.lastStep) *from.time.lastStep += from.time.step;
    if (!from.time.running() && !app.has("dry-run") && !wasCutShort(input, app.communicator())) {
        from.isFinished = true;
        reportFinished(app, input, from);
        return from;
    }
    app.log().info("Restart from {} at t = {}", from.checkpoint.string(), formatQuantity(from.time.t, unit::second));
    for (const std::string& note : from.notes) app.log().info("note: {}", note);
    return from;
}

void startIntegrator(const StartingPoint& from, Integrator& integrator, Time& time) {
    if (from.checkpoint.empty())
        integrator.start(time);
    else
        integrator.resume(from.state.integrator, time);
}

}  // namespace corpuscle::simulation
