// particleFill: fills the box of a case with particles, around the cells and inside the rigid bodies of 0/, and writes
// 0/fluid.vtp, 0/walls.vtp and 0/bodies.vtp.
//
// Particles start on a cubic lattice, with wall layers as deep as the kernel reaches. With the dual identity the nodes
// of a membrane are particles too, of one spacing thickness: as many fluid particles as make up the nodes' volume are
// removed, those nearest to the nodes, so that each cell stays filled to its volume. With immersed coupling nodes lie
// between the fluid particles: no particle is removed, and particles nearer than 0.05 dx to a membrane are moved away
// to that distance (noFlux.hpp). A rigid body takes the lattice points deepest inside it, as many as make up its
// volume. The remaining particles are given their side (0 outside, n inside cell n). With the dual identity they are
// made more uniform around membranes (relaxation.hpp). They start with the velocity and pressure of the flow.
//
// Sample runs:
//     particleFill -case tutorials/rbcShear/Ca0.02
//     particleFill -case tutorials/rbcShear/Ca0.02 -set system/mesh.yaml:/fill/relaxation=0
#include <sys/resource.h>

#include <chrono>
#include <iostream>
#include <nlohmann/json.hpp>
#include <numeric>

#include "../cellMeshes.hpp"
#include "bodyFill.hpp"
#include "coupling/noFlux.hpp"
#include "geometry/latticeFill.hpp"
#include "relaxation.hpp"
#include "simulation/dictionaries.hpp"
#include "simulation/memoryLimit.hpp"
#include "simulation/sceneBuilder.hpp"

using namespace corpuscle;
using geometry::TriangleMesh;
using simulation::Case;

namespace {

struct Filling {
    std::vector<Vec3> fluid, walls, bodies;
    std::vector<int> side;  // side of each fluid particle
    std::vector<int> body;  // number of the body, from 1, of each body particle
    double nodeVolume = 0;  // of all membranes [m^3]
    std::size_t nodes = 0, carved = 0, movedBack = 0, heldOff = 0;
    double longestMove = 0;  // longest displacement by the relaxation [m]
    utilities::Evenness before, after;
};

// Removes `carved` particles, always those nearest to the nodes: inside each cell as many as exceed the cell's volume
// less the inner half of its nodes, and the rest outside.
void takeOut(const Case& input, const std::vector<TriangleMesh>& cells, Filling& f) {
    std::vector<std::vector<int>> members(cells.size() + 1);
    for (std::size_t i = 0; i < f.side.size(); ++i)
        members[static_cast<std::size_t>(f.side[i])].push_back(static_cast<int>(i));
    std::vector<char> kept(f.fluid.size(), 1);
    const auto carve = [&](const std::vector<int>& from, const std::vector<Vec3>& nodes, std::size_t count) {
        std::vector<Vec3> points;
        points.reserve(from.size());
        for (const int i : from) points.push_back(f.fluid[static_cast<std::size_t>(i)]);
        for (const int k : geometry::carve(points, nodes, count, input.fluidBox().periodicity()))
            kept[static_cast<std::size_t>(from[static_cast<std::size_t>(k)])] = 0;
    };
    std::vector<Vec3> nodes;
    std::size_t left = f.carved;
    for (std::size_t c = 0; c < cells.size(); ++c) {
        const std::vector<int>& inside = members[c + 1];
        const double room = (cells[c].volume() - 0.5 * cells[c].area() * input.spacing()) / input.particleVolume();
        const long surplus = static_cast<long>(inside.size()) - std::max(0L, std::lround(room));
        const std::size_t count = std::min(left, static_cast<std::size_t>(std::max(0L, surplus)));
        carve(inside, cells[c].nodes, count);
        left -= count;
        nodes.insert(nodes.end(), cells[c].nodes.begin(), cells[c].nodes.end());
    }
    carve(members[0], nodes, left);
    std::size_t count = 0;
    for (std::size_t i = 0; i < f.fluid.size(); ++i)
        if (kept[i]) f.fluid[count] = f.fluid[i], f.side[count++] = f.side[i];
    f.fluid.resize(count);
    f.side.resize(count);
}

// Moves the particles inside each body from the fluid to the body.
void fillBodies(const Case& input, const std::vector<TriangleMesh>& bodies, Filling& f) {
    if (bodies.empty()) return;
    const std::vector<int> body = utilities::bodyOfEach(input, bodies, f.fluid);
    std::size_t left = 0;
    for (std::size_t i = 0; i < body.size(); ++i)
        if (body[i] > 0)
            f.bodies.push_back(f.fluid[i]), f.body.push_back(body[i]);
        else
            f.fluid[left] = f.fluid[i], f.side[left++] = f.side[i];
    f.fluid.resize(left);
    f.side.resize(left);
}

// Places particles on the lattice; points taken by bodies and displaced by nodes are removed from the fluid.
Filling placeParticles(const Case& input, const std::vector<TriangleMesh>& cells,
                       const std::vector<TriangleMesh>& bodies) {
    geometry::LatticeBox box;
    box.size = input.mesh.domain.size;
    box.spacing = input.spacing();
    box.jitter = *input.mesh.fill.jitter;
    box.seed = static_cast<std::uint64_t>(input.mesh.fill.seed);
    if (const boundary::Walls& walls = input.flow.walls; walls.exist()) {
        for (int k = 0; k < 3; ++k)
            if (input.hasWallsAcross(k)) box.layers[static_cast<std::size_t>(k)] = input.wallLayers();
        box.kindOf = [&walls, depth = input.wallDepth().maxCoeff()](const Vec3& x) {
            const double distance = walls.distance(x);
            return distance > 0        ? geometry::PointKind::fluid
                   : distance > -depth ? geometry::PointKind::wall
                                       : geometry::PointKind::nothing;
        };
    }
    const geometry::Lattice lattice = geometry::fillLattice(box);
    Filling f;
    for (std::size_t i = 0; i < lattice.points.size(); ++i)
        if (lattice.kinds[i] == geometry::PointKind::fluid)
            f.fluid.push_back(input.particleBox().periodicity().wrap(lattice.points[i]));
        else
            f.walls.push_back(lattice.points[i]);

    if (!input.numerics.isImmersed())
        for (const TriangleMesh& cell : cells) {
            for (const double volume : simulation::nodeVolumes(cell.vertexAreas(), input.spacing()))
                f.nodeVolume += volume;
            f.nodes += cell.nodes.size();
        }
    f.carved = static_cast<std::size_t>(std::lround(f.nodeVolume / input.particleVolume()));
    f.side = geometry::tagSides(f.fluid, cells, input.fluidBox().periodicity());
    fillBodies(input, bodies, f);
    if (input.numerics.isImmersed()) {
        f.heldOff =
            geometry::holdOff(f.fluid, f.side, cells, coupling::NoFlux::leastDistanceInSpacings * input.spacing(),
                              input.fluidBox().periodicity());
        for (Vec3& x : f.fluid) x = input.particleBox().periodicity().wrap(x);
    } else {
        takeOut(input, cells, f);
    }
    return f;
}

// A particle that would change its side or leave the fluid is moved back to its original position.
void relax(const Case& input, MPI_Comm comm, const std::vector<TriangleMesh>& cells, Filling& f) {
    std::vector<Vec3> fixed = f.walls;
    fixed.insert(fixed.end(), f.bodies.begin(), f.bodies.end());
    utilities::Relaxation relaxation(input, comm, f.fluid, fixed, cells);
    f.before = f.after = relaxation.evenness();
    if (input.mesh.fill.relaxation == 0) return;
    for (long k = 0; k < input.mesh.fill.relaxation; ++k) relaxation.sweep();
    f.after = relaxation.evenness();
    const auto moved = relaxation.moved();
    std::vector<Vec3> places;
    places.reserve(moved.size());
    for (const auto& [i, x] : moved) places.push_back(x);
    const std::vector<int> side = geometry::tagSides(places, cells, input.fluidBox().periodicity());
    const particles::Box fluidBox = input.fluidBox();
    for (std::size_t k = 0; k < moved.size(); ++k) {
        const auto& [i, x] = moved[k];
        if (side[k] != f.side[i] || particles::distanceSquared(x, fluidBox.low, fluidBox.high) > 0 ||
            input.flow.walls.distance(x) <= 0) {
            ++f.movedBack;
            continue;
        }
        f.longestMove = std::max(f.longestMove, fluidBox.periodicity().shortest(x - f.fluid[i]).norm());
        f.fluid[i] = x;
    }
}

io::PolyData withState(const Case& input, const std::vector<Vec3>& points, const std::vector<int>& side,
                       std::int64_t firstId, const std::function<Vec3(const Vec3&)>& velocity,
                       const std::function<double(const Vec3&)>& pressure) {
    const sph::FluidModel model = input.fluidModel();
    io::PolyData data;
    data.points = points;
    auto& id = data.point.integers["id"];
    id.resize(points.size());
    std::iota(id.begin(), id.end(), firstId);
    data.point.integers["side"].assign(side.begin(), side.end());
    data.point.scalars["spacing"].assign(points.size(), input.spacing());
    for (const Vec3& x : points) {
        const double density = model.equationOfState->density(pressure(x), model.density, model.soundSpeed);
        data.point.vectors["velocity"].push_back(velocity(x));
        data.point.scalars["density"].push_back(density);
        data.point.scalars["pressure"].push_back(
            model.equationOfState->pressure(density, model.density, model.soundSpeed));
    }
    return data;
}

void writeBodies(const Case& input, const Filling& f) {
    if (f.bodies.empty()) {
        std::filesystem::remove(simulation::startFile(input, "bodies"));
        return;
    }
    io::PolyData data;
    data.points = f.bodies;
    data.point.integers["body"].assign(f.body.begin(), f.body.end());
    data.point.scalars["spacing"].assign(f.bodies.size(), input.spacing());
    simulation::writeStart(input, "bodies", std::move(data));
}

void write(const Case& input, const Filling& f) {
    writeBodies(input, f);
    simulation::writeStart(
        input, "fluid",
        withState(
            input, f.fluid, f.side, 0, [&](const Vec3& x) { return input.flow.undisturbed(x); }, input.flow.pressure));
    if (f.walls.empty()) {
        std::filesystem::remove(simulation::startFile(input, "walls"));
        return;
    }
    const boundary::Walls& walls = input.flow.walls;
    simulation::writeStart(
        input, "walls",
        withState(
            input, f.walls, std::vector<int>(f.walls.size(), 0), static_cast<std::int64_t>(f.fluid.size()),
            [&](const Vec3& x) { return walls.nearest(x).velocityAt(x); }, [](const Vec3&) { return 0.0; }));
}

double peakMemory() {  // peak memory of this program so far [MiB]
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<double>(usage.ru_maxrss) / 1024;
}

std::string text(const utilities::Spread& s) { return fmt::format("{:.4f} +- {:.4f}", s.mean, s.deviation); }

void report(Application& app, const Case& input, const std::vector<TriangleMesh>& cells, const Filling& f,
            double seconds) {
    Log& log = app.log();
    const double V = input.particleVolume();
    nlohmann::ordered_json json{
        {"fluid", f.fluid.size()}, {"walls", f.walls.size()}, {"nodes", f.nodes}, {"carved", f.carved}};
    std::vector<long> inside(cells.size() + 1, 0);
    for (const int side : f.side) ++inside[static_cast<std::size_t>(side)];
    std::vector<std::vector<std::string>> rows{{"fluid, outside", std::to_string(inside[0]), ""}};
    json["outside"] = inside[0];
    std::size_t c = 0;
    for (const simulation::CellTypeSettings& type : input.mesh.cells) {
        double volume = 0, nodes = 0;
        long particles = 0;
        for (const std::size_t end = c + type.placed.size(); c < end; ++c) {
            volume += cells[c].volume();
            nodes += input.numerics.isImmersed() ? 0 : cells[c].area() * input.spacing();
            particles += inside[c + 1];
        }
        const std::size_t count = type.placed.size();
        const double filled = (static_cast<double>(particles) * V + 0.5 * nodes) / volume;
        rows.push_back({"fluid, in " + (count > 1 ? fmt::format("{} cells {}", count, type.name) : type.name),
                        std::to_string(particles),
                        fmt::format("with half the nodes {:.2f} % of the {} volume", 100 * filled,
                                    count > 1 ? "cells'" : "cell's")});
        json["inside"][type.name] = {{"particles", particles}, {"filled", filled}};
    }
    rows.push_back({"walls", std::to_string(f.walls.size()), fmt::format("{} layers each", input.wallLayers())});
    if (f.nodes > 0) {
        const double mean = f.nodeVolume / static_cast<double>(f.nodes) / V;
        rows.push_back({"membrane nodes", std::to_string(f.nodes),
                        fmt::format("{:.3f} dx^3 each, in place of {} fluid particles", mean, f.carved)});
        json["nodeVolume_dx3"] = mean;
    }
    for (std::size_t b = 0; b < input.mesh.bodies.size(); ++b) {
        const auto number = std::count(f.body.begin(), f.body.end(), static_cast<int>(b) + 1);
        rows.push_back({"body " + input.mesh.bodies[b].name, std::to_string(number), ""});
        json["bodies"][input.mesh.bodies[b].name] = number;
    }
    if (f.heldOff > 0) {
        rows.push_back({"near membranes", std::to_string(f.heldOff),
                        fmt::format("moved out to {} dx", coupling::NoFlux::leastDistanceInSpacings)});
        json["heldOff"] = f.heldOff;
    }
    rows.push_back({"all", std::to_string(f.fluid.size() + f.walls.size() + f.bodies.size() + f.nodes), ""});
    log.table({"particles", "number", ""}, rows);

    if (f.nodes > 0) {
        const long sweeps = input.mesh.fill.relaxation;
        log.table(
            {"sigma = sum V W of the fluid", "particles", "carved lattice", fmt::format("after {} sweeps", sweeps)},
            {{"nearer than 4 dx to a membrane", std::to_string(f.before.near.count), text(f.before.near),
              text(f.after.near)},
             {"beyond, up to H_s farther", std::to_string(f.before.beyond.count), text(f.before.beyond),
              text(f.after.beyond)}});
        log.info("relaxation: moved at most {:.3f} dx; {} particles moved back that would have changed side",
                 f.longestMove / input.spacing(), f.movedBack);
        const auto spread = [](const utilities::Spread& s) {
            return nlohmann::ordered_json{{"mean", s.mean}, {"deviation", s.deviation}};
        };
        json["sigma"] = {{"nearBefore", spread(f.before.near)},
                         {"nearAfter", spread(f.after.near)},
                         {"beyondBefore", spread(f.before.beyond)},
                         {"beyondAfter", spread(f.after.beyond)}};
        json["movedBack"] = f.movedBack;
    }
    json["seconds"] = seconds;
    json["memory_MiB"] = peakMemory();
    log.info("0/fluid.vtp{}{} written in {:.2f} s with {:.0f} MiB", f.walls.empty() ? "" : ", 0/walls.vtp",
             f.bodies.empty() ? "" : ", 0/bodies.vtp", seconds, peakMemory());
    if (app.json()) std::cout << json.dump(2) << '\n';
}

}  // namespace

int main(int argc, char* argv[]) {
    Application app("particleFill",
                    "Fills the box and the rigid bodies of a case with particles and writes them to 0/.", argc, argv,
                    {.samples = {"particleFill -case tutorials/rbcShear/Ca0.02",
                                 "particleFill -set system/mesh.yaml:/fill/relaxation=0"}});
    return app.run([&] {
        utilities::requireSerial(app);
        app.announce();
        const auto begin = std::chrono::steady_clock::now();
        const Case input = Case::read(app);
        simulation::requireMemory(app.communicator(), input);
        simulation::requireStartWritable(app.communicator(), input);
        app.lockCase();
        const std::vector<TriangleMesh> cells = utilities::placedCells(input, utilities::readCellMeshes(input));
        const std::vector<TriangleMesh> bodies = utilities::readBodyMeshes(input);
        utilities::requireClear(input, cells, bodies);
        app.openLog();
        simulation::refreshSchemas(app);
        if (const boundary::WallShape* const walls = input.flowModel->walls())
            for (const std::string& remark : walls->remarks()) app.log().info("{}", remark);
        Filling filling = placeParticles(input, cells, bodies);
        if (!cells.empty() && !input.numerics.isImmersed()) relax(input, app.communicator().handle(), cells, filling);
        write(input, filling);
        report(app, input, cells, filling,
               std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
        return ExitCode::done;
    });
}
