#include "packing/packing.hpp"

#include <fmt/format.h>

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <deque>
#include <limits>
#include <numbers>
#include <numeric>

#include "contact/barrier.hpp"
#include "core/error.hpp"
#include "core/units.hpp"
#include "geometry/insideTest.hpp"
#include "geometry/mesher.hpp"
#include "geometry/triangleTree.hpp"

namespace corpuscle::packing {
namespace {

constexpr double reachOfRadius = 0.1;           // reach of the barrier, over radiusOf the smallest cell
constexpr double firstFraction = 0.25;          // of the fluid's volume that balls around the cells take at first
constexpr double leastScale = 0.02;             // least scale at which cells are scattered
constexpr int triesOfOne = 2000;                // attempts to place one ball
constexpr double mostGrowth = 0.05;             // largest relative growth of the scale in one stage
constexpr double keptOfGaps = 0.3, kept = 0.1;  // fraction of each gap left by growth, by a step of Newton's method
constexpr int iterationsOfStage = 8, iterationsAtEnd = 50;
constexpr double gapsOfStage = 0.7, gapsAtEnd = 0.9;  // least gap, over the reach, at which Newton's method ends
constexpr double weakest = 1e-4;         // stiffness added to each unknown, over the largest: holds free cells
constexpr double restOfReach = 0.01;     // largest motion of a node in a step, over the reach, for rest
constexpr double longestStep = 1;        // largest motion of a node in a step, over the reach
constexpr int patience = 12;             // number of stages in which the scale must grow, or cells are stuck;
constexpr double leastProgress = 0.003;  // by this fraction of itself
constexpr double edgeOfRadius = 0.35;    // edge of rough surfaces, over radiusOf the cell

// Radius of the ball of equal volume.
double radiusOf(const geometry::TriangleMesh& mesh) { return std::cbrt(0.75 / std::numbers::pi * mesh.volume()); }

double smallestRadius(const std::vector<Packing::Type>& types) {
    double least = std::numeric_limits<double>::infinity();
    for (const Packing::Type& type : types) least = std::min(least, radiusOf(type.surface.mesh));
    return least;
}

// The most by which the surfaces of two cells can be nearer to each other than their rough surfaces.
double nearerOf(const std::vector<Packing::Type>& types) {
    double most = 0;
    for (const Packing::Type& type : types) most = std::max(most, type.surface.outside);
    return 2 * most;
}

std::shared_ptr<const contact::ContactLaw> lawOf(const std::vector<Packing::Type>& types, double gap) {
    const auto law = std::make_shared<contact::Barrier>();
    law->thickness = gap + nearerOf(types);
    law->length = reachOfRadius * smallestRadius(types);
    law->strength = 1e-6;  // any value: only the positions of least energy matter
    return law;
}

std::vector<Kind> kindsOf(const std::vector<Packing::Type>& types) {
    std::vector<Kind> kinds;
    kinds.reserve(types.size());
    for (const Packing::Type& type : types) kinds.push_back({type.surface.mesh, type.orientation->mayTurn()});
    return kinds;
}

// Largest distance by which `nodes` lie outside of the mesh. push: for each node of the mesh, raised to the largest
// distance of the nodes outside of its triangles.
double outsideOf(const geometry::TriangleMesh& mesh, const std::vector<Vec3>& nodes, double reach,
                 std::vector<double>& push) {
    const geometry::TriangleTree tree(mesh, reach);
    double most = 0;
    for (const Vec3& x : nodes) {
        const geometry::SurfacePoint at = tree.nearest(x);
        if (!at) return std::numeric_limits<double>::infinity();
        if (at.distance <= 0) continue;
        most = std::max(most, at.distance);
        for (std::size_t k = 0; k < 3; ++k) {
            double& own = push[static_cast<std::size_t>(mesh.triangles[static_cast<std::size_t>(at.triangle)][k])];
            own = std::max(own, at.distance);
        }
    }
    return most;
}

std::vector<Vec3> normalsOf(const geometry::TriangleMesh& mesh) {
    std::vector<Vec3> normals(mesh.nodes.size(), Vec3::Zero());
    for (const Index3& t : mesh.triangles) {
        const Vec3& origin = mesh.nodes[t[0]];
        const Vec3 twice = (mesh.nodes[t[1]] - origin).cross(mesh.nodes[t[2]] - origin);
        for (const int n : t) normals[n] += twice;
    }
    for (Vec3& normal : normals) normal.normalize();
    return normals;
}

// Whether half a turn about x maps the shape onto itself.
bool isSameUpsideDown(const geometry::Shape& shape, const std::vector<Vec3>& nodes) {
    constexpr double little = 1e-3;  // of the radius: mesh nodes lie off the surface to enclose its volume
    return std::all_of(nodes.begin(), nodes.end(), [&](const Vec3& x) {
        const auto off = [&](const Vec3& at) { return shape.implicit(at) / shape.gradient(at).norm(); };
        return std::abs(off(x) - off(Vec3(x[0], -x[1], -x[2]))) < little * shape.radius();
    });
}

RoughSurface around(const geometry::Shape& shape, const geometry::TriangleMesh& mesh) {
    constexpr int rounds = 30;
    constexpr double enough = 0.01;  // tolerated distance of fine nodes outside, over the edge
    const double edge = edgeOfRadius * radiusOf(mesh);
    if (geometry::meshQuality(mesh, nullptr).edgeMean > 0.8 * edge) return {mesh, 0};
    RoughSurface rough;
    try {
        rough.mesh = geometry::meshSurface(shape, edge);
    } catch (const Failure&) {  // the shape has details finer than this edge
        return {mesh, 0};
    }
    const std::vector<Vec3> normals = normalsOf(rough.mesh);
    for (int round = 0; round < rounds; ++round) {
        std::vector<double> push(rough.mesh.nodes.size(), 0);
        rough.outside = outsideOf(rough.mesh, mesh.nodes, edge, push);
        if (!std::isfinite(rough.outside)) return {mesh, 0};  // the rough surface is too far from the mesh
        if (rough.outside < enough * edge) return rough;
        for (std::size_t n = 0; n < push.size(); ++n) rough.mesh.nodes[n] += push[n] * normals[n];
    }
    return {mesh, 0};
}

}  // namespace

RoughSurface RoughSurface::of(const geometry::Shape& shape, const geometry::TriangleMesh& mesh) {
    RoughSurface rough = around(shape, mesh);
    rough.sameUpsideDown = isSameUpsideDown(shape, mesh.nodes);
    return rough;
}

Packing::Packing(const std::vector<Type>& types, const Space& space, double gap)
    : types_(types),
      space_(space),
      gap_(gap),
      crowd_(kindsOf(types), space.fixed, space.walls, space.period, lawOf(types, gap)) {}

std::vector<Pose> Packing::pack(std::uint64_t seed, const std::function<void(const Progress&)>& told) {
    told_ = told;
    progress_ = {};
    Random random(seed);
    double balls = 0;
    for (std::size_t t = 0; t < types_.size(); ++t)
        balls += static_cast<double>(types_[t].number) * 4 / 3 * std::numbers::pi * std::pow(crowd_.radius(t), 3);
    double scale = std::min(1.0, std::cbrt(firstFraction * space_.volume / balls));
    while (!scatter(random, scale)) {
        scale *= 0.9;
        if (scale < leastScale)
            throw Failure(ExitCode::numerics,
                          fmt::format("there is no room for the cells, not even at {} of their size, with {} between "
                                      "surfaces: take fewer cells, or a smaller gap",
                                      leastScale, formatQuantity(gap_, unit::metre)));
    }
    progress_.scale = scale;
    crowd_.populate(poses_);
    x_ = crowd_.nodes(poses_, scale);
    crowd_.evaluate(x_);
    grow();
    relax(iterationsAtEnd, gapsAtEnd);
    for (Pose& pose : poses_) pose.centre = space_.period.wrap(pose.centre);
    return poses_;
}

bool Packing::isFree(const Vec3& centre, double radius, std::size_t among) const {
    const double apart = crowd_.law().thickness;
    for (const boundary::Wall& wall : space_.walls)
        if (wall.distance(centre) < radius + apart) return false;
    for (std::size_t c = 0; c < among; ++c)
        if (space_.period.shortest(poses_[c].centre - centre).norm() <
            radius + progress_.scale * crowd_.radius(poses_[c].kind) + apart)
            return false;
    for (int k = 0; k < 3; ++k)  // its own image
        if (space_.period.isAlong(k) && space_.period.lengths()[k] < 2 * radius + apart) return false;
    return true;
}

bool Packing::scatter(Random& random, double scale) {
    std::vector<std::size_t> order(types_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return crowd_.radius(a) > crowd_.radius(b); });
    std::vector<geometry::InsideTest> insides;
    std::vector<geometry::TriangleTree> trees;
    std::vector<geometry::Bounds> bounds;
    const double apart = crowd_.law().thickness;
    for (const geometry::TriangleMesh& mesh : space_.fixed) {
        insides.emplace_back(mesh);
        trees.emplace_back(mesh, apart + scale * crowd_.radius(order.front()));
        bounds.push_back(geometry::boundsOf(mesh.nodes));
    }
    const auto isClearOfFixed = [&](const Vec3& centre, double radius) {
        for (std::size_t f = 0; f < trees.size(); ++f) {
            bool isClear = !insides[f].inside(centre, space_.period);
            const Vec3 around = Vec3::Constant(radius + apart);
            space_.period.forImagesWithin(
                centre, bounds[f].min() - around, bounds[f].max() + around,
                [&](const Vec3& image) { isClear = isClear && !trees[f].nearest(image, radius + apart); });
            if (!isClear) return false;
        }
        return true;
    };
    progress_.scale = scale;
    poses_.clear();
    for (const std::size_t kind : order)
        for (std::size_t n = 0; n < types_[kind].number; ++n) {
            const double radius = scale * crowd_.radius(kind);
            Vec3 centre;
            int tries = 0;
            do {
                if (++tries > triesOfOne) return false;
                centre = random.between(space_.low, space_.high);
            } while (!isFree(centre, radius, poses_.size()) || !isClearOfFixed(centre, radius));
            Vec3 axis = types_[kind].orientation->draw(random);
            if (types_[kind].surface.sameUpsideDown && types_[kind].orientation->mayTurn() && axis[2] < 0) axis = -axis;
            poses_.push_back({kind, centre, axis});
        }
    std::stable_sort(poses_.begin(), poses_.end(), [](const Pose& a, const Pose& b) { return a.kind < b.kind; });
    return true;
}

void Packing::grow() {
    std::deque<double> before;
    while (progress_.scale < 1) {
        const double target = std::min(1.0, (1 + mostGrowth) * progress_.scale);
        std::vector<Vec3> u = crowd_.nodes(poses_, target);
        for (std::size_t n = 0; n < u.size(); ++n) u[n] -= x_[n];
        const double free = crowd_.freeTravel(u, keptOfGaps);
        before.push_back(progress_.scale);
        progress_.scale = free == 1 ? target : progress_.scale + free * (target - progress_.scale);
        ++progress_.stages;
        x_ = crowd_.nodes(poses_, progress_.scale);
        crowd_.evaluate(x_);
        relax(iterationsOfStage, gapsOfStage);
        if (told_) told_(progress_);
        if (before.size() < patience) continue;
        if (progress_.scale < 1 && progress_.scale < (1 + leastProgress) * before.front())
            throw Failure(
                ExitCode::numerics,
                fmt::format("the cells are stuck at {:.3g} of their size, {:.3g} of their volume, with {} "
                            "between surfaces: take fewer cells, a smaller gap, another seed, or a larger box",
                            progress_.scale, std::pow(progress_.scale, 3), formatQuantity(gap_, unit::metre)));
        before.pop_front();
    }
}

void Packing::relax(int iterations, double gapsOfReach) {
    for (int n = 0; n < iterations && crowd_.leastGap() < gapsOfReach * crowd_.law().reach(); ++n)
        if (!step()) break;
    progress_.contacts = crowd_.contacts();
    progress_.leastGap = crowd_.leastGap() + gap_;  // a lower bound of the gap between the cells' own surfaces
}

// Shortens the steps of cells that would move further than longestStep allows: cells that hardly anything holds, and
// cells whose axis is near -z, where the shortest rotation from z changes fast.
void Packing::shorten(Eigen::VectorXd& q) const {
    const double longest = longestStep * crowd_.law().reach();
    const std::vector<Vec3> y = crowd_.nodes(crowd_.moved(poses_, q), progress_.scale);
    std::size_t n = 0;
    for (std::size_t c = 0; c < poses_.size(); ++c) {
        double motion = 0;
        for (const std::size_t last = n + crowd_.nodesOf(poses_[c].kind); n < last; ++n)
            motion = std::max(motion, (y[n] - x_[n]).norm());
        if (motion > longest)
            q.segment<Crowd::freedoms>(Crowd::freedoms * static_cast<Eigen::Index>(c)) *= longest / motion;
    }
}

// Makes one step of Newton's method; false: cells are at rest, or no step lowers the energy.
bool Packing::step() {
    const contact::ContactLaw& law = crowd_.law();
    const Eigen::VectorXd g = crowd_.gradient(poses_);
    Eigen::SparseMatrix<double> k = crowd_.stiffness(poses_);
    double most = 0;
    for (Eigen::Index i = 0; i < k.rows(); ++i) most = std::max(most, k.coeff(i, i));
    Eigen::SparseMatrix<double> some(k.rows(), k.cols());
    some.setIdentity();
    k += weakest * most * some;
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors(k);
    if (factors.info() != Eigen::Success) return false;
    Eigen::VectorXd q = -factors.solve(g);
    shorten(q);
    const double before = crowd_.energy(), slope = g.dot(q);
    ++progress_.iterations;
    constexpr double shortest = 1e-4, enough = 1e-4;
    for (double part = 1; part > shortest;) {
        const std::vector<Pose> next = crowd_.moved(poses_, part * q);
        const std::vector<Vec3> y = crowd_.nodes(next, progress_.scale);
        std::vector<Vec3> u = y;
        double motion = 0;
        for (std::size_t n = 0; n < u.size(); ++n) u[n] -= x_[n], motion = std::max(motion, u[n].norm());
        const double free = crowd_.freeTravel(u, kept);
        if (free < 1) {
            part *= 0.9 * free;
            continue;
        }
        crowd_.evaluate(y);
        if (crowd_.energy() <= before + enough * part * slope) {
            poses_ = next, x_ = y;
            return motion > restOfReach * law.reach();
        }
        crowd_.evaluate(x_);
        part *= 0.5;
    }
    return false;
}

}  // namespace corpuscle::packing
