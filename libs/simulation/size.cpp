#include "simulation/size.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "particles/isa.hpp"
#include "schemes/cost.hpp"
#include "simulation/sceneBuilder.hpp"

namespace corpuscle::simulation {

namespace {

// In bytes. Of a particle or a ghost: `plain` with explicit schemes, `corrected` in the implicit step and velocity
// Verlet on adjoint operators; `...Loaded` with membranes or bodies in the fluid.
struct MemoryCosts {
    static constexpr double program = 46e6, parallel = 6e6;  // of a rank; additional with several ranks
    static constexpr double plain = 600, plainLoaded = 730;
    static constexpr double corrected = 1150, correctedLoaded = 1500;
    static constexpr double solute = 150;    // of a particle or a ghost that carries one
    static constexpr double network = 1500;  // of a node of a mesh, with its bonds and triangles, on each rank
};

// Size of a brick if the box is cut repeatedly across its longest side.
Vec3 evenBrick(const Case& c, int ranks) {
    Vec3 brick = c.particleBox().size();
    for (int parts = ranks; parts > 1;) {
        int prime = 2;
        while (parts % prime != 0) ++prime;
        parts /= prime;
        int longest = 0;
        brick.maxCoeff(&longest);
        brick[longest] /= prime;
    }
    return brick;
}

// Number of ghosts of a rank over the number of its own particles: the volume within `reach` around an even brick over
// that of the brick. No ghosts lie beyond a wall.
double ghostShare(const Case& c, int ranks, double reach) {
    const Vec3 box = c.particleBox().size(), brick = evenBrick(c, ranks);
    double share = 1;
    for (int k = 0; k < 3; ++k) {
        const double outer = c.hasWallsAcross(k) ? 2 * brick[k] / box[k] : 0;  // faces at walls
        share *= 1 + (2 - outer) * reach / brick[k];
    }
    return share - 1;
}

// Mean number of ranks that hold a cell of this radius.
double holdersOf(const Case& c, int ranks, double radius) {
    const Vec3 box = c.particleBox().size(), brick = evenBrick(c, ranks);
    const double margin = cellMargin(c, c.skin());
    double holders = 1;
    for (int k = 0; k < 3; ++k)
        holders *= std::min(std::round(box[k] / brick[k]), 1 + 2 * (radius + margin) / brick[k]);
    return holders;
}

double memoryOf(const Case& c, int ranks) {
    const double n = estimateParticles(c).all(), reach = c.support() + c.skin();
    const bool corrected = c.scheme().traits().isAdjoint, loaded = !c.mesh.cells.empty() || !c.mesh.bodies.empty();
    const double each = (corrected ? (loaded ? MemoryCosts::correctedLoaded : MemoryCosts::corrected)
                                   : (loaded ? MemoryCosts::plainLoaded : MemoryCosts::plain)) +
                        (c.fluid.solute ? MemoryCosts::solute : 0);
    const double across = reach / c.spacing() + 1, around = 4.2 * across * across * across;
    const double list = 0.65 * 1.5 * sizeof(int) * around / particles::blockLanes(c.precision());
    const double nodeMemory = c.scheme().traits().nodeMemory;
    double nodes = 0;
    for (const CellTypeSettings& cell : c.mesh.cells) {
        const double each = estimateNodes(cell), count = static_cast<double>(cell.placed.size());
        nodes += each * (MemoryCosts::network * ranks +
                         nodeMemory * count * holdersOf(c, ranks, cell.largestScale() * cell.shape->radius()));
    }
    return ranks * (MemoryCosts::program + (ranks > 1 ? MemoryCosts::parallel : 0)) +
           n * (list + each * (1 + ghostShare(c, ranks, reach))) + nodes;
}

double writesOf(const Case& c) {
    const WriteSettings& w = c.control.write;
    const double time = c.duration(), strain = c.flow.shearRate * time;
    if (w.strain) return std::floor(strain / *w.strain) + 1;
    if (w.time) return std::floor(time / *w.time) + 1;
    if (w.steps)
        for (const schemes::IntegratorCost& cost : schemes::predictCosts(c.written, c.facts()))
            if (cost.name == c.numerics.integrator) return std::floor(cost.steps / static_cast<double>(*w.steps)) + 1;
    return 0;
}

}  // namespace

std::string countText(double count) { return fmt::format(fmt::runtime(count < 1e15 ? "{:.0f}" : "{:.3g}"), count); }

// A node has the area of its hexagon, sqrt(3)/2 edge^2.
double estimateNodes(const CellSettings& cell) {
    return std::round(cell.shape->area() / (std::numbers::sqrt3 / 2 * cell.edge * cell.edge));
}

ParticleEstimate estimateLattice(const Case& c) {
    ParticleEstimate n;
    n.fluid = std::round(c.fluidVolume() / c.particleVolume());
    if (const boundary::WallShape* const walls = c.flowModel->walls())
        n.walls = std::round(walls->volumeBehind(c.fluidBox(), c.wallDepth()) / c.particleVolume());
    return n;
}

ParticleEstimate estimateParticles(const Case& c) {
    ParticleEstimate n = estimateLattice(c);
    if (!c.numerics.isImmersed())  // immersed nodes are not particles
        for (const CellTypeSettings& cell : c.mesh.cells) {
            // Nodes that are particles replace fluid of the volume area x dx.
            double squares = 0;
            for (const geometry::Place& place : cell.placed) squares += place.scale * place.scale;
            n.nodes += estimateNodes(cell) * static_cast<double>(cell.placed.size());
            n.fluid -= std::round(squares * cell.shape->area() * c.spacing() / c.particleVolume());
        }
    for (const BodyPlaceSettings& body : c.mesh.bodies) {
        const double inside = std::round(body.shape->volume() / c.particleVolume());
        n.bodies += inside;
        n.fluid -= inside;
    }
    return n;
}

SizeEstimate estimateSize(const Case& c, int ranks) {
    constexpr double place = 38, component = 7.5, perNode = 170;  // compressed; perNode: a node with its two triangles
    double state = 137, nodeState = 100;                          // of a checkpoint
    const ParticleEstimate particles = estimateParticles(c);
    const double n = particles.all(), written = n - particles.walls;
    double components = 0;
    for (const std::string& field : c.control.write.fields) components += field == "velocity" ? 3 : 1;
    double nodes = 0;
    for (const CellTypeSettings& cell : c.mesh.cells)
        nodes += estimateNodes(cell) * static_cast<double>(cell.placed.size());
    SizeEstimate size;
    size.memory = memoryOf(c, ranks);
    size.perWrite = written * (place + component * components) + nodes * perNode;
    if (c.fluid.solute) state += sizeof(double), nodeState += sizeof(double);
    size.checkpoint = n * state + nodes * nodeState;
    size.writes = writesOf(c);
    return size;
}

}  // namespace corpuscle::simulation
