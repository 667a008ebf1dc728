// cellPack: places many cells without overlap, according to system/pack.yaml, and writes the tables of their places
// that system/mesh.yaml names.
//
//     system/mesh.yaml:  cells:
//                          - {name: redCell, cell: healthyRBC, edge: 0.9 dx, table: constant/redCells.csv}
//     system/pack.yaml:  cells:
//                          - {name: redCell, haematocrit: 0.3}
//     cellPack; membraneMesh; particleFill; dmpFlow
//
// Cells and rigid bodies that already have a place stay there; the packed cells keep clear of them, of each other and
// of walls (packing/packing.hpp).
//
// Sample runs:
//     cellPack -case blood
//     cellPack -set 'system/pack.yaml:/seed=2'
#include <Eigen/Eigenvalues>
#include <chrono>
#include <cmath>
#include <iostream>
#include <nlohmann/json.hpp>

#include "../cellMeshes.hpp"
#include "core/machineMemory.hpp"
#include "geometry/enclosedVolume.hpp"
#include "packing/packSettings.hpp"
#include "packing/packing.hpp"
#include "simulation/dictionaries.hpp"
#include "simulation/placement.hpp"
#include "simulation/placesTable.hpp"
#include "simulation/size.hpp"

using namespace corpuscle;
using geometry::TriangleMesh;
using simulation::CellTypeSettings;

namespace {

constexpr const char *packFile = "system/pack.yaml", *meshFile = "system/mesh.yaml";

// A case whose tables have not been written yet, with the settings of their contents.
struct Input {
    simulation::Case scene;
    packing::PackSettings pack;
    std::vector<std::size_t> entries;  // indices in system/mesh.yaml of the types that are packed
};

// Adds the problems of one file, so that those of both files are reported together.
void join(Problems& problems, const CaseError& error) {
    for (const Problem& p : error.problems()) problems.add(p.mark, p.key, p.message);
    problems.addUncounted(error.more());
}

// For each type of system/pack.yaml, its entry in system/mesh.yaml, which must name the table to be written.
std::vector<std::size_t> findEntries(const simulation::Case& scene, const packing::PackSettings& pack, const Node& node,
                                     Problems& problems) {
    const std::vector<CellTypeSettings>& types = scene.mesh.cells;
    std::vector<std::string> names;
    names.reserve(types.size());
    for (const CellTypeSettings& type : types) names.push_back(type.name);
    std::vector<std::size_t> entries;
    std::map<std::string, std::string> tables;  // each table, with the type that writes it
    for (std::size_t i = 0; i < pack.cells.size(); ++i) {
        const std::string& name = pack.cells[i].name;
        const Node& key = *node.find("cells")->items[i].find("name");
        const auto at = static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
        const std::string entry = fmt::format("cells[{}]", at);
        if (at == names.size())
            problems.add(key.mark, key.path,
                         fmt::format("found '{}', which is no cell of {}; there are: {}.{}", name, meshFile,
                                     names.empty() ? "none" : joinWords(names), didYouMean(name, names)));
        else if (std::find(entries.begin(), entries.end(), at) != entries.end())
            problems.add(key.mark, key.path, fmt::format("'{}' is named twice; keep one", name));
        else if (!types[at].table)
            problems.add(key.mark, key.path,
                         fmt::format("'{0}' has no table in {1} that could be written; give it one in place of its "
                                     "'centre' or 'places', such as 'table: constant/{0}.csv'",
                                     name, meshFile));
        else if (const std::filesystem::path table = *types[at].table;
                 table.extension() != ".csv" && table.extension() != ".vtp")
            problems.add({meshFile, 0, 0}, entry + ".table",
                         fmt::format("found '{}'; a file that ends in .csv or .vtp is needed", table.string()));
        else if (const auto [other, isNew] = tables.try_emplace(table.lexically_normal().string(), name); !isNew)
            problems.add({meshFile, 0, 0}, entry + ".table",
                         fmt::format("found '{}', which is the table of '{}' too; give each its own", table.string(),
                                     other->second));
        entries.push_back(at);
    }
    if (pack.cells.empty())
        problems.add(node.find("cells")->mark, "cells",
                     "found no types; name at least one, such as '- {name: redCell, "
                     "haematocrit: 0.3}'");
    return entries;
}

Input readInput(const Application& app) {
    Problems problems;
    Input input;
    const Node node = app.dictionary(packFile, problems);
    if (problems.empty()) input.pack = read<packing::PackSettings>(node, problems);
    std::set<std::string> unplaced;
    for (const packing::PackedTypeSettings& type : input.pack.cells) unplaced.insert(type.name);
    try {
        input.scene = simulation::Case::read(app, unplaced);
    } catch (const CaseError& error) {
        join(problems, error);
    }
    problems.throwIfAny();
    input.scene.files[packFile] = node;
    input.entries = findEntries(input.scene, input.pack, node, problems);
    input.scene.throwIfAny(problems);
    return input;
}

class CellPack {
  public:
    CellPack(Application& app, Input input) : app_(app), input_(std::move(input)) {}

    void run() {
        meshAll();
        const double gap = input_.pack.gap.metres(scene().spacing());
        packing::Packing packing(types_, space(), gap);
        announce(gap);
        const auto begin = std::chrono::steady_clock::now();
        const std::vector<packing::Pose> poses =
            packing.pack(static_cast<std::uint64_t>(input_.pack.seed), [&](const packing::Packing::Progress& now) {
                app_.log().info("  {:.3f} of their size, {} contacts{}", now.scale, now.contacts, apart(now.leastGap));
            });
        const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
        app_.log().info("at full size after {} steps in {:.3g} s{}", packing.progress().iterations, seconds.count(),
                        apart(packing.progress().leastGap));
        place(poses);
        requireClear();
        write();
        app_.log().info("Next: membraneMesh, particleFill");
        if (app_.json()) std::cout << json_.dump(2) << '\n';
    }

  private:
    const simulation::Case& scene() const { return input_.scene; }
    CellTypeSettings& entryOf(std::size_t type) { return input_.scene.mesh.cells[input_.entries[type]]; }

    static std::string apart(double gap) {
        return std::isfinite(gap) ? fmt::format(", surfaces at least {} apart", formatQuantity(gap, unit::metre)) : "";
    }

    void meshAll() {
        for (const CellTypeSettings& cell : scene().mesh.cells) {
            meshes_.push_back(geometry::meshEnclosing(*cell.shape, cell.edge, cell.enclosesExactly()));
            utilities::place(meshes_.back(), cell);
        }
        for (const simulation::BodyPlaceSettings& body : scene().mesh.bodies) {
            bodies_.push_back(geometry::meshEnclosing(*body.shape, body.edge, body.enclosesExactly()));
            utilities::place(bodies_.back(), body);
        }
        Problems problems;
        for (std::size_t t = 0; t < input_.pack.cells.size(); ++t) {
            const packing::PackedTypeSettings& wanted = input_.pack.cells[t];
            const TriangleMesh& mesh = meshes_[input_.entries[t]];
            const std::size_t number = numberOf(wanted, mesh, fmt::format("cells[{}]", t), problems);
            types_.push_back(
                {packing::RoughSurface::of(*entryOf(t).shape, mesh), number, wanted.orientation.model.get()});
        }
        scene().throwIfAny(problems);
    }

    std::size_t numberOf(const packing::PackedTypeSettings& wanted, const TriangleMesh& mesh, const std::string& key,
                         Problems& problems) const {
        constexpr double perNode = 400;  // bytes: places, velocities, adjacent triangles, share of contacts
        const double number = wanted.number ? static_cast<double>(*wanted.number)
                                            : std::round(*wanted.haematocrit * scene().fluidVolume() / mesh.volume());
        const double bytes = number * perNode * static_cast<double>(mesh.nodes.size());
        if (const std::string shortage = memoryShortage(app_.communicator(), bytes); !shortage.empty()) {
            problems.add(
                {packFile, 0, 0}, key + (wanted.number ? ".number" : ".haematocrit"),
                fmt::format("{}. {} cells of {} nodes are too many for it: take fewer cells, a smaller box, or "
                            "a larger edge",
                            shortage, simulation::countText(number), mesh.nodes.size()));
            return 1;
        }
        if (number < 1)
            problems.add({packFile, 0, 0}, key + ".haematocrit",
                         fmt::format("found {}, which is {:.2g} cells in this box; give a 'number', or a larger box",
                                     *wanted.haematocrit, *wanted.haematocrit * scene().fluidVolume() / mesh.volume()));
        return static_cast<std::size_t>(std::max(number, 1.0));
    }

    packing::Packing::Space space() const {
        const particles::Box box = scene().fluidBox();
        packing::Packing::Space space{box.low,           box.high,           scene().fluidVolume(),
                                      box.periodicity(), scene().flow.walls, bodies_};
        for (std::size_t c = 0; c < meshes_.size(); ++c) {
            if (std::find(input_.entries.begin(), input_.entries.end(), c) != input_.entries.end()) continue;
            for (const geometry::Place& place : scene().mesh.cells[c].placed)
                space.fixed.push_back({place.of(meshes_[c].nodes), meshes_[c].triangles});
        }
        return space;
    }

    void announce(double gap) {
        for (std::size_t t = 0; t < types_.size(); ++t) {
            const double share =
                static_cast<double>(types_[t].number) * meshes_[input_.entries[t]].volume() / scene().fluidVolume();
            app_.log().info("{}: {} cells, {:.4g} of the fluid's volume, {}", entryOf(t).name, types_[t].number, share,
                            input_.pack.cells[t].orientation.name);
            json_[entryOf(t).name] = {{"number", types_[t].number}, {"haematocrit", share}};
        }
        app_.log().info("surfaces at least {} apart, seed {}", formatQuantity(gap, unit::metre), input_.pack.seed);
    }

    void place(const std::vector<packing::Pose>& poses) {
        for (std::size_t t = 0; t < types_.size(); ++t) entryOf(t).placed.clear();
        for (const packing::Pose& pose : poses) entryOf(pose.kind).placed.push_back({pose.centre, pose.axis, 1});
    }

    // Checks by the method that the later programs use.
    void requireClear() const {
        const std::vector<TriangleMesh> cells = utilities::placedCells(scene(), meshes_);
        const std::vector<Problem> faults =
            simulation::misplaced(scene(), simulation::placedOf(scene(), cells, bodies_));
        if (!faults.empty())
            throw Failure(ExitCode::numerics, "cells in place are not clear of each other: " + faults.front().text() +
                                                  ". Take a larger 'gap' in system/pack.yaml");
    }

    void write() {
        for (std::size_t t = 0; t < types_.size(); ++t) {
            const CellTypeSettings& entry = entryOf(t);
            simulation::writePlaces(app_.path(*entry.table), entry.placed);
            Mat3 axes = Mat3::Zero();
            for (const geometry::Place& place : entry.placed)
                axes += place.axis * place.axis.transpose() / static_cast<double>(entry.placed.size());
            const double order = 1.5 * Eigen::SelfAdjointEigenSolver<Mat3>(axes).eigenvalues()[2] - 0.5;
            app_.log().info(
                "{}: order parameter of the axes {:.3f} (0: all directions alike, 1: parallel), written to "
                "{}",
                entry.name, order, *entry.table);
            json_[entry.name]["order"] = order;
        }
    }

    Application& app_;
    Input input_;
    // Of each entry; centred on the origin if the entry has several places.
    std::vector<TriangleMesh> meshes_, bodies_;
    std::vector<packing::Packing::Type> types_;
    nlohmann::ordered_json json_ = nlohmann::ordered_json::object();
};

}  // namespace

int main(int argc, char* argv[]) {
    Application app("cellPack", "Puts many cells in place without overlap and writes the tables of their places.", argc,
                    argv, {.samples = {"cellPack -case blood", "cellPack -set 'system/pack.yaml:/seed=2'"}});
    return app.run([&] {
        utilities::requireSerial(app);
        app.announce();
        Input input = readInput(app);
        app.lockCase();
        app.openLog();
        simulation::refreshSchemas(app);
        CellPack(app, std::move(input)).run();
        return ExitCode::done;
    });
}
