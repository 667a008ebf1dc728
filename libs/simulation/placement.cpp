#include "simulation/placement.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <memory>
#include <set>

#include "geometry/insideTest.hpp"
#include "geometry/triangleTree.hpp"

namespace corpuscle::simulation {

using geometry::Bounds;
using geometry::ImagePair;
using geometry::SurfaceView;

namespace {

constexpr double leastGapInSpacings = 0.1;

struct Deepest {
    double depth = 0;  // [m]; 0: nothing inside
    Vec3 place = Vec3::Zero();
};

class Clearance {
  public:
    Clearance(const Case& input, const std::vector<Placed>& all)
        : input_(input), all_(all), box_(input.fluidBox()), gap_(leastGapInSpacings * input.spacing()) {
        for (const Placed& one : all) bounds_.push_back(one.surface.bounds());
    }

    std::vector<Problem> problems() {
        for (std::size_t s = 0; s < all_.size(); ++s) inBox(s);
        for (const ImagePair& pair : geometry::neighbours(bounds_, box_.periodicity(), gap_)) meet(pair);
        return std::move(problems_);
    }

  private:
    void add(const Placed& placed, const std::string& key, const std::string& text) {
        Problem& problem = problems_.emplace_back();
        problem.mark.file = "system/mesh.yaml";
        problem.key = placed.key + key;
        problem.message = text;
    }

    void inBox(std::size_t s) {
        const Vec3 low = bounds_[s].min(), high = bounds_[s].max();
        for (int k = 0; k < 3; ++k) {
            const auto length = [](double metres) { return formatQuantity(metres, unit::metre); };
            if (box_.periodic[static_cast<std::size_t>(k)]) {
                if (high[k] - low[k] > box_.size()[k]) {
                    bounds_[s].setEmpty();  // meets whatever there is
                    add(all_[s], ".shape",
                        fmt::format("the {} is {} long along {}, longer than the box, which is periodic with {}: it "
                                    "would meet its own image; make the box longer, or the {} smaller",
                                    all_[s].name, length(high[k] - low[k]), "xyz"[k], length(box_.size()[k]),
                                    all_[s].isBody ? "body" : "cell"));
                }
            } else if (low[k] < box_.low[k] || high[k] > box_.high[k]) {
                add(all_[s], ".centre",
                    fmt::format("the {} reaches from {} to {} along {}, and the box from {} to {}: move it",
                                all_[s].name, length(low[k]), length(high[k]), "xyz"[k], length(box_.low[k]),
                                length(box_.high[k])));
            }
        }
    }

    void meet(const ImagePair& pair) {
        const Placed &one = all_[pair.first], &other = all_[pair.second];
        if (told_.contains({pair.first, pair.second})) return;
        const auto tell = [&](const std::string& text) {
            told_.insert({pair.first, pair.second});
            if (pair.first == pair.second)
                add(one, ".shape", text + ": make the box longer");
            else
                add(other, ".centre",
                    text +
                        ": nothing but fluid keeps cells and bodies apart (there is no contact law in this "
                        "version); move one of them away");
        };
        const bool isImage = pair.shift.norm() > 0;
        const std::string both = pair.first == pair.second ? fmt::format("the {} and its own periodic image", one.name)
                                                           : fmt::format("the {} and the {}", one.name, other.name);
        const std::string how = isImage && pair.first != pair.second ? ", through the periodic boundary" : "";
        if (const auto found = geometry::crossing(one.surface, other.surface, pair.shift)) {
            const Deepest a = deepest(pair.first, pair.second, pair.shift),
                          b = deepest(pair.second, pair.first, -pair.shift);
            const Deepest most = a.depth >= b.depth ? a : Deepest{b.depth, b.place + pair.shift};
            if (most.depth > 0)
                tell(fmt::format("{} overlap at {}{}, by up to {}", both, words(most.place), how, inUm(most.depth)));
            else
                tell(fmt::format("{} touch at {}{}", both, words(found->place), how));
        } else if (holds(pair.first, pair.second, pair.shift)) {
            if (!one.isBody && other.isBody)
                nearer(pair, both, tell, how);
            else
                tell(fmt::format("the {} lies inside the {}{}", other.name, one.name, how));
        } else if (holds(pair.second, pair.first, -pair.shift)) {
            if (one.isBody && !other.isBody)
                nearer(pair, both, tell, how);
            else
                tell(fmt::format("the {} lies inside the {}{}", one.name, other.name, how));
        } else {
            nearer(pair, both, tell, how);
        }
    }

    template <class Tell>
    void nearer(const ImagePair& pair, const std::string& both, const Tell& tell, const std::string& how) {
        double least = gap_;
        Vec3 place = Vec3::Zero();
        const auto look = [&](std::size_t surface, std::size_t nodes, const Vec3& shift, const Vec3& back) {
            const Bounds reach(bounds_[surface].min() - Vec3::Constant(gap_),
                               bounds_[surface].max() + Vec3::Constant(gap_));
            for (const Vec3& node : *all_[nodes].surface.nodes) {
                const Vec3 x = node + shift;
                if (!reach.contains(x)) continue;
                const geometry::SurfacePoint at = grid(surface).nearest(x);
                if (at && std::abs(at.distance) < least) least = std::abs(at.distance), place = x + back;
            }
        };
        look(pair.first, pair.second, pair.shift, Vec3::Zero());
        look(pair.second, pair.first, -pair.shift, pair.shift);
        if (least < gap_)
            tell(fmt::format("{} touch at {}{}: they are {:.2g} dx apart, at least {} dx are needed", both,
                             words(place), how, least / input_.spacing(), leastGapInSpacings));
    }

    // Whether a node of `inner`, moved, is inside `outer`.
    bool holds(std::size_t outer, std::size_t inner, const Vec3& shift) {
        const Vec3 x = all_[inner].surface.nodes->front() + shift;
        return outer != inner && bounds_[outer].contains(bounds_[inner].translated(shift)) && inside(outer).inside(x);
    }

    // Of the nodes of `other`, moved, in the surface `one`.
    Deepest deepest(std::size_t one, std::size_t other, const Vec3& shift) {
        Deepest most;
        const geometry::TriangleTree far(meshOf(one), bounds_[one].diagonal().norm());
        for (const Vec3& node : *all_[other].surface.nodes) {
            const Vec3 x = node + shift;
            if (!bounds_[one].contains(x) || !inside(one).inside(x)) continue;
            const double depth = std::abs(far.nearest(x).distance);
            if (depth > most.depth) most = {depth, x};
        }
        return most;
    }

    geometry::TriangleMesh meshOf(std::size_t s) const { return {*all_[s].surface.nodes, *all_[s].surface.triangles}; }
    geometry::InsideTest& inside(std::size_t s) {
        std::unique_ptr<geometry::InsideTest>& test = inside_[s];
        if (!test) test = std::make_unique<geometry::InsideTest>(meshOf(s));
        return *test;
    }
    geometry::TriangleTree& grid(std::size_t s) {
        std::unique_ptr<geometry::TriangleTree>& grid = grid_[s];
        if (!grid) grid = std::make_unique<geometry::TriangleTree>(meshOf(s), gap_);
        return *grid;
    }
    std::string words(const Vec3& x) const {
        const Vec3 p = 1e6 * box_.periodicity().wrap(x);
        return fmt::format("({:.4g}, {:.4g}, {:.4g}) um", p[0], p[1], p[2]);
    }
    static std::string inUm(double metres) { return fmt::format("{:.3g} um", 1e6 * metres); }

    const Case& input_;
    const std::vector<Placed>& all_;
    particles::Box box_;
    double gap_;  // [m]
    std::vector<Bounds> bounds_;
    std::vector<Problem> problems_;
    std::set<std::pair<std::size_t, std::size_t>> told_;
    std::map<std::size_t, std::unique_ptr<geometry::InsideTest>> inside_;
    std::map<std::size_t, std::unique_ptr<geometry::TriangleTree>> grid_;
};

Placed placed(const SurfaceSettings& settings, bool isBody, std::size_t number, const SurfaceView& surface) {
    const char* const kind = isBody ? "body" : "cell";
    return {fmt::format("{} '{}'", kind, settings.name), fmt::format("{}[{}]", isBody ? "bodies" : "cells", number),
            isBody, surface};
}

}  // namespace

std::vector<Problem> misplaced(const Case& input, const std::vector<Placed>& all) {
    Problems problems;
    for (const Problem& p : Clearance(input, all).problems()) problems.add(p.mark, p.key, p.message);
    try {
        input.throwIfAny(problems);
    } catch (const CaseError& error) {  // with lines and columns now
        return error.problems();
    }
    return {};
}

std::vector<Placed> placedOf(const Case& input, const std::vector<geometry::TriangleMesh>& cells,
                             const std::vector<geometry::TriangleMesh>& bodies) {
    std::vector<Placed> all;
    for (std::size_t c = 0; c < cells.size(); ++c)
        all.push_back(placed(input.mesh.cells[c], false, c, {&cells[c].nodes, &cells[c].triangles}));
    for (std::size_t b = 0; b < bodies.size(); ++b)
        all.push_back(placed(input.mesh.bodies[b], true, b, {&bodies[b].nodes, &bodies[b].triangles}));
    return all;
}

void requireClear(const Case& input, const coupling::Scene& scene) {
    std::vector<geometry::TriangleMesh> cells, bodies;
    for (const coupling::Cell& cell : scene.cells)
        cells.push_back({cell.membrane.position, cell.membrane.network().triangles()});
    if (scene.bodies)
        for (const bodies::Body& body : scene.bodies->all())
            bodies.push_back({body.nodes(), body.solid.surface.triangles});
    Problems problems;
    for (const Problem& p : misplaced(input, placedOf(input, cells, bodies))) problems.add(p.mark, p.key, p.message);
    input.throwIfAny(problems);
}

}  // namespace corpuscle::simulation
