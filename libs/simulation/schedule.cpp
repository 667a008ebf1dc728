#include "simulation/schedule.hpp"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <exception>

#include "io/earlierRun.hpp"
#include "observers/summary.hpp"
#include "particles/isa.hpp"
#include "schemes/cost.hpp"
#include "simulation/caseRules.hpp"
#include "simulation/groups.hpp"
#include "simulation/stateCheck.hpp"

namespace corpuscle::simulation {

using coupling::Scene;

namespace {

double processorSeconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }  // of this rank

}  // namespace

Usage solverUsage(const std::string& name) {
    return {.options = solverOptions(),
            .samples = {name + " -case myCase", "mpirun -np 2 " + name + " -case myCase",
                        name + " -set system/control.yaml:/write/keep=3 -steps 100", name + " -dry-run"}};
}

Schedule::Schedule(Application& app, const Case& input, const StartingPoint& from, const Integrator& integrator)
    : app_(app),
      input_(input),
      integrator_(integrator),
      start_(from.time),
      isContinued_(!from.checkpoint.empty()),
      notes_(from.notes),
      observers_(input.observers, from.scene, from.time, input.directory),
      results_(input, from.scene, from.time),
      checkpoints_(input.control.checkpoint.wallClock),
      stop_({input.directory / input.control.stop.file, input.control.stop.wallClock}, app.communicator()),
      progress_(app.log(), from.time),
      kept_(std::make_shared<RunRecord>(input.directory / "run.json", app.name(), app.communicator())),
      record_(*kept_),
      began_(std::chrono::steady_clock::now()),
      processorBegan_(processorSeconds()),
      smallestDt_(from.time.dt),
      largestDt_(from.time.dt) {
    if (!from.state.observers.empty()) observers_.restore(from.state.observers);
    particles_ = app.communicator().sum(static_cast<long>(from.scene.system->owned()));
}

Schedule::~Schedule() {
    if (std::uncaught_exceptions() == 0 || !begun_ || !app_.communicator().isRoot()) return;
    const std::vector<io::CheckpointInfo> all = io::listCheckpoints(input_.directory);
    if (!all.empty())
        app_.log().info(
            "{} is the last checkpoint, at t = {}: once the cause is removed, the same command goes on from there",
            all.back().path.string(), formatQuantity(all.back().time, unit::second));
}

void Schedule::describe() {
    Log& log = app_.log();
    std::vector<std::vector<std::string>> rows;
    for (const Group& g : dimensionlessGroups(input_)) {
        rows.push_back({g.name, g.value, g.text});
        record_.set("groups", g.name, g.number);
    }
    log.table({"group", "value", "meaning"}, rows);
    if (input_.flow.densityFromRe)
        log.info("inertia: the density is set by Re, rho = {} (constant/fluid.yaml: {})",
                 formatQuantity(input_.flow.density, unit::kilogramPerMetre3),
                 formatQuantity(input_.fluid.density, unit::kilogramPerMetre3));
    const schemes::CaseFacts facts = input_.facts();
    log.table(schemes::costHeader(facts), schemes::costRows(schemes::predictCosts(input_.written, facts),
                                                            input_.numerics.integrator, input_.integratorChosen));
    const NumericsSettings& numerics = input_.numerics;
    record_.set("parameters", "integrator", numerics.integrator);
    record_.set("parameters", "coupling", numerics.coupling);
    record_.set("parameters", "operators", numerics.operators);
    record_.set("parameters", "precision", numerics.precision);
    record_.set("parameters", "kernel", numerics.kernel.name);
    record_.set("parameters", "support_m", input_.support());
    record_.set("parameters", "viscosity_Pa_s", input_.fluid.viscosity);
    log.table({"limit of the step", "dt", ""}, limitRows(integrator_.limits()));
    for (const sph::StepLimit& limit : integrator_.limits().all) record_.set("limits_s", limit.name, limit.seconds);
    log.info("{} particles on {} rank{}, {} instructions", particles_, app_.communicator().size(),
             app_.communicator().size() > 1 ? "s" : "", particles::instructionSetName());
}

ExitCode Schedule::dryRun(const Scene& scene, const Time& time) {
    describe();
    app_.log().info("dry run: about {:.0f} steps to {}; nothing written, {} MiB in lists and particles of rank 0",
                    time.left() / std::max(time.dt, integrator_.limits().binding().seconds),
                    time.endTime ? "the end time" : "the end strain", scene.system->bytes() >> 20);
    record_.set("", "status", "dryRun");
    if (app_.json()) record_.print();
    return ExitCode::done;
}

void Schedule::begin(const Scene& scene, const Time& time) {
    app_.openLog(isContinued_ ? Application::LogStart::continued : Application::LogStart::anew);
    const io::ClearedOutput cleared = io::clearAfter(scene.system->comm(), input_.directory,
                                                     isContinued_ ? std::optional<double>(time.t) : std::nullopt);
    if (!cleared.empty())
        app_.log().info("removed what an earlier run of the case wrote {}: {}",
                        isContinued_ ? "after the start of this one" : "before", cleared.text());
    describe();
    begun_ = true;
    binding_ = integrator_.limits().binding().name;
    toldStep_ = time.step;
    app_.keepRecord(kept_);
    writeUsed(input_.directory / "used.yaml", input_.effective, app_.communicator());
    record_.set("parameters", "density_kg_m3", input_.flow.density);
    record_.set("parameters", "densityFromRe", input_.flow.densityFromRe);
    record_.set("parameters", "soundSpeed_m_s", input_.soundSpeed());
    record_.set("parameters", "shearRate_1_s", input_.flow.shearRate);
    record_.set("parameters", "spacing_m", input_.spacing());
    record_.set("parameters", "particles", particles_);
    record_.set("parameters", "startTime_s", time.t);
    record_.set("parameters", "commandLine", app_.commandLine());
    if (!notes_.empty()) record_.set("parameters", "changedAtRestart", notes_);
    record_.set("performance", "instructionSet", particles::instructionSetName());
    record_.write();

    if (results_.due(time)) results_.write(scene, time);
    observers_.run(scene, time);
    for (const std::string& note : observers_.notes()) app_.log().warning("{}", note);
    for (const std::string& note : caseWarnings(input_)) app_.log().warning("{}", note);
    for (const std::string& note : caseNotes(input_)) app_.log().info("note: {}", note);
}

void Schedule::afterStep(const Scene& scene, const Time& time) {
    smallestDt_ = std::min(smallestDt_, time.dt);
    largestDt_ = std::max(largestDt_, time.dt);
    ++stepsLimitedBy_[binding_];
    binding_ = integrator_.limits().binding().name;
    observers_.run(scene, time);
    if (results_.due(time)) {
        StateCheck::requireFinite(scene, time, "results were");
        results_.write(scene, time);
        reportGuard(scene, time);
        reportRupture(scene, time);
    }
    if (checkpoints_.due(stop_)) saveCheckpoint(scene, time);
    progress_.report(time);
    constexpr auto every = std::chrono::seconds(2);
    if (std::chrono::steady_clock::now() - told_ < every) return;
    recordProgress(time);
    try {
        record_.write();
    } catch (const Failure&) {  // a full disk ends the run when results or checkpoints are written, not here
    }
}

// For programs that watch the run (caseMonitor).
void Schedule::recordProgress(const Time& time) {
    const auto now = std::chrono::steady_clock::now();
    const double pause = std::chrono::duration<double>(now - told_).count(),
                 wall = std::chrono::duration<double>(now - began_).count(), made = time.fraction() - start_.fraction();
    record_.set("progress", "step", time.step);
    record_.set("progress", "time_s", time.t);
    if (time.shearRate > 0) record_.set("progress", "strain", time.strain());
    record_.set("progress", "dt_s", time.dt);
    record_.set("progress", "limit", binding_);
    record_.set("progress", "fraction", time.fraction());
    record_.set("progress", "stepsPerSecond", static_cast<double>(time.step - toldStep_) / pause);
    record_.set("progress", "secondsLeft", made > 0 ? wall * (1 - time.fraction()) / made : std::nan(""));
    told_ = now;
    toldStep_ = time.step;
}

std::vector<Event> Schedule::events(const Time& time) const {
    std::vector<Event> all = time.ends();
    all.push_back(results_.ticker().next(time));
    observers_.addEvents(time, all);
    return all;
}

bool Schedule::stopRequested(const Scene& scene, const Time& time) {
    if (input_.control.stop.firstBreak) {
        const auto broke = std::find_if(scene.cells.begin(), scene.cells.end(), [](const coupling::Cell& cell) {
            return cell.membrane.network().brokenBonds() > 0;
        });
        if (app_.communicator().anyTrue(broke != scene.cells.end())) {
            stopReason_ =
                fmt::format("first break, until strain {:.6g} (stop.firstBreak of system/control.yaml)", time.strain());
            return true;
        }
    }
    const bool requested = stop_.requested(time.step);
    stopReason_ = stop_.reason();
    return requested;
}

void Schedule::change(const Case& edited, const std::vector<std::string>& changes, const Scene& scene,
                      const Time& time) {
    if (emit(write(edited.observers)) != emit(write(input_.observers))) {
        observers::Observers next(edited.observers, scene, time, edited.directory);
        next.restore(observers_.state());
        observers_ = std::move(next);
    }
    results_.change(edited.control.write, time);
    checkpoints_.change(edited.control.checkpoint.wallClock, stop_);
    stop_.change({edited.directory / edited.control.stop.file, edited.control.stop.wallClock});
    for (const std::string& change : changes) app_.log().info("{}", change);
    edits_.insert(edits_.end(), changes.begin(), changes.end());
    record_.set("parameters", "changedWhileRunning", edits_);
    writeUsed(edited.directory / "used.yaml", edited.effective, app_.communicator());
}

void Schedule::reportRupture(const Scene& scene, const Time& time) {
    long own = 0;
    for (const coupling::Cell& cell : scene.cells)
        if (cell.isOwnedBy(app_.communicator().rank())) own += cell.membrane.network().brokenBonds();
    const long broken = app_.communicator().sum(own);
    if (broken > brokenBonds_) app_.log().info("rupture: {} bonds broken until strain {:.3f}", broken, time.strain());
    brokenBonds_ = broken;
}

void Schedule::reportGuard(const Scene& scene, const Time& time) {
    const long moves = app_.communicator().sum(scene.movedBack);
    if (moves > guardMoves_)
        app_.log().info("membranes: {} particles moved back until strain {:.3f} ({} since the last note)", moves,
                        time.strain(), moves - guardMoves_);
    guardMoves_ = moves;
}

void Schedule::saveCheckpoint(const Scene& scene, const Time& time) {
    StateCheck::requireFinite(scene, time, "a checkpoint was");
    writeCheckpoint(input_, scene, time, {.integrator = integrator_.state(time), .observers = observers_.state()});
}

Schedule::Memory Schedule::remember() const {
    return {observers_.remember(), results_.ticker(), guardMoves_, brokenBonds_};
}

void Schedule::goBack(const Memory& memory, const Scene& scene, const Time& time) {
    observers_.goBack(memory.observers, scene, time);
    results_.goBack(memory.results, time);
    guardMoves_ = memory.guardMoves, brokenBonds_ = memory.brokenBonds;
}

void Schedule::reportObservers(const Scene& scene, const Time& time) {
    for (const auto& [name, summary] : observers_.summaries(scene, time)) {
        record_.setJson("observers", name, summary.figures);
        for (const std::string& line : summary.lines) app_.log().info("{}: {}", name, line);
    }
}

double Schedule::particleSteps(const Time& time) const {
    return static_cast<double>(particles_) * static_cast<double>(time.step - start_.step);
}

ExitCode Schedule::end(const Scene& scene, const Time& time) {
    reportGuard(scene, time);
    reportRupture(scene, time);
    reportObservers(scene, time);
    // A run that was killed after its last checkpoint has nothing to add to it.
    if (!isContinued_ || time.step > start_.step || time.running()) saveCheckpoint(scene, time);
    const double wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - began_).count();
    const long steps = time.step - start_.step;
    record_.set("performance", "steps", steps);
    record_.set("performance", "wallClock_s", wall);
    record_.set("performance", "coreSeconds", wall * app_.communicator().size());
    record_.set("performance", "processorSeconds", app_.communicator().sum(processorSeconds() - processorBegan_));
    record_.set("performance", "particleStepsPerSecond", particleSteps(time) / wall);
    record_.set("performance", "rebuilds", scene.system->rebuilds());
    record_.set("extremes", "smallestStep_s", smallestDt_);
    record_.set("extremes", "largestStep_s", largestDt_);
    record_.set("result", "time_s", time.t);
    record_.set("result", "strain", time.strain());
    recordProgress(time);
    record_.set("progress", "stepsPerSecond", static_cast<double>(steps) / wall);
    integrator_.stepper().report(record_, app_.log(), steps);
    std::string limits;
    for (const auto& [name, number] : stepsLimitedBy_) {
        record_.set("stepsLimitedBy", name, number);
        limits += fmt::format("{}{} {}", limits.empty() ? "" : ", ", name, number);
    }
    if (stepsLimitedBy_.size() > 1) app_.log().info("limits that bound, and in how many steps: {}", limits);
    record_.set("extremes", "largestDensityBalance", integrator_.largestDensityBalance());
    if (scene.cells.exist()) {
        record_.set("extremes", "mostNodesWithoutLinearWeights", integrator_.mostFallbacks());
        long all = 0;
        for (const coupling::CellType& type : scene.cells.types())
            all += static_cast<long>(type.nodes.size() * type.places.size());
        // A few nodes for a few steps do no harm.
        if (const long nodes = integrator_.mostFallbacks();
            static_cast<double>(nodes) > 0.005 * static_cast<double>(all))
            app_.log().warning(
                "up to {} of the {} nodes of membranes moved in a step in part with a plain mean of the fluid around: "
                "weights exact on linear fields were too large there, or particles too few. Take a finer spacing, or "
                "a smaller step",
                nodes, all);
        record_.set("result", "guardMoves", guardMoves_);
        record_.set("result", "brokenBonds", brokenBonds_);
    }
    const bool ended = !time.running();
    const std::string reason = ended ? time.endReason() : stopReason_;
    const ExitCode code = ended ? ExitCode::done : ExitCode::stopped;
    record_.finish(code, reason);
    app_.log().info("{} after {} step{}, t = {}{}: {} wall clock, {:.3g} million particle-steps per second",
                    ended ? "End" : "Stopped", steps, steps == 1 ? "" : "s", formatQuantity(time.t, unit::second),
                    time.shearRate > 0 ? fmt::format(", strain {:.4f}", time.strain()) : "", formatDuration(wall),
                    1e-6 * particleSteps(time) / wall);
    if (!ended) app_.log().info("reason: {}; a checkpoint is written, the same command goes on from here", reason);
    if (app_.json()) record_.print();
    return code;
}

}  // namespace corpuscle::simulation
