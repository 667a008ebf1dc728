#include "coupling/membraneSmoothing.hpp"

#include <algorithm>
#include <functional>
#include <utility>

namespace corpuscle::coupling {

void MembraneSmoothing::place(const Cells& cells, const NodeLayout& layout, const NodeVectors& areas) {
    first_.assign(1, 0), members_.clear(), shift_.clear(), square_.clear();
    for (std::size_t c = 0; c < layout.cells(); ++c) placeCell(cells[c], layout.first(c), areas);
}

void MembraneSmoothing::placeCell(const Cell& cell, std::size_t first, const NodeVectors& areas) {
    const std::vector<Vec3>& x = cell.membrane.position;
    std::vector<std::vector<int>> neighbours(x.size());
    for (const Index3& t : cell.membrane.network().triangles())
        for (std::size_t k = 0; k < 3; ++k) {  // in both directions, since an edge at a hole has one triangle only
            neighbours[static_cast<std::size_t>(t[k])].push_back(t[(k + 1) % 3]);
            neighbours[static_cast<std::size_t>(t[(k + 1) % 3])].push_back(t[k]);
        }
    // Nodes to be taken, the one with the least distance of its path first.
    using Reached = std::pair<double, std::size_t>;
    std::vector<Reached> heap;
    std::vector<std::size_t> takenFrom(x.size(), x.size());
    for (std::size_t m = 0; m < x.size(); ++m) {
        heap.assign(1, {0.0, m});
        double sum = 0;
        Vec3 mean = Vec3::Zero();
        double square = 0;
        while (!heap.empty()) {
            std::pop_heap(heap.begin(), heap.end(), std::greater<>());
            const auto [path, n] = heap.back();
            heap.pop_back();
            if (std::exchange(takenFrom[n], m) == m) continue;
            const Vec3 d = x[n] - x[m];
            const double r = path / reach_, w = areas[first + n].norm() * (1 - r) * (1 - r) * (1 + 2 * r);
            members_.push_back({first + n, w});
            sum += w, mean += w * d, square += w * d.squaredNorm();
            for (const int next : neighbours[n]) {
                const auto j = static_cast<std::size_t>(next);
                if (takenFrom[j] == m) continue;
                const double further = std::max(path, (x[j] - x[m]).norm());
                if (further >= reach_) continue;
                heap.emplace_back(further, j);
                std::push_heap(heap.begin(), heap.end(), std::greater<>());
            }
        }
        for (std::size_t k = first_.back(); k < members_.size(); ++k)
            members_[k].weight = sum > 0 ? members_[k].weight / sum : members_[k].node == first + m ? 1 : 0;
        shift_.push_back(sum > 0 ? Vec3(-mean / sum) : Vec3(Vec3::Zero()));
        square_.push_back(sum > 0 ? square / sum : 0);
        first_.push_back(members_.size());
    }
}

void MembraneSmoothing::apply(NodeVectors& u) const {
    if (isIdentity()) return;
    NodeVectors mean(u.size(), Vec3::Zero());
    for (std::size_t m = 0; m < u.size(); ++m)
        for (std::size_t k = first_[m]; k < first_[m + 1]; ++k) mean[m] += members_[k].weight * u[members_[k].node];
    u.swap(mean);
}

void MembraneSmoothing::transpose(NodeVectors& f) const {
    if (isIdentity()) return;
    NodeVectors spread(f.size(), Vec3::Zero());
    for (std::size_t m = 0; m < f.size(); ++m)
        for (std::size_t k = first_[m]; k < first_[m + 1]; ++k) spread[members_[k].node] += members_[k].weight * f[m];
    f.swap(spread);
}

std::vector<char> MembraneSmoothing::reached(const std::vector<char>& marks) const {
    std::vector<char> found(marks.size(), 0);
    for (std::size_t m = 0; m < marks.size(); ++m)
        found[m] = std::any_of(members_.begin() + static_cast<std::ptrdiff_t>(first_[m]),
                               members_.begin() + static_cast<std::ptrdiff_t>(first_[m + 1]),
                               [&](const Member& member) { return marks[member.node] != 0; });
    return found;
}

}  // namespace corpuscle::coupling
