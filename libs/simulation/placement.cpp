#include "simulation/placement.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <memory>
#include <set>

#include "core/communicator.hpp"
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
    using IsMine = std::function<bool(std::size_t, std::size_t)>;
    Clearance(const Case& input, const std::vector<Placed>& all, IsMine isMine)
        : input_(input),
          all_(all),
          isMine_(isMine ? std::move(isMine) : [](std::size_t, std::size_t) { return true; }),
          box_(input.fluidBox()),
          gap_(leastGapInSpacings * input.spacing()) {
        for (const Placed& one : all) bounds_.push_back(one.surface.bounds());
    }

    std::vector<Problem> problems() {
        for (std::size_t s = 0; s < all_.size(); ++s) inBox(s);
        for (const ImagePair& pair : geometry::neighbours(bounds_, box_.periodicity(), gap_))
            if (isMine_(pair.first, pair.second)) meet(pair);
        return std::move(problems_);
    }

  private:
    void add(const std::string& key, const std::string& text) {
        Problem& problem = problems_.emplace_back();
        problem.mark.file = "system/mesh.yaml";
        problem.key = key;
        problem.message = text;
    }

    void inBox(std::size_t s) {
        const Vec3 low = bounds_[s].min(), high = bounds_[s].max();
        for (int k = 0; k < 3; ++k) {
            const auto length = [](double metres) { return formatQuantity(metres, unit::metre); };
            if (box_.periodic[static_cast<std::size_t>(k)]) {
                if (high[k] - low[k] > box_.size()[k]) {
                    bounds_[s].setEmpty();  // it would meet everything: excluded from the search for pairs
                    if (!isMine_(s, s)) continue;
                    add(all_[s].shapeKey,
                        fmt::format("the {} is {} long along {}, longer than the box, which is periodic with {}: it "
                                    "would meet its own image; make the box longer, or the {} smaller",
                                    all_[s].name, length(high[k] - low[k]), "xyz"[k], length(box_.size()[k]),
                                    all_[s].isBody ? "body" : "cell"));
                }
            } else if ((low[k] < box_.low[k] || high[k] > box_.high[k]) && isMine_(s, s)) {
                add(all_[s].place,
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
                add(one.shapeKey, text + ": make the box longer");
            else
                add(other.place,
                    text + ": surfaces have to be clear of each other at the start; move one of them away");
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

    // Whether a node of `inner`, moved by `shift`, lies inside `outer`.
    bool holds(std::size_t outer, std::size_t inner, const Vec3& shift) {
        const Vec3 x = all_[inner].surface.nodes->front() + shift;
        return outer != inner && bounds_[outer].contains(bounds_[inner].translated(shift)) && inside(outer).inside(x);
    }

    // The deepest of the nodes of `other`, moved by `shift`, that lie inside the surface `one`.
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
    IsMine isMine_;
    particles::Box box_;
    double gap_;  // [m]
    std::vector<Bounds> bounds_;
    std::vector<Problem> problems_;
    std::set<std::pair<std::size_t, std::size_t>> told_;
    std::map<std::size_t, std::unique_ptr<geometry::InsideTest>> inside_;
    std::map<std::size_t, std::unique_ptr<geometry::TriangleTree>> grid_;
};

Placed placedCell(const Case& input, int number, const SurfaceView& surface) {
    return {fmt::format("cell '{}'", input.nameOf(number)), fmt::format("cells[{}].shape", input.cellAt(number).entry),
            input.keyOfPlace(number), false, surface};
}
Placed placedBody(const Case& input, std::size_t number, const SurfaceView& surface) {
    const std::string key = fmt::format("bodies[{}]", number);
    return {fmt::format("body '{}'", input.mesh.bodies[number].name), key + ".shape", key + ".centre", true, surface};
}

std::vector<Problem> withPlaces(const Case& input, const std::vector<Problem>& found) {
    Problems problems;
    for (const Problem& p : found) problems.add(p.mark, p.key, p.message);
    try {
        input.throwIfAny(problems);
    } catch (const CaseError& error) {  // with lines and columns now
        return error.problems();
    }
    return {};
}

// The problems that all ranks have found, on every rank.
std::vector<Problem> ofAllRanks(const Communicator& ranks, const std::vector<Problem>& own) {
    constexpr char between = '\x1e', after = '\x1f';
    std::string text;
    for (const Problem& p : own) text += fmt::format("{}{}{}{}", p.key, between, p.message, after);
    std::string whole;
    for (const std::string& part : ranks.gather(text)) whole += part;
    whole = ranks.broadcast(whole);
    std::vector<Problem> all;
    for (std::size_t at = 0; at < whole.size();) {
        const std::size_t middle = whole.find(between, at), end = whole.find(after, middle);
        Problem& problem = all.emplace_back();
        problem.mark.file = "system/mesh.yaml";
        problem.key = whole.substr(at, middle - at);
        problem.message = whole.substr(middle + 1, end - middle - 1);
        at = end + 1;
    }
    return all;
}

}  // namespace

std::vector<Problem> misplaced(const Case& input, const std::vector<Placed>& all,
                               const std::function<bool(std::size_t, std::size_t)>& isMine) {
    return withPlaces(input, Clearance(input, all, isMine).problems());
}

std::vector<Placed> placedOf(const Case& input, const std::vector<geometry::TriangleMesh>& cells,
                             const std::vector<geometry::TriangleMesh>& bodies) {
    std::vector<Placed> all;
    for (std::size_t c = 0; c < cells.size(); ++c)
        all.push_back(placedCell(input, static_cast<int>(c) + 1, {&cells[c].nodes, &cells[c].triangles}));
    for (std::size_t b = 0; b < bodies.size(); ++b)
        all.push_back(placedBody(input, b, {&bodies[b].nodes, &bodies[b].triangles}));
    return all;
}

void requireClear(const Case& input, const coupling::Scene& scene) {
    const Communicator ranks(scene.system->comm());
    std::vector<Placed> all;
    std::vector<std::vector<int>> holders;
    for (const coupling::Cell& cell : scene.cells) {
        const membrane::Membrane& m = cell.membrane;
        all.push_back(placedCell(input, m.cell, {&m.position, &m.network().triangles()}));
        holders.push_back(cell.holders);
    }
    std::vector<geometry::TriangleMesh> bodies;
    if (scene.bodies)
        for (const bodies::Body& body : scene.bodies->all())
            bodies.push_back({body.nodes(), body.solid.surface.triangles});
    for (std::size_t b = 0; b < bodies.size(); ++b)
        all.push_back(placedBody(input, b, {&bodies[b].nodes, &bodies[b].triangles}));
    holders.resize(all.size());  // every rank knows all bodies
    const std::vector<Problem> own = misplaced(input, all, [&](std::size_t i, std::size_t j) {
        return coupling::lowestCommonHolder(holders[i], holders[j]) == ranks.rank();
    });
    Problems problems;
    for (const Problem& p : ofAllRanks(ranks, own)) problems.add(p.mark, p.key, p.message);
    input.throwIfAny(problems);
}

}  // namespace corpuscle::simulation
