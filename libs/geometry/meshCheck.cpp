#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <numeric>

#include "geometry/surfaceAlgorithms.hpp"

namespace corpuscle::geometry {
namespace {

// Counts one kind of fault and keeps its first place, so that a broken file gives a few lines and not thousands.
struct Fault {
    int count = 0;
    std::string first;
    void add(const std::string& place) {
        if (count++ == 0) first = place;
    }
    void report(std::vector<std::string>& list, const std::string& what) const {
        if (count > 0) list.push_back(fmt::format("{} {} (first: {})", count, what, first));
    }
};

// Writes a position for messages.
struct At {
    const std::string& unit;
    std::string operator()(const Vec3& x) const {
        return fmt::format("({:.6g}, {:.6g}, {:.6g}){}", x.x(), x.y(), x.z(), unit);
    }
};

struct UnionFind {
    std::vector<int> parent;
    explicit UnionFind(std::size_t n) : parent(n) { std::iota(parent.begin(), parent.end(), 0); }
    int root(int i) {
        while (parent[i] != i) i = parent[i] = parent[parent[i]];
        return i;
    }
    void join(int i, int j) { parent[root(i)] = root(j); }
    int groups() {
        int n = 0;
        for (int i = 0; i < static_cast<int>(parent.size()); ++i) n += root(i) == i;
        return n;
    }
};

// Whether indices and coordinates are valid, so that the other checks can be made.
bool checkIndices(const TriangleMesh& mesh, const At& at, std::vector<std::string>& faults) {
    if (mesh.triangles.empty()) {
        faults.emplace_back("the mesh has no triangles");
        return false;
    }
    const int n = static_cast<int>(mesh.nodes.size());
    Fault missing, loose, notFinite;
    std::vector<bool> used(mesh.nodes.size(), false);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        for (int node : mesh.triangles[t]) {
            if (node < 0 || node >= n)
                missing.add(fmt::format("triangle {}, node {}", t, node));
            else
                used[node] = true;
        }
    for (int i = 0; i < n; ++i) {
        if (!mesh.nodes[i].allFinite()) notFinite.add(fmt::format("node {}", i));
        if (!used[i]) loose.add(fmt::format("node {} at {}", i, at(mesh.nodes[i])));
    }
    missing.report(faults, "triangle corners name a node that does not exist");
    notFinite.report(faults, "nodes have a coordinate that is not a finite number");
    loose.report(faults, "nodes belong to no triangle");
    return missing.count == 0 && notFinite.count == 0;
}

void checkTriangles(const TriangleMesh& mesh, const At& at, std::vector<std::string>& faults) {
    Fault degenerate;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const auto& [i, j, k] = mesh.triangles[t];
        const Vec3 u = mesh.nodes[j] - mesh.nodes[i], v = mesh.nodes[k] - mesh.nodes[i];
        const double longest2 = std::max({u.squaredNorm(), v.squaredNorm(), (u - v).squaredNorm()});
        if (!(u.cross(v).norm() > 1e-10 * longest2))
            degenerate.add(fmt::format("triangle {} at {}", t, at(mesh.nodes[i])));
    }
    degenerate.report(faults, "degenerate triangles without area");
}

// Checks how many triangles each edge has, and in which directions they run through it.
void checkEdges(const TriangleMesh& mesh, const At& at, std::vector<std::string>& faults) {
    std::map<std::pair<int, int>, std::pair<int, int>> runs;  // (a < b) -> times a->b, times b->a
    for (const Index3& t : mesh.triangles)
        for (int s = 0; s < 3; ++s) {
            const int a = t[s], b = t[(s + 1) % 3];
            if (a != b) a < b ? ++runs[{a, b}].first : ++runs[{b, a}].second;
        }
    Fault open, nonManifold, inverted;
    for (const auto& [edge, count] : runs) {
        const std::string place =
            fmt::format("between nodes {} and {} at {}", edge.first, edge.second, at(mesh.nodes[edge.first]));
        const int total = count.first + count.second;
        if (total == 1)
            open.add(place);
        else if (total > 2)
            nonManifold.add(place);
        else if (count.first != 1)
            inverted.add(place);
    }
    open.report(faults, "open edges with a triangle on one side only: the surface has a hole");
    nonManifold.report(faults, "non-manifold edges with more than two triangles");
    inverted.report(faults, "edges whose two triangles have opposite orientation: turn one of them over");
}

// The triangles around a node must form one fan; two fans that touch in one node are a pinched surface.
void checkNodes(const TriangleMesh& mesh, const At& at, std::vector<std::string>& faults) {
    std::vector<std::vector<int>> around(mesh.nodes.size());
    for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t)
        for (int n : mesh.triangles[t])
            if (around[n].empty() || around[n].back() != t) around[n].push_back(t);
    Fault pinched;
    for (int n = 0; n < static_cast<int>(around.size()); ++n) {
        const std::vector<int>& fan = around[n];
        UnionFind groups(fan.size());
        std::map<int, int> firstWith;  // other node -> the first triangle of the fan that has it
        for (int p = 0; p < static_cast<int>(fan.size()); ++p)
            for (const int other : mesh.triangles[fan[p]])
                if (other != n) groups.join(p, firstWith.try_emplace(other, p).first->second);
        if (groups.groups() > 1) pinched.add(fmt::format("node {} at {}", n, at(mesh.nodes[n])));
    }
    pinched.report(faults, "nodes where the surface touches itself in a point");
}

int components(const TriangleMesh& mesh) {
    UnionFind groups(mesh.nodes.size());
    std::vector<bool> used(mesh.nodes.size(), false);
    for (const auto& [i, j, k] : mesh.triangles) {
        groups.join(i, j);
        groups.join(j, k);
        used[i] = used[j] = used[k] = true;
    }
    int n = 0;
    for (int i = 0; i < static_cast<int>(used.size()); ++i) n += used[i] && groups.root(i) == i;
    return n;
}

}  // namespace

std::vector<std::string> checkClosedManifold(const TriangleMesh& mesh, const std::string& unit) {
    const At at{unit};
    std::vector<std::string> faults;
    if (!checkIndices(mesh, at, faults)) return faults;
    checkTriangles(mesh, at, faults);
    checkEdges(mesh, at, faults);
    checkNodes(mesh, at, faults);
    if (const int n = components(mesh); n > 1)
        faults.push_back(fmt::format("{} separate surfaces; one cell is one closed surface", n));
    if (faults.empty() && mesh.volume() < 0)
        faults.emplace_back("the triangles point inwards (negative volume): reverse their orientation");
    if (!faults.empty()) return faults;
    Fault cuts;
    for (const auto& [s, t] : selfIntersections(mesh))
        cuts.add(fmt::format("triangles {} and {} at {}", s, t, at(mesh.nodes[mesh.triangles[s][0]])));
    cuts.report(faults, cuts.count < static_cast<int>(mostSelfIntersections)
                            ? "pairs of triangles that cut each other"
                            : "pairs of triangles, or more, that cut each other");
    return faults;
}

}  // namespace corpuscle::geometry
