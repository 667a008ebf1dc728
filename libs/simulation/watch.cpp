#include "simulation/watch.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/communicator.hpp"
#include "core/together.hpp"
#include "geometry/triangleMesh.hpp"

namespace corpuscle::simulation {

using coupling::Cell;
using coupling::middleOf;
using coupling::Scene;
using membrane::Bond;
using membrane::Membrane;
using particles::Kind;

namespace {

constexpr double largestDensityChange = 0.3, largestSpeedUp = 10, largestVolumeChange = 1.0 / 3;
constexpr double largestBondChange = 0.3;                      // of ln l between two looks
constexpr double sharpestFold = -0.5;                          // cosine between the normals of neighbours
constexpr double beyondWall = 2;                               // spacings
constexpr long looksBetweenPairs = 5;                          // that membranes are compared with each other
constexpr long stepsBetweenExact = 50, leastBetweenExact = 5;  // looks, without suspicion and with it

double length(const Membrane& m, const Bond& bond) {
    return (m.position[static_cast<std::size_t>(bond.node[1])] - m.position[static_cast<std::size_t>(bond.node[0])])
        .norm();
}

std::string words(const Vec3& x) { return fmt::format("({:.4g}, {:.4g}, {:.4g}) m", x[0], x[1], x[2]); }

}  // namespace

Watch::Watch(const Case& input, const Scene& scene) : input_(input) {
    particles_ = Communicator(scene.system->comm()).sum(static_cast<long>(scene.system->owned()));
    lengths_.resize(scene.cells.size());
    take(scene);
}

void Watch::take(const Scene& scene) {
    const auto& s = scene.store();
    double most = 0;
    for (std::size_t i = 0; i < s.size(); ++i) most = std::max(most, s.velocity(i).squaredNorm());
    fastest2_ = Communicator(scene.system->comm()).max(most);
    exact_.assign(scene.cells.size(), -1);
    for (std::vector<double>& lengths : lengths_) lengths.clear();
    for (std::size_t c = 0; c < scene.cells.size(); ++c)
        if (isMine(scene, c)) compareBonds(scene.cells[c].membrane, lengths_[c]);
}

// Where every rank holds every cell, each looks at its share of them.
bool Watch::isMine(const Scene& scene, std::size_t index) const {
    const particles::Decomposition& ranks = scene.system->decomposition();
    if (!scene.cells[index].held) return false;
    return !input_.numerics.isImmersed() ||
           index % static_cast<std::size_t>(ranks.size()) == static_cast<std::size_t>(ranks.rank());
}

Fault Watch::find(const Scene& scene, const Time& time) {
    ++lookedAt_;
    const MPI_Comm comm = scene.system->comm();
    const Communicator ranks(comm);
    double fastest2 = 0;
    Fault fault = ofParticles(scene, time, fastest2);
    for (std::size_t c = 0; c < scene.cells.size() && !fault; ++c) {
        if (isMine(scene, c)) {
            fault = ofCell(scene, c, time);
            if (!fault && lookedAt_ % looksBetweenPairs == 0) fault = ofPairs(scene, c, time);
        } else
            lengths_[c].clear();  // old by the time that this rank holds the cell again
    }
    const std::vector<double> most = ranks.max({fault ? 1.0 : 0.0, fastest2});
    const long count = ranks.sum(static_cast<long>(scene.system->owned()));
    if (most[0] > 0) {
        const int first = firstFailed(comm, static_cast<bool>(fault), fault.text);
        MPI_Bcast(fault.place.data(), 3, MPI_DOUBLE, first, comm);
        MPI_Bcast(&fault.isGeometric, 1, MPI_CXX_BOOL, first, comm);
        return fault;
    }
    if (count != particles_)
        return {fmt::format("step {}, t = {:.6g} s: there are {} particles, at the start there were {}", time.step,
                            time.t, count, particles_),
                Vec3::Zero()};
    fastest2_ = most[1];
    return {};
}

Fault Watch::ofParticles(const Scene& scene, const Time& time, double& fastest2) const {
    const auto& s = scene.store();
    const sph::FluidModel& model = scene.model();
    const double scale2 = std::max(fastest2_, input_.flow.speed * input_.flow.speed);
    const double far = std::min(0.5 * scene.spacing / time.dt, model.soundSpeed);
    const double tooFast2 = std::max(largestSpeedUp * largestSpeedUp * scale2, far * far);
    const sph::Walls& walls = model.walls;
    const double reserve = beyondWall * scene.spacing;
    for (std::size_t i = 0; i < s.size(); ++i) {
        const Vec3 x = s.position(i), u = s.velocity(i);
        const double change = std::abs(s.density[i] / model.density - 1);
        const double speed2 = u.squaredNorm();
        fastest2 = std::max(fastest2, speed2);
        const bool isDense = change < largestDensityChange, isSlow = speed2 <= tooFast2;
        const bool isInside = !walls.exist() || s.kindOf(i) == Kind::wall ||
                              (x[walls.axis] > walls.low - reserve && x[walls.axis] < walls.high + reserve);
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

bool Watch::isSuspicious(const Membrane& m) const {
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

// The first bond that has changed too much since the last look, null: none; takes up the lengths of now. No lengths yet: nothing to compare.
const Bond* Watch::compareBonds(const Membrane& m, std::vector<double>& lengths) {
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

Fault Watch::ofCell(const Scene& scene, std::size_t index, const Time& time) {
    const Cell& cell = scene.cells[index];
    const Membrane& m = cell.membrane;
    const auto when = [&] {
        return fmt::format("step {}, t = {:.6g} s: the membrane '{}' ", time.step, time.t, m.name);
    };
    if (const Bond* bond = compareBonds(m, lengths_[index])) {
        const Vec3& x = m.position[static_cast<std::size_t>(bond->node[0])];
        return {
            when() + fmt::format(
                         "at {}: a bond of {:.3g} m is {:.3g} m long after a step: a node was thrown out of its place",
                         words(x), lengths_[index][static_cast<std::size_t>(bond->number)], length(m, *bond)),
            x};
    }
    if (m.network().isOpen()) return {};
    const Vec3& first = m.position.front();
    if (const double change = m.volume() / cell.initialVolume - 1; !(std::abs(change) < largestVolumeChange))
        return {when() + fmt::format("encloses {:+.0f} % of its volume more than at the start", 100 * change), first};
    const long since = exact_[index] < 0 ? stepsBetweenExact : lookedAt_ - exact_[index];
    if (since < leastBetweenExact || (since < stepsBetweenExact && !isSuspicious(m))) return {};
    exact_[index] = lookedAt_;
    const geometry::TriangleMesh mesh{m.position, m.network().triangles()};
    const auto cuts = geometry::selfIntersections(mesh);
    if (cuts.empty()) return {};
    const Vec3& x =
        m.position[static_cast<std::size_t>(mesh.triangles[static_cast<std::size_t>(cuts.front().first)][0])];
    return {when() + fmt::format("at {}: {} pairs of its triangles cut each other", words(x), cuts.size()), x};
}

// With the cells after it that this rank holds, the nearest image of each. Asked where their bounds meet.
Fault Watch::ofPairs(const Scene& scene, std::size_t index, const Time& time) {
    const Membrane& m = scene.cells[index].membrane;
    if (m.network().isOpen()) return {};
    const Vec3 middle = middleOf(scene.cells[index]);
    const auto bounds = [](const std::vector<Vec3>& nodes) {
        Eigen::AlignedBox3d box;
        for (const Vec3& x : nodes) box.extend(x);
        return box;
    };
    const auto own = bounds(m.position);
    for (std::size_t other = index + 1; other < scene.cells.size(); ++other) {
        const Cell& cell = scene.cells[other];
        if (!cell.held || cell.membrane.network().isOpen()) continue;
        const Vec3 theirs = middleOf(cell), shift = coupling::imageNear(scene.system->box(), theirs, middle) - theirs;
        auto box = bounds(cell.membrane.position);
        if (!own.intersects(box.translate(shift))) continue;
        geometry::TriangleMesh both{m.position, m.network().triangles()};
        const int nodes = static_cast<int>(both.nodes.size()), triangles = static_cast<int>(both.triangles.size());
        for (const Vec3& x : cell.membrane.position) both.nodes.push_back(x + shift);
        for (const Index3& t : cell.membrane.network().triangles())
            both.triangles.push_back({t[0] + nodes, t[1] + nodes, t[2] + nodes});
        for (const auto& [a, b] : geometry::selfIntersections(both))
            if ((a < triangles) != (b < triangles)) {
                const Vec3& x = both.nodes[static_cast<std::size_t>(both.triangles[static_cast<std::size_t>(a)][0])];
                return {fmt::format("step {}, t = {:.6g} s: the membranes '{}' and '{}' cut each other at {}",
                                    time.step, time.t, m.name, cell.membrane.name, words(x)),
                        x, true};
            }
    }
    return {};
}

void Watch::requireFinite(const Scene& scene, const Time& time, const std::string& what) {
    const auto& s = scene.store();
    std::string text;
    for (std::size_t i = 0; i < s.size() && text.empty(); ++i) {
        if (s.position(i).allFinite() && s.velocity(i).allFinite() && std::isfinite(s.density[i])) continue;
        text = fmt::format("particle {} has place {}, density {:.4g} kg/m^3 and velocity ({:.3g}, {:.3g}, {:.3g}) m/s",
                           s.id[i], words(s.position(i)), s.density[i], s.u[i], s.v[i], s.w[i]);
    }
    for (const Cell& cell : scene.cells) {
        const std::vector<Vec3>& nodes = cell.membrane.position;
        if (!cell.held || !text.empty()) continue;
        for (std::size_t n = 0; n < nodes.size() && text.empty(); ++n)
            if (!nodes[n].allFinite())
                text = fmt::format("node {} of the membrane '{}' is at {}", n, cell.membrane.name, words(nodes[n]));
    }
    throwTogether(
        scene.system->comm(), !text.empty(),
        fmt::format("step {}, t = {:.6g} s: {}; {} not written. The run has diverged: take a shorter step, a "
                    "finer mesh or spacing",
                    time.step, time.t, text, what),
        ExitCode::numerics);
}

Vec3 Watch::suspect(const Scene& scene) {
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
