#include "contact/candidates.hpp"

#include <algorithm>

#include "contact/boxGrid.hpp"
#include "contact/gap.hpp"

namespace corpuscle::contact {
namespace {

using geometry::Bounds;

Bounds grown(const Bounds& box, double by) { return {box.min() - Vec3::Constant(by), box.max() + Vec3::Constant(by)}; }

// Bounds of the points; empty if a position is not finite, so that such a surface is near no other.
Bounds finiteBounds(std::span<const Vec3> points) {
    Bounds all;
    for (const Vec3& x : points) {
        if (!x.allFinite()) return {};
        all.extend(x);
    }
    return all;
}

// A surface with the positions of its nodes.
struct Placed {
    const Surface& pieces;
    std::span<const Vec3> x;
    int number, firstNode;
    Bounds bounds;

    const Vec3& at(int node) const { return x[node]; }
    template <std::size_t n>
    Bounds box(const std::array<int, n>& nodes) const {
        Bounds all;
        for (const int node : nodes) all.extend(x[node]);
        return all;
    }
};

// Pieces of one kind whose boxes intersect `part`.
template <class Piece>
struct Selection {
    std::vector<Bounds> boxes;
    std::vector<int> numbers;

    Selection(const Placed& surface, const std::vector<Piece>& pieces, const Bounds& part) {
        for (std::size_t n = 0; n < pieces.size(); ++n)
            if (const Bounds box = surface.box(pieces[n]); box.intersects(part)) {
                boxes.push_back(box);
                numbers.push_back(static_cast<int>(n));
            }
    }
};

class Finder {
  public:
    Finder(std::span<const Surface* const> surfaces, std::span<const Vec3> x) {
        const std::vector<int> first = firstNodes(surfaces);
        for (std::size_t s = 0; s < surfaces.size(); ++s) {
            const std::span<const Vec3> own = x.subspan(first[s], surfaces[s]->nodes());
            placed_.push_back({*surfaces[s], own, static_cast<int>(s), first[s], finiteBounds(own)});
        }
    }

    void add(const geometry::ImagePair& pair, double within) {
        within_ = within;
        const Placed &first = placed_[pair.first], &second = placed_[pair.second];
        isSelf_ = pair.first == pair.second && pair.shift.isZero(0);
        addRows(first, second, -pair.shift, -pair.slide);
        if (!isSelf_) addRows(second, first, pair.shift, pair.slide);
        addEdgePairs(first, second, pair.shift);
        found_.pairs.push_back(pair), found_.within.push_back(within);
    }
    Candidates take() { return std::move(found_); }

  private:
    // Finds nodes of `own`, moved by `offset`, near triangles of `target`.
    void addRows(const Placed& own, const Placed& target, const Vec3& offset, const Vec3& slide) {
        const Bounds part = grown(own.bounds.translated(offset), within_).intersection(target.bounds);
        if (part.isEmpty()) return;
        const Bounds near = grown(target.bounds, within_);
        const Selection<Index3> selection(target, target.pieces.triangles(), part);
        BoxGrid grid(selection.boxes);
        for (std::size_t n = 0; n < own.x.size(); ++n) {
            const Vec3 x = own.x[n] + offset;
            if (!(own.pieces.nodeArea()[n] > 0) || !near.contains(x)) continue;
            const int node = static_cast<int>(n);
            pieces_.clear();
            grid.forMeeting(grown(Bounds(x), within_), [&](int k) {
                const Index3& t = target.pieces.triangles()[selection.numbers[k]];
                if (isSelf_ && std::find(t.begin(), t.end(), node) != t.end()) return;
                if (nodeToTriangle(x, target.at(t[0]), target.at(t[1]), target.at(t[2])).distance <= within_) {
                    pieces_.push_back(selection.numbers[k]);
                }
            });
            if (!pieces_.empty()) addRow(own, target, node, offset, slide);
        }
    }

    void addRow(const Placed& own, const Placed& target, int node, const Vec3& offset, const Vec3& slide) {
        const Vec3 x = own.at(node) + offset;
        std::sort(pieces_.begin(), pieces_.end());
        rowEdges_.clear(), rowNodes_.clear();
        for (const int t : pieces_) {
            rowEdges_.insert(rowEdges_.end(), target.pieces.sides()[t].begin(), target.pieces.sides()[t].end());
            rowNodes_.insert(rowNodes_.end(), target.pieces.triangles()[t].begin(), target.pieces.triangles()[t].end());
        }
        NodeRow row{own.firstNode + node, own.number, target.number, offset, slide, {}, {}, {}};
        row.triangles = append(found_.triangles, pieces_, [](int) { return true; });
        row.edges = append(found_.edges, rowEdges_, [&](int e) {
            const auto [a, b] = target.pieces.edges()[e];
            return target.pieces.edgeCoefficient()[e] != 0 &&
                   nodeToEdge(x, target.at(a), target.at(b)).distance <= within_;
        });
        row.nodes = append(found_.nodes, rowNodes_, [&](int v) {
            return target.pieces.nodeCoefficient()[v] != 0 && nodeToNode(x, target.at(v)).distance <= within_;
        });
        found_.rows.push_back(row);
    }

    // Appends each wanted number once, in ascending order; returns begin and end in the list.
    template <class Wanted>
    static std::array<int, 2> append(std::vector<int>& list, std::vector<int>& numbers, Wanted&& wanted) {
        const int begin = static_cast<int>(list.size());
        std::sort(numbers.begin(), numbers.end());
        numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
        for (const int n : numbers)
            if (wanted(n)) list.push_back(n);
        return {begin, static_cast<int>(list.size())};
    }

    // Finds edges of the first surface near those of the second surface, moved by `shift`.
    void addEdgePairs(const Placed& first, const Placed& second, const Vec3& shift) {
        const Bounds part = grown(first.bounds.translated(-shift), within_).intersection(second.bounds);
        if (part.isEmpty()) return;
        const Bounds near = grown(second.bounds, within_);
        const Selection<Edge> selection(second, second.pieces.edges(), part);
        BoxGrid grid(selection.boxes);
        const int pair = static_cast<int>(found_.pairs.size());
        for (std::size_t e = 0; e < first.pieces.edges().size(); ++e) {
            const Edge& one = first.pieces.edges()[e];
            const Bounds box = first.box(one).translated(-shift);
            if (!near.intersects(box)) continue;
            const Vec3 a = first.at(one[0]) - shift, b = first.at(one[1]) - shift;
            pieces_.clear();
            grid.forMeeting(grown(box, within_), [&](int k) {
                const int number = selection.numbers[k];
                const Edge& other = second.pieces.edges()[number];
                if (isSelf_ && (number <= static_cast<int>(e) || shareNode(one, other))) return;
                if (edgeToEdge(a, b, second.at(other[0]), second.at(other[1])).distance <= within_) {
                    pieces_.push_back(number);
                }
            });
            std::sort(pieces_.begin(), pieces_.end());
            for (const int number : pieces_) found_.edgePairs.push_back({pair, static_cast<int>(e), number});
        }
    }
    static bool shareNode(const Edge& a, const Edge& b) {
        return a[0] == b[0] || a[0] == b[1] || a[1] == b[0] || a[1] == b[1];
    }

    double within_ = 0;  // of the present pair
    bool isSelf_ = false;
    std::vector<Placed> placed_;
    Candidates found_;
    std::vector<int> pieces_, rowEdges_, rowNodes_;  // of the present node or edge
};

}  // namespace

std::vector<int> firstNodes(std::span<const Surface* const> surfaces) {
    std::vector<int> first{0};
    for (const Surface* surface : surfaces) first.push_back(first.back() + static_cast<int>(surface->nodes()));
    return first;
}

Candidates findCandidates(std::span<const Surface* const> surfaces, std::span<const Vec3> x,
                          std::span<const geometry::ImagePair> pairs, std::span<const double> within) {
    Finder finder(surfaces, x);
    for (std::size_t p = 0; p < pairs.size(); ++p) finder.add(pairs[p], within[p]);
    return finder.take();
}

}  // namespace corpuscle::contact
