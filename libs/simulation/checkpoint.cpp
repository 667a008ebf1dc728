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

// Name of the dataset with the state of the scheme.
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

// The parts of all ranks in the budget, rank after rank; the same on every rank.
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
// With the same number of ranks, each rank takes its own part; otherwise the root takes the sum of all parts.
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

// Each type of cell has a group of datasets with one row for each cell, written by the cell's owner: its number, the
// reach by which its holders were found, positions and velocities of its nodes, unbroken bonds, damage, pores.
std::string groupOf(const coupling::CellType& type) { return "cells/" + type.name + "/"; }

// Number of the values of damage that each cell of the type has.
std::size_t damageSize(const coupling::CellType& of) {
    return of.settings.rupture ? of.settings.rupture->damageSize(of.membrane->network()) : 0;
}

// A law that finds only the damage of another place begins without damage.
const char* damageName(const coupling::CellType& of) {
    return of.settings.rupture->damageOf() == membrane::RuptureLaw::DamageOf::nodes ? "nodeDamage" : "damage";
}

template <class File>
void saveType(File& file, const Scene& scene, std::size_t type) {
    const coupling::CellType& of = scene.cells.types()[type];
    const std::string group = groupOf(of);
    std::vector<double> reach, position, velocity, damage, pores;
    std::vector<std::int64_t> number, alive;
    const auto add = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
    for (const Cell& cell : scene.cells) {
        if (cell.type != type || !cell.isOwnedBy(scene.system->decomposition().rank())) continue;
        const membrane::Membrane& m = cell.membrane;
        number.push_back(m.cell);
        add(reach, flat({cell.reach.min(), cell.reach.max()}));
        add(position, flat(m.position)), add(velocity, flat(m.velocity));
        add(alive, m.network().aliveBonds()), add(damage, m.damage());
        add(pores, m.pores());
    }
    const auto count = [](std::size_t each) { return static_cast<int>(each); };
    file.writeDistributed(group + "number", number, 1);
    file.writeDistributed(group + "reach", reach, 6);
    file.writeDistributed(group + "position", position, count(3 * of.nodes.size()));
    file.writeDistributed(group + "velocity", velocity, count(3 * of.nodes.size()));
    file.writeDistributed(group + "aliveBonds", alive, count(of.membrane->network().allBonds().size()));
    if (const std::size_t size = damageSize(of); size > 0)
        file.writeDistributed(group + damageName(of), damage, count(size));
    if (of.settings.pores) file.writeDistributed(group + "pores", pores, count(of.nodes.size()));
}

// Adds this rank's cells of the type.
template <class File>
void loadType(File& file, const std::string& where, const Scene& scene, std::size_t type, std::vector<Cell>& cells) {
    const coupling::CellType& of = scene.cells.types()[type];
    const std::string group = groupOf(of);
    if (!file.has(group + "number"))
        throw Failure(ExitCode::io, where +
                                        " holds the cells one by one, as an earlier version wrote them; start from "
                                        "firstTime");
    const auto numbers = [&](const char* name, std::size_t each) {
        return file.template readDistributed<double>(group + name, static_cast<int>(each));
    };
    const std::size_t bonds = of.membrane->network().allBonds().size();
    const auto number = file.template readDistributed<std::int64_t>(group + "number", 1);
    const auto alive = file.template readDistributed<std::int64_t>(group + "aliveBonds", static_cast<int>(bonds));
    const std::vector<Vec3> reach = vectors(numbers("reach", 6)),
                            position = vectors(numbers("position", 3 * of.nodes.size())),
                            velocity = vectors(numbers("velocity", 3 * of.nodes.size()));
    const std::size_t sizeOfDamage = damageSize(of);
    const auto damage = sizeOfDamage > 0 && file.has(group + damageName(of)) ? numbers(damageName(of), sizeOfDamage)
                                                                             : std::vector<double>{};
    const auto pores =
        of.settings.pores && file.has(group + "pores") ? numbers("pores", of.nodes.size()) : std::vector<double>{};
    const auto part = [](const auto& all, std::size_t k, std::size_t each) {
        const auto from = all.begin() + static_cast<std::ptrdiff_t>(k * each);
        return std::pair(from, from + static_cast<std::ptrdiff_t>(each));
    };
    for (std::size_t k = 0; k < number.size(); ++k) {
        Cell& cell = cells.emplace_back(scene.cells.make(static_cast<int>(number[k])));
        cell.reach = {reach[2 * k], reach[2 * k + 1]};
        const auto [x, xEnd] = part(position, k, of.nodes.size());
        const auto [u, uEnd] = part(velocity, k, of.nodes.size());
        const auto [bond, bondEnd] = part(alive, k, bonds);
        cell.membrane.position.assign(x, xEnd), cell.membrane.velocity.assign(u, uEnd);
        const auto ofCell = [&](const std::vector<double>& all, std::size_t each) {
            if (all.empty()) return std::vector<double>{};
            const auto [from, to] = part(all, k, each);
            return std::vector<double>(from, to);
        };
        cell.membrane.restore({bond, bondEnd}, ofCell(damage, sizeOfDamage), ofCell(pores, of.nodes.size()));
    }
}

// Saves a state to a file, or to memory.
template <class File>
void save(File& file, const Case& input, const Scene& scene, const Time& time, const RunState& state) {
    const MPI_Comm comm = scene.system->comm();
    file.attribute("time", time.t);
    file.attribute("strain", time.strain());
    file.attribute("step", static_cast<std::int64_t>(time.step));
    file.attribute("dt", state.integrator.dt);
    file.writeReplicated(schemeName(input), state.integrator.scheme);
    file.attribute("rebuilds", static_cast<std::int64_t>(scene.system->rebuilds()));
    if (scene.control) file.writeReplicated("flowControl", scene.control->state());
    if (scene.shifting) file.attribute("shiftingSteps", static_cast<std::int64_t>(scene.shifting->count()));
    if (scene.cells.exist())
        file.attribute("guardMoves", static_cast<std::int64_t>(Communicator(comm).sum(scene.movedBack)));
    file.writeReplicated("bricks", scene.system->decomposition().state());
    if (const Periodicity& period = scene.system->periodicity(); period.slides())
        file.writeReplicated("imageOffset", flat({period.offset()}));
    file.writeReplicated("observers", state.observers);
    if (scene.budget.kept) file.writeReplicated("budgetEntries", gathered(scene.budget, comm));
    scene.store().forEachField([&](std::string_view name, const auto& array) {
        using T = typename std::remove_cvref_t<decltype(array)>::value_type;
        file.writeDistributed("particles/" + std::string(name), std::span<const T>(array.data(), array.size()));
    });
    for (std::size_t type = 0; type < scene.cells.types().size(); ++type) saveType(file, scene, type);
    if (scene.bodies)
        for (const bodies::Body& body : scene.bodies->all())
            file.writeReplicated("bodies/" + body.name + "/state", body.saved());
}

// where: name of the file, or of the state in memory, for messages.
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
    std::vector<Cell> cells;
    for (std::size_t type = 0; type < scene.cells.types().size(); ++type) loadType(file, where, scene, type, cells);
    scene.cells.take(std::move(cells), scene.system->decomposition().rank());
    if (scene.budget.kept && (file.has("budget") || file.has("budgetByWall")))
        throw Failure(ExitCode::io,
                      where + " holds the budget of an earlier version, with other entries; start from firstTime");
    if (scene.budget.kept && file.has("budgetEntries"))
        restoreBudget(scene.budget, file.template readReplicated<double>("budgetEntries"), file.sameRanks(),
                      scene.system->decomposition().rank());
    if (scene.bodies)
        for (bodies::Body& body : scene.bodies->all())
            body.restore(file.template readReplicated<double>("bodies/" + body.name + "/state"));
    if (scene.control && file.has("flowControl"))
        scene.control->restore(file.template readReplicated<double>("flowControl"));
    if (scene.shifting) scene.shifting->restore(file.template attribute<std::int64_t>("shiftingSteps"));
    if (scene.cells.exist()) {
        const auto moves = file.template attribute<std::int64_t>("guardMoves");
        // Only the sum over the ranks matters: rank 0 takes all of it.
        scene.movedBack = scene.system->decomposition().rank() == 0 ? static_cast<long>(moves) : 0;
    }
    if (scene.system->periodicity().slides())
        scene.system->setOffset(vectors(file.template readReplicated<double>("imageOffset")).at(0));
    if (file.sameRanks())
        scene.system->resume(file.template readReplicated<double>("bricks"),
                             file.template attribute<std::int64_t>("rebuilds"));
    else
        scene.system->start();
    scene.cells.resettle(*scene.system);
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
        if (std::abs(found.time - *wanted) > io::checkpointSlack * *wanted)
            log.info("The checkpoint nearest before {} is that at t = {}", formatQuantity(*wanted, unit::second, 9),
                     formatQuantity(found.time, unit::second, 9));
    });
    return Communicator(comm).broadcast(path);
}

}  // namespace corpuscle::simulation
