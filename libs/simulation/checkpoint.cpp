#include "simulation/checkpoint.hpp"

#include <cmath>
#include <stdexcept>

#include "core/communicator.hpp"
#include "core/together.hpp"
#include "simulation/restart.hpp"
#include "simulation/resultsWriter.hpp"
#include "simulation/sceneBuilder.hpp"

namespace corpuscle::simulation {

using coupling::Cell;
using coupling::Scene;

namespace {

// Of the dataset with what the scheme keeps.
std::string schemeName(const Case& input) { return "scheme/" + input.scheme().traits().state; }

std::vector<double> flat(const std::vector<Vec3>& vectors) {
    std::vector<double> values;
    for (const Vec3& v : vectors) values.insert(values.end(), v.data(), v.data() + 3);
    return values;
}
std::vector<Vec3> vectors(const std::vector<double>& values) {
    std::vector<Vec3> result;
    for (std::size_t i = 0; i + 2 < values.size(); i += 3) result.emplace_back(values.data() + i);
    return result;
}

// Every rank's part of the budget, rank after rank, the same on all.
std::vector<double> gathered(const sph::Budget& budget, MPI_Comm comm) {
    std::vector<double> own(budget.total.begin(), budget.total.end());
    own.insert(own.end(), budget.last.begin(), budget.last.end());
    own.push_back(budget.lastKnown);
    int ranks = 1;
    MPI_Comm_size(comm, &ranks);
    std::vector<double> all(own.size() * static_cast<std::size_t>(ranks));
    const int length = static_cast<int>(own.size());
    MPI_Allgather(own.data(), length, MPI_DOUBLE, all.data(), length, MPI_DOUBLE, comm);
    return all;
}
// A rank's own part where there are as many ranks; else all of it to the root.
void restoreBudget(sph::Budget& budget, const std::vector<double>& all, bool sameRanks, int rank) {
    const std::size_t count = budget.total.size(), length = 2 * count + 1;
    std::fill(budget.total.begin(), budget.total.end(), 0.0), std::fill(budget.last.begin(), budget.last.end(), 0.0);
    for (std::size_t part = 0; part < all.size() / length; ++part) {
        const double* values = all.data() + length * part;
        budget.lastKnown = values[2 * count] != 0;
        if (sameRanks ? part != static_cast<std::size_t>(rank) : rank != 0) continue;
        for (std::size_t k = 0; k < count; ++k) budget.total[k] += values[k], budget.last[k] += values[count + k];
    }
}

// To a file, or to memory.
template <class File>
void save(File& file, const Case& input, const Scene& scene, const Time& time, const RunState& state) {
    const MPI_Comm comm = scene.system->comm();
    file.attribute("time", time.t);
    file.attribute("strain", time.strain());
    file.attribute("step", static_cast<std::int64_t>(time.step));
    file.attribute("dt", state.integrator.dt);
    file.writeReplicated(schemeName(input), state.integrator.scheme);
    file.attribute("rebuilds", static_cast<std::int64_t>(scene.system->rebuilds()));
    if (scene.shifting) file.attribute("shiftingSteps", static_cast<std::int64_t>(scene.shifting->count()));
    if (!scene.cells.empty())
        file.attribute("guardMoves", static_cast<std::int64_t>(Communicator(comm).sum(scene.movedBack)));
    file.writeReplicated("bricks", scene.system->decomposition().state());
    file.writeReplicated("observers", state.observers);
    if (scene.budget.kept) file.writeReplicated("budgetByWall", gathered(scene.budget, comm));
    scene.store().forEachField([&](std::string_view name, const auto& array) {
        using T = typename std::remove_cvref_t<decltype(array)>::value_type;
        file.writeDistributed("particles/" + std::string(name), std::span<const T>(array.data(), array.size()));
    });
    for (const Cell& cell : scene.cells) {
        // Rank 0 writes; it need not be one that holds the cell.
        const int source = lowestHolder(scene, cell);
        std::vector<double> position = flat(cell.membrane.position), velocity = flat(cell.membrane.velocity);
        const std::vector<char>& bonds = cell.membrane.network().aliveBonds();
        std::vector<std::int64_t> alive(bonds.begin(), bonds.end());
        MPI_Bcast(position.data(), static_cast<int>(position.size()), MPI_DOUBLE, source, comm);
        MPI_Bcast(velocity.data(), static_cast<int>(velocity.size()), MPI_DOUBLE, source, comm);
        MPI_Bcast(alive.data(), static_cast<int>(alive.size()), MPI_INT64_T, source, comm);
        const std::string group = "cells/" + cell.membrane.name + "/";
        file.writeReplicated(group + "position", position);
        file.writeReplicated(group + "velocity", velocity);
        file.writeReplicated(group + "aliveBonds", alive);
        if (std::vector<double> damage = cell.membrane.damage(); !damage.empty()) {
            MPI_Bcast(damage.data(), static_cast<int>(damage.size()), MPI_DOUBLE, source, comm);
            file.writeReplicated(group + "damage", damage);
        }
    }
    if (scene.bodies)
        for (const bodies::Body& body : scene.bodies->all())
            file.writeReplicated("bodies/" + body.name + "/state", body.saved());
}

// `where` is what errors name.
template <class File>
RunState load(File& file, const std::string& where, const Case& input, Scene& scene, Time& time) {
    time.t = file.template attribute<double>("time");
    time.strained = file.template attribute<double>("strain");
    time.step = file.template attribute<std::int64_t>("step");
    RunState state;
    const std::string scheme = schemeName(input);
    if (!file.has(scheme))
        throw Failure(ExitCode::io, where + " holds no state of 'integrator: " + input.numerics.integrator +
                                        "': another scheme or an earlier version wrote it; start from firstTime");
    state.integrator = {file.template attribute<double>("dt"), file.template readReplicated<double>(scheme)};
    state.observers = file.template readReplicated<double>("observers");
    particles::ParticleStore& s = scene.store();
    std::size_t count = 0;
    s.forEachField([&](std::string_view name, auto& array) {
        using T = typename std::remove_cvref_t<decltype(array)>::value_type;
        const std::vector<T> values = file.template readDistributed<T>("particles/" + std::string(name));
        array.assign(values.begin(), values.end());
        count = values.size();
    });
    s.resize(count);
    for (Cell& cell : scene.cells) {
        const std::string group = "cells/" + cell.membrane.name + "/";
        cell.held = true;
        cell.membrane.position = vectors(file.template readReplicated<double>(group + "position"));
        cell.membrane.velocity = vectors(file.template readReplicated<double>(group + "velocity"));
        const auto alive = file.template readReplicated<std::int64_t>(group + "aliveBonds");
        if (cell.membrane.position.size() != cell.membrane.network().nodeCount() ||
            alive.size() != cell.membrane.network().allBonds().size())
            throw Failure(ExitCode::io, where + " and 0/" + cell.membrane.name +
                                            ".vtp hold different meshes; the case was meshed "
                                            "again after the checkpoint: start from firstTime");
        const std::string damage = group + "damage";
        cell.membrane.restore({alive.begin(), alive.end()},
                              file.has(damage) ? file.template readReplicated<double>(damage) : std::vector<double>{});
    }
    if (scene.budget.kept && file.has("budget"))
        throw Failure(ExitCode::io, where +
                                        " holds the budget of an earlier version, which counted the forces of walls "
                                        "otherwise; start from firstTime");
    if (scene.budget.kept && file.has("budgetByWall"))
        restoreBudget(scene.budget, file.template readReplicated<double>("budgetByWall"), file.sameRanks(),
                      scene.system->decomposition().rank());
    if (scene.bodies)
        for (bodies::Body& body : scene.bodies->all())
            body.restore(file.template readReplicated<double>("bodies/" + body.name + "/state"));
    if (scene.shifting) scene.shifting->restore(file.template attribute<std::int64_t>("shiftingSteps"));
    if (!scene.cells.empty()) {
        const auto moves = file.template attribute<std::int64_t>("guardMoves");
        // The sum over ranks is what counts: rank 0 takes it up.
        scene.movedBack = scene.system->decomposition().rank() == 0 ? static_cast<long>(moves) : 0;
    }
    if (file.sameRanks())
        scene.system->resume(file.template readReplicated<double>("bricks"),
                             file.template attribute<std::int64_t>("rebuilds"));
    else
        scene.system->start();
    return state;
}

}  // namespace

void writeCheckpoint(const Case& input, const Scene& scene, const Time& time, const RunState& state) {
    const MPI_Comm comm = scene.system->comm();
    io::CheckpointWriter file(comm, io::nextCheckpoint(comm, input.directory));
    save(file, input, scene, time, state);
    writeOrigin(file, input, scene);
    file.finish();
    io::keepCheckpoints(comm, input.directory, static_cast<int>(input.control.checkpoint.keep));
}

RunState readCheckpoint(const std::filesystem::path& path, const Case& input, Scene& scene, Time& time) {
    io::CheckpointReader file(scene.system->comm(), path);
    compareMeshes(file, path, input, scene);
    return load(file, path.string(), input, scene, time);
}

void remember(io::MemoryCheckpoint& memory, const Case& input, const Scene& scene, const Time& time,
              const RunState& state) {
    save(memory, input, scene, time, state);
}

RunState recall(const io::MemoryCheckpoint& memory, const Case& input, Scene& scene, Time& time) {
    return load(memory, "the state in memory", input, scene, time);
}

std::filesystem::path chooseCheckpoint(const Case& input, const std::string& startFrom, MPI_Comm comm, Log& log) {
    std::optional<double> wanted;
    try {
        wanted = ControlSettings::startingTime(startFrom);
    } catch (const std::invalid_argument& fault) {  // the case's own word was checked when it was read
        throw Failure(ExitCode::usage, std::string("-restart: ") + fault.what());
    }
    if (!wanted) {
        const io::CheckpointSearch found = io::latestCheckpoint(comm, input.directory);
        for (const std::string& warning : found.warnings) log.warning("{}", warning);
        return found.path;
    }
    if (*wanted == 0) return {};
    std::string path;
    onRoot(comm, [&] {
        const io::CheckpointInfo found = io::findCheckpoint(input.directory, *wanted);
        path = found.path.string();
        if (std::abs(found.time - *wanted) > 1e-6 * *wanted)
            log.info("The checkpoint nearest before {} is that at t = {}", formatQuantity(*wanted, unit::second),
                     formatQuantity(found.time, unit::second, 9));
    });
    return Communicator(comm).broadcast(path);
}

}  // namespace corpuscle::simulation
