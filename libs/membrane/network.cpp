#include "membrane/network.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <string>

#include "core/error.hpp"
#include "membrane/coordinates.hpp"
#include "membrane/surface.hpp"

namespace corpuscle::membrane {

namespace {

int oppositeNode(const Index3& triangle, int a, int b) { return triangle[0] + triangle[1] + triangle[2] - a - b; }

template <class Coordinate, int N>
Element<N> elementAtRest(const std::vector<Vec3>& x, std::array<int, N> node, int number) {
    std::array<Vec3, N> corner;
    for (int k = 0; k < N; ++k) {
        corner[k] = x[node[k]];
    }
    return {node, number, Coordinate::at(corner).value};
}

[[noreturn]] void badMesh(const std::string& what) {
    throw Failure(ExitCode::invalidCase,
                  "membrane mesh: " + what + "; remake or repair the mesh (checkMesh shows its faults)");
}

std::string nodes(const Index3& t) {
    return std::to_string(t[0]) + ", " + std::to_string(t[1]) + ", " + std::to_string(t[2]);
}

}  // namespace

Network::Network(std::vector<Vec3> stressFree, std::vector<Index3> triangles)
    : stressFree_(std::move(stressFree)), triangles_(std::move(triangles)) {
    restAreas_.reserve(triangles_.size());
    for (const Index3& t : triangles_) {
        for (const int node : t) {
            if (node < 0 || node >= static_cast<int>(nodeCount())) {
                badMesh("triangle (" + nodes(t) + ") names a node outside 0 .. " + std::to_string(nodeCount() - 1));
            }
        }
        restAreas_.push_back(areaVector(stressFree_, t).norm());
        if (!(restAreas_.back() > 0)) {
            badMesh("triangle (" + nodes(t) + ") has no area");
        }
    }
    findBonds();
    alive_.assign(allBonds_.size(), 1);
    compact();
}

void Network::findBonds() {
    std::map<std::array<int, 2>, std::array<int, 2>> sides;  // edge (a < b) -> triangles left and right of a->b
    for (int t = 0; t < static_cast<int>(triangles_.size()); ++t) {
        for (int k = 0; k < 3; ++k) {
            const int from = triangles_[t][k], to = triangles_[t][(k + 1) % 3];
            auto& pair =
                sides.try_emplace({std::min(from, to), std::max(from, to)}, std::array<int, 2>{-1, -1}).first->second;
            int& side = pair[from < to ? 0 : 1];
            if (side >= 0) {
                badMesh("triangles (" + nodes(triangles_[side]) + ") and (" + nodes(triangles_[t]) +
                        ") run the same way along the edge " + std::to_string(from) + ", " + std::to_string(to));
            }
            side = t;
        }
    }
    triangleBonds_.resize(triangles_.size());
    for (const auto& [edge, triangles] : sides) {
        const int number = static_cast<int>(allBonds_.size());
        allBonds_.push_back(elementAtRest<BondLength, 2>(stressFree_, edge, number));
        bondTriangles_.push_back(triangles);
        for (const int t : triangles) {
            hasBorder_ = hasBorder_ || t < 0;
            for (int k = 0; t >= 0 && k < 3; ++k) {
                const int from = triangles_[t][k], to = triangles_[t][(k + 1) % 3];
                if (std::min(from, to) == edge[0] && std::max(from, to) == edge[1]) {
                    triangleBonds_[t][k] = number;
                }
            }
        }
    }
}

void Network::useCorners() {
    useCorners_ = true;
    compact();
}

void Network::useHinges() {
    useHinges_ = true;
    compact();
}

void Network::useRims() {
    useRims_ = true;
    compact();
}

// Rebuilds the lists from the stress-free mesh and alive_ alone, so that a restored network is identical to one that
// broke step by step.
void Network::compact() {
    bonds_.clear();
    corners_.clear();
    hinges_.clear();
    rimBonds_.clear();
    wholeTriangles_.clear();
    brokenTriangle_.assign(triangles_.size(), 0);
    wasOpen_ = std::any_of(alive_.begin(), alive_.end(), [](char alive) { return alive != 1; });
    ++changes_;
    for (const Bond& bond : allBonds_) {
        if (alive_[bond.number]) {
            bonds_.push_back(bond);
            continue;
        }
        for (const int t : bondTriangles_[bond.number]) {
            if (t >= 0) {
                brokenTriangle_[t] = 1;
            }
        }
    }
    for (int t = 0; t < static_cast<int>(triangles_.size()); ++t) {
        if (!isBroken(t)) {
            wholeTriangles_.push_back(t);
        }
        for (int k = 0; useCorners_ && k < 3; ++k) {
            const int next = (k + 1) % 3, previous = (k + 2) % 3;
            if (alive_[triangleBonds_[t][k]] && alive_[triangleBonds_[t][previous]]) {
                corners_.push_back(elementAtRest<CornerAngle, 3>(
                    stressFree_, {triangles_[t][k], triangles_[t][next], triangles_[t][previous]}, t));
            }
        }
    }
    for (const Bond& bond : allBonds_) {
        const auto [left, right] = bondTriangles_[bond.number];
        if (useRims_ && left >= 0 && right >= 0 && isBroken(left) != isBroken(right)) {
            rimBonds_.push_back(bond);
        }
        if (useHinges_ && left >= 0 && right >= 0 && !isBroken(left) && !isBroken(right)) {
            const auto [a, b] = bond.node;
            hinges_.push_back(elementAtRest<DihedralAngle, 4>(
                stressFree_, {a, b, oppositeNode(triangles_[left], a, b), oppositeNode(triangles_[right], a, b)},
                bond.number));
        }
    }
}

double Network::meanBondLength() const {
    double sum = 0;
    for (const Bond& bond : allBonds_) {
        sum += bond.rest;
    }
    return sum / static_cast<double>(allBonds_.size());
}

void Network::breakBonds(std::span<const int> numbers) {
    for (const int number : numbers) {
        alive_.at(number) = 0;
    }
    compact();
}

void Network::resealBonds(std::span<const int> numbers) {
    for (const int number : numbers) {
        alive_.at(number) = 2;
    }
    compact();
}

double Network::shareOfBond(int bond) const {
    if (!isWeakened()) {
        return 1;
    }
    const auto [left, right] = bondTriangles_[bond];
    return left < 0 ? shares_[right] : right < 0 ? shares_[left] : 0.5 * (shares_[left] + shares_[right]);
}

void Network::restore(std::vector<char> alive) {
    if (alive.size() != allBonds_.size()) {
        throw Failure(ExitCode::io, "checkpoint holds " + std::to_string(alive.size()) +
                                        " bonds of a membrane that has " + std::to_string(allBonds_.size()) +
                                        "; it belongs to another mesh");
    }
    alive_ = std::move(alive);
    compact();
}

int Network::across(int triangle, int edge) const {
    const auto [left, right] = bondTriangles_[triangleBonds_[triangle][edge]];
    return left == triangle ? right : left;
}

std::vector<std::vector<int>> Network::rims() const {
    const auto onRim = [&](int triangle, int edge) {
        const int other = across(triangle, edge);
        return !isBroken(triangle) && other >= 0 && isBroken(other);
    };
    const auto edgeOf = [&](int triangle, int bond) {
        const Index3& bonds = triangleBonds_[triangle];
        return static_cast<int>(std::find(bonds.begin(), bonds.end(), bond) - bonds.begin());
    };
    std::vector<char> seen(allBonds_.size(), 0);
    std::vector<std::vector<int>> loops;
    for (const Bond& first : allBonds_) {
        const auto [left, right] = bondTriangles_[first.number];
        int triangle = left >= 0 && !isBroken(left) ? left : right;
        if (seen[first.number] || triangle < 0 || !onRim(triangle, edgeOf(triangle, first.number))) {
            continue;
        }
        std::vector<int> loop;
        for (int bond = first.number; !seen[bond];) {
            seen[bond] = 1;
            int edge = edgeOf(triangle, bond);
            loop.push_back(triangles_[triangle][edge]);
            // Turn about the end node of the edge, through the triangles of the hole, up to a whole triangle or the
            // border of the mesh.
            int hole = across(triangle, edge);
            do {
                edge = (edgeOf(hole, bond) + 2) % 3;
                bond = triangleBonds_[hole][edge];
                triangle = hole;
                hole = across(hole, edge);
            } while (hole >= 0 && isBroken(hole));
            if (hole < 0) {
                loop.push_back(triangles_[triangle][(edge + 1) % 3]);
                break;
            }
            triangle = hole;
        }
        loops.push_back(std::move(loop));
    }
    return loops;
}

std::vector<int> Network::sheetOfNodes() const {
    std::vector<int> parent(nodeCount());
    std::iota(parent.begin(), parent.end(), 0);
    const auto rootOf = [&](int node) {
        while (parent[node] != node) {
            node = parent[node] = parent[parent[node]];
        }
        return node;
    };
    std::vector<char> isHeld(nodeCount(), 0);
    for (const int t : wholeTriangles_) {
        for (const int node : triangles_[t]) {
            isHeld[node] = 1;
            const int one = rootOf(triangles_[t][0]), other = rootOf(node);
            parent[std::max(one, other)] = std::min(one, other);
        }
    }
    std::vector<int> sheet(nodeCount(), -1);
    int count = 0;
    for (int node = 0; node < static_cast<int>(nodeCount()); ++node) {
        if (isHeld[node]) {
            const int root = rootOf(node);  // the lowest node of its sheet
            sheet[node] = root == node ? count++ : sheet[root];
        }
    }
    return sheet;
}

double Network::holeRestArea() const {
    double area = 0;
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
        area += brokenTriangle_[t] ? restAreas_[t] : 0;
    }
    return area;
}

double Network::holeArea(std::span<const Vec3> x) const {
    double area = 0;
    for (const auto& rim : rims()) {
        area += fanArea(x, rim);
    }
    return area;
}

}  // namespace corpuscle::membrane
