#include "simulation/stateCheck.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/communicator.hpp"
#include "core/together.hpp"
#include "geometry/crossings.hpp"
#include "geometry/triangleMesh.hpp"

namespace corpuscle::simulation {

using coupling::Cell;
using coupling::Scene;
using membrane::Bond;
using membrane::Membrane;
using particles::Kind;

namespace {

constexpr double largestDensityChange = 0.3, largestSpeedUp = 10, largestVolumeChange = 1.0 / 3;
constexpr double largestBondChange = 0.3;  // of ln l between two checks
constexpr double sharpestFold = -0.5;      // cosine between the normals of neighbours
constexpr double beyondWall = 2;           // spacings
constexpr double mostPeriods = 3;          // largest length of a surface, in periods of the box
constexpr const char* noContact =
    "nothing but fluid keeps them apart: give cells contact by constant/contact.yaml, for example 'law: {type: "
    "barrier, "
    "reach: 0.1 um, strength: 5e-5 N/m}' (docs/contact.md)";
constexpr const char* isPassedBy =
    "the contact of constant/contact.yaml, which cells have with cells and walls, has not kept them apart";
constexpr const char* tooShort = "the box is too short for it";
constexpr long stepsBetweenExact = 50, leastBetweenExact = 5;  // in checks, without suspicion and with it

double length(const Membrane& m, const Bond& bond) {
    return (m.position[static_cast<std::size_t>(bond.node[1])] - m.position[static_cast<std::size_t>(bond.node[0])])
        .norm();
}

std::string words(const Vec3& x) { return fmt::format("({:.4g}, {:.4g}, {:.4g}) m", x[0], x[1], x[2]); }

}  // namespace

StateCheck::StateCheck(const Case& input, const Scene& scene) : input_(input) {
    particles_ = Communicator(scene.system->comm()).sum(static_cast<long>(scene.system->owned()));
    take(scene);
}

void StateCheck::take(const Scene& scene) {
    const auto& s = scene.store();
    double most = 0;
    for (std::size_t i = 0; i < s.size(); ++i) most = std::max(most, s.velocity(i).squaredNorm());
    fastest2_ = Communicator(scene.system->comm()).max(most);
    watched_.clear();
    for (const Cell& cell : scene.cells) compareBonds(cell.membrane, watched_[cell.membrane.cell].lengths);
}

Fault StateCheck::find(const Scene& scene, const Time& time) {
    ++lookedAt_;
    const MPI_Comm comm = scene.system->comm();
    const Communicator ranks(comm);
    double fastest2 = 0;
    Fault fault = ofParticles(scene, time, fastest2);
    std::erase_if(watched_, [&](const auto& entry) { return !scene.cells.find(entry.first); });
    for (const Cell& cell : scene.cells)
        if (!fault) fault = ofCell(scene, cell, time);
    if (!fault) fault = ofSurfaces(scene, time);
    // Surfaces that meet are taken for the cause only if nothing else is wrong on any rank: a node that was thrown out
    // of its place may cross another cell.
    const double own = !fault ? 0 : fault.isGeometric ? 1 : 2;
    const std::vector<double> most = ranks.max({own, fastest2});
    const long count = ranks.sum(static_cast<long>(scene.system->owned()));
    if (most[0] > 0) {
        const int first = firstFailed(comm, own == most[0], fault.text);
        MPI_Bcast(fault.place.data(), 3, MPI_DOUBLE, first, comm);
        fault.isGeometric = most[0] == 1;
        return fault;
    }
    if (count != particles_)
        return {fmt::format("step {}, t = {:.6g} s: there are {} particles, at the start there were {}", time.step,
                            time.t, count, particles_),
                Vec3::Zero()};
    fastest2_ = most[1];
    return {};
}

Fault StateCheck::ofParticles(const Scene& scene, const Time& time, double& fastest2) const {
    const auto& s = scene.store();
    const sph::FluidModel& model = scene.model();
    const double scale2 = std::max(fastest2_, input_.flow.speed * input_.flow.speed);
    const double far = std::min(0.5 * scene.spacing / time.dt, model.soundSpeed);
    const double tooFast2 = std::max(largestSpeedUp * largestSpeedUp * scale2, far * far);
    const boundary::Walls& walls = model.walls;
    const double reserve = beyondWall * scene.spacing;
    for (std::size_t i = 0; i < s.size(); ++i) {
        const Vec3 x = s.position(i), u = s.velocity(i);
        const double change = std::abs(s.density[i] / model.density - 1);
        const double speed2 = u.squaredNorm();
        fastest2 = std::max(fastest2, speed2);
        const bool isDense = change < largestDensityChange, isSlow = speed2 <= tooFast2;
        const bool isInside = s.kindOf(i) == Kind::wall || walls.distance(x) > -reserve;
        if (isDense && isSlow && isInside && x.allFinite()) continue;
        const char* const what =
            isDense && isSlow && x.allFinite() ? "is lost beyond a wall" : "shows that the run has diverged";
        return {
            fmt::format(
                "step {}, t = {:.6g} s: particle {} at {} has density {:.4g} kg/m^3 (rest density {:.4g}) and velocity "
                "({:.3g}, {:.3g}, {:.3g}) m/s (fastest before {:.3g}): it {}",
                time.step, time.t, s.id[i], words(x), s.density[i], model.density, u[0], u[1], u[2],
                std::sqrt(fastest2_), what),
            x};
    }
    return {};
}

bool StateCheck::isSuspicious(const Membrane& m) const {
    const membrane::Network& network = m.network();
    const std::vector<Index3>& triangles = network.triangles();
    std::vector<Vec3> normals(triangles.size());
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        const Vec3 &a = m.position[static_cast<std::size_t>(triangles[t][0])],
                   &b = m.position[static_cast<std::size_t>(triangles[t][1])],
                   &c = m.position[static_cast<std::size_t>(triangles[t][2])];
        normals[t] = (b - a).cross(c - a).normalized();
    }
    return std::any_of(network.bonds().begin(), network.bonds().end(), [&](const Bond& bond) {
        const auto& [left, right] = network.bondTriangles(bond.number);
        return left >= 0 && right >= 0 &&
               normals[static_cast<std::size_t>(left)].dot(normals[static_cast<std::size_t>(right)]) < sharpestFold;
    });
}

// The first bond whose length has changed too much since the last check, null if there is none; stores the present
// lengths. If no lengths are stored yet, nothing is compared.
const Bond* StateCheck::compareBonds(const Membrane& m, std::vector<double>& lengths) {
    const bool isFirst = lengths.empty();
    lengths.resize(m.network().allBonds().size());
    for (const Bond& bond : m.network().bonds()) {
        double& before = lengths[static_cast<std::size_t>(bond.number)];
        const double now = length(m, bond);
        if (!isFirst && !(std::abs(std::log(now / before)) <= largestBondChange)) return &bond;
        before = now;
    }
    return nullptr;
}

Fault StateCheck::ofCell(const Scene& scene, const Cell& cell, const Time& time) {
    const Membrane& m = cell.membrane;
    Watched& watched = watched_[m.cell];
    const auto when = [&] {
        return fmt::format("step {}, t = {:.6g} s: the membrane '{}' ", time.step, time.t, m.name);
    };
    if (const Bond* bond = compareBonds(m, watched.lengths)) {
        const Vec3& x = m.position[static_cast<std::size_t>(bond->node[0])];
        return {
            when() + fmt::format(
                         "at {}: a bond of {:.3g} m is {:.3g} m long after a step: a node was thrown out of its place",
                         words(x), watched.lengths[static_cast<std::size_t>(bond->number)], length(m, *bond)),
            x};
    }
    if (m.network().isOpen()) return {};
    const Vec3& first = m.position.front();
    if (const double change = m.volume() / cell.initialVolume - 1; !(std::abs(change) < largestVolumeChange))
        return {when() + fmt::format("encloses {:+.0f} % of its volume more than at the start", 100 * change), first};
    if (!cell.isOwnedBy(scene.system->decomposition().rank())) return {};
    const long since = watched.exact < 0 ? stepsBetweenExact : lookedAt_ - watched.exact;
    if (since < leastBetweenExact || (since < stepsBetweenExact && !isSuspicious(m))) return {};
    watched.exact = lookedAt_;
    const geometry::TriangleMesh mesh{m.position, m.network().triangles()};
    const auto cuts = geometry::selfIntersections(mesh);
    if (cuts.empty()) return {};
    const Vec3& x =
        m.position[static_cast<std::size_t>(mesh.triangles[static_cast<std::size_t>(cuts.front().first)][0])];
    return {when() + fmt::format("at {}: {} pairs of its triangles cut each other", words(x), cuts.size()), x};
}

namespace {

// A closed cell or a body.
struct Surface {
    std::string name;
    geometry::SurfaceView view;
    bool isCell;
    std::vector<int> holders;  // empty: every rank
    std::string text() const { return fmt::format("the {} {}", isCell ? "cell" : "body", name); }
};

// Closed cells that this rank holds, and all bodies. The nodes of bodies are stored in `ofBodies`, to which the result
// refers.
std::vector<Surface> surfacesOf(const Scene& scene, std::vector<std::vector<Vec3>>& ofBodies) {
    std::vector<Surface> surfaces;
    for (const Cell& cell : scene.cells)
        if (!cell.membrane.network().isOpen())
            surfaces.push_back({fmt::format("'{}'", cell.membrane.name),
                                {&cell.membrane.position, &cell.membrane.network().triangles()},
                                true,
                                cell.holders});
    if (!scene.bodies) return surfaces;
    ofBodies.reserve(scene.bodies->all().size());
    for (const bodies::Body& body : scene.bodies->all()) {
        ofBodies.push_back(body.nodes());
        surfaces.push_back(
            {fmt::format("'{}'", body.name), {&ofBodies.back(), &body.solid.surface.triangles}, false, {}});
    }
    return surfaces;
}

struct Meeting {
    Vec3 place = Vec3::Zero();
    std::string text, cause;  // empty: none
};

Meeting withItself(const Surface& surface, const geometry::Bounds& bounds, const Periodicity& period) {
    for (int k = 0; k < 3; ++k)
        if (period.isAlong(k) && bounds.sizes()[k] > mostPeriods * period.lengths()[k])
            return {bounds.center(),
                    fmt::format("{} has become {:.4g} um long along {}, more than {} times the box", surface.text(),
                                1e6 * bounds.sizes()[k], "xyz"[k], mostPeriods),
                    tooShort};
    return {};
}

Meeting withWalls(const Surface& surface, const geometry::Bounds& bounds, const boundary::Walls& walls) {
    if (walls.distance(bounds.center()) > 0.5 * bounds.diagonal().norm()) return {};
    for (const Vec3& x : *surface.view.nodes)
        if (walls.distance(x) < 0)
            return {x, fmt::format("{} crosses the {} wall", surface.text(), walls.nearest(x).name), noContact};
    return {};
}

// For a surface and its own image, `one` and `other` are the same object.
Meeting ofTwo(const Surface& one, const Surface& other, const Vec3& shift) {
    const auto found = geometry::crossing(one.view, other.view, shift);
    if (!found) return {};
    if (&one == &other)
        return {found->place, fmt::format("{} touches or crosses its own periodic image", one.text()), tooShort};
    return {found->place,
            one.isCell == other.isCell
                ? fmt::format("the {} {} and {} touch or cross", one.isCell ? "cells" : "bodies", one.name, other.name)
                : fmt::format("the cell {} and the body {} touch or cross", one.name, other.name),
            noContact};
}

}  // namespace

// Tests surfaces against each other, their periodic images and walls. Each pair is tested by the lowest rank that holds
// both; pairs of bodies are distributed over all ranks.
Fault StateCheck::ofSurfaces(const Scene& scene, const Time& time) const {
    std::vector<std::vector<Vec3>> nodesOfBodies;
    const std::vector<Surface> surfaces = surfacesOf(scene, nodesOfBodies);
    const particles::Decomposition& ranks = scene.system->decomposition();
    const auto isMine = [&](std::size_t one, std::size_t other) {
        if (!surfaces[one].isCell && !surfaces[other].isCell)
            return one % static_cast<std::size_t>(ranks.size()) == static_cast<std::size_t>(ranks.rank());
        return coupling::lowestCommonHolder(surfaces[one].holders, surfaces[other].holders) == ranks.rank();
    };
    const Periodicity& period = scene.system->periodicity();
    const auto faultOf = [&](const Meeting& meeting) {
        const Vec3 x = period.wrap(meeting.place), um = 1e6 * x;
        return Fault{
            fmt::format("step {}, t = {:.6g} s{}: {} at ({:.4g}, {:.4g}, {:.4g}) um; {}", time.step, time.t,
                        time.shearRate > 0 ? fmt::format(", strain {:.4g}", time.strain()) : "", meeting.text, um[0],
                        um[1], um[2], meeting.cause == noContact && scene.contacts ? isPassedBy : meeting.cause),
            x, true};
    };
    std::vector<geometry::Bounds> bounds;
    for (std::size_t n = 0; n < surfaces.size(); ++n) {
        const geometry::Bounds& own = bounds.emplace_back(surfaces[n].view.bounds());
        if (own.isEmpty()) continue;
        Meeting meeting = withItself(surfaces[n], own, period);
        if (meeting.text.empty() && isMine(n, n)) meeting = withWalls(surfaces[n], own, scene.model().walls);
        if (!meeting.text.empty()) return faultOf(meeting);
    }
    for (const geometry::ImagePair& pair : geometry::neighbours(bounds, period)) {
        if (!isMine(pair.first, pair.second)) continue;
        const Meeting meeting = ofTwo(surfaces[pair.first], surfaces[pair.second], pair.shift);
        if (!meeting.text.empty()) return faultOf(meeting);
    }
    return {};
}

void StateCheck::requireFinite(const Scene& scene, const Time& time, const std::string& what) {
    const auto& s = scene.store();
    std::string text;
    for (std::size_t i = 0; i < s.size() && text.empty(); ++i) {
        if (s.position(i).allFinite() && s.velocity(i).allFinite() && std::isfinite(s.density[i])) continue;
        text = fmt::format("particle {} has place {}, density {:.4g} kg/m^3 and velocity ({:.3g}, {:.3g}, {:.3g}) m/s",
                           s.id[i], words(s.position(i)), s.density[i], s.u[i], s.v[i], s.w[i]);
    }
    for (const Cell& cell : scene.cells) {
        const std::vector<Vec3>& nodes = cell.membrane.position;
        if (!text.empty()) continue;
        for (std::size_t n = 0; n < nodes.size() && text.empty(); ++n)
            if (!nodes[n].allFinite())
                text = fmt::format("node {} of the membrane '{}' is at {}", n, cell.membrane.name, words(nodes[n]));
    }
    throwTogether(scene.system->comm(), !text.empty(),
                  fmt::format("step {}, t = {:.6g} s: {}; {} not written. The run has diverged: take a shorter step, a "
                              "finer mesh or spacing",
                              time.step, time.t, text, what),
                  ExitCode::numerics);
}

Vec3 StateCheck::suspect(const Scene& scene) {
    const auto& s = scene.store();
    double most = -1;
    Vec3 place = Vec3::Zero();
    for (std::size_t i = 0; i < s.size(); ++i) {
        const Vec3 x = s.position(i);
        const double speed2 = s.velocity(i).squaredNorm();
        if (!x.allFinite() || speed2 <= most) continue;
        most = std::isfinite(speed2) ? speed2 : std::numeric_limits<double>::max(), place = x;
    }
    const Communicator ranks(scene.system->comm());
    const std::vector<double> all = ranks.gatherAll(most);
    const auto source = static_cast<int>(std::max_element(all.begin(), all.end()) - all.begin());
    MPI_Bcast(place.data(), 3, MPI_DOUBLE, source, ranks.handle());
    return place;
}

}  // namespace corpuscle::simulation
