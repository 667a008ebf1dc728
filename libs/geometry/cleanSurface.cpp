#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <numeric>
#include <unordered_map>

#include "geometry/readSurface.hpp"

namespace corpuscle::geometry {
namespace {

constexpr double mergeWithin = 1e-6;  // of the size of the surface

struct Place {
    std::array<std::int64_t, 3> cell;
    bool operator==(const Place&) const = default;
};
struct PlaceHash {
    std::size_t operator()(const Place& p) const {
        std::uint64_t h = 0;
        for (const std::int64_t c : p.cell)
            h = (h ^ static_cast<std::uint64_t>(c)) * 0x9e3779b97f4a7c15ull, h ^= h >> 29;
        return h;
    }
};

// New number of each node after merging nodes at exactly the same place.
std::vector<int> exactly(const std::vector<Vec3>& nodes, std::vector<Vec3>& merged) {
    std::unordered_map<Place, int, PlaceHash> places;
    std::vector<int> number;
    for (const Vec3& x : nodes) {
        Place place{};
        for (int k = 0; k < 3; ++k) {
            const double value = x[k] + 0.0;  // no -0
            std::memcpy(&place.cell[static_cast<std::size_t>(k)], &value, sizeof value);
        }
        const auto [found, isNew] = places.try_emplace(place, static_cast<int>(merged.size()));
        if (isNew) merged.push_back(x);
        number.push_back(found->second);
    }
    return number;
}

// The same, merging nodes within `reach` of the first node of a group.
std::vector<int> nearly(const std::vector<Vec3>& nodes, double reach, std::vector<Vec3>& merged, double& furthest) {
    std::unordered_map<Place, std::vector<int>, PlaceHash> grid;
    std::vector<int> number;
    const Vec3 origin = nodes.empty() ? Vec3(Vec3::Zero()) : nodes.front();
    for (const Vec3& x : nodes) {
        Place home{};
        for (int k = 0; k < 3; ++k) home.cell[static_cast<std::size_t>(k)] = std::llround((x[k] - origin[k]) / reach);
        int found = -1;
        for (int n = 0; n < 27 && found < 0; ++n) {
            const auto at =
                grid.find({{home.cell[0] + n % 3 - 1, home.cell[1] + n / 3 % 3 - 1, home.cell[2] + n / 9 - 1}});
            if (at == grid.end()) continue;
            for (const int other : at->second)
                if ((merged[other] - x).norm() <= reach) {
                    found = other;
                    break;
                }
        }
        if (found < 0) {
            found = static_cast<int>(merged.size());
            merged.push_back(x);
            grid[home].push_back(found);
        } else {
            furthest = std::max(furthest, (merged[found] - x).norm());
        }
        number.push_back(found);
    }
    return number;
}

void renumber(TriangleMesh& mesh, const std::vector<int>& number, std::vector<Vec3> nodes) {
    for (Index3& t : mesh.triangles)
        for (int& n : t) n = number[static_cast<std::size_t>(n)];
    mesh.nodes = std::move(nodes);
}

struct Side {
    int a, b, triangle;  // a < b
    bool forward;        // the triangle runs through a -> b
};

// Sides of all triangles, sorted so that those of one edge follow each other.
std::vector<Side> sidesOf(const TriangleMesh& mesh) {
    std::vector<Side> sides;
    sides.reserve(3 * mesh.triangles.size());
    for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t)
        for (int s = 0; s < 3; ++s) {
            const int a = mesh.triangles[t][s], b = mesh.triangles[t][(s + 1) % 3];
            if (a != b) sides.push_back({std::min(a, b), std::max(a, b), t, a < b});
        }
    std::sort(sides.begin(), sides.end(), [](const Side& p, const Side& q) {
        return std::array{p.a, p.b, p.triangle} < std::array{q.a, q.b, q.triangle};
    });
    return sides;
}

// Calls visit(first, end) for the sides of each edge.
template <class Visit>
void forEachEdge(const std::vector<Side>& sides, Visit&& visit) {
    for (std::size_t begin = 0, end = 0; begin < sides.size(); begin = end) {
        while (end < sides.size() && sides[end].a == sides[begin].a && sides[end].b == sides[begin].b) ++end;
        visit(begin, end);
    }
}

int openEdges(const TriangleMesh& mesh) {
    const std::vector<Side> sides = sidesOf(mesh);
    int open = 0;
    forEachEdge(sides, [&](std::size_t begin, std::size_t end) { open += end - begin == 1; });
    return open;
}

void dropLeftovers(SurfaceFromFile& surface) {
    TriangleMesh& mesh = surface.mesh;
    const auto collapsed =
        std::erase_if(mesh.triangles, [](const Index3& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; });
    if (collapsed > 0)
        surface.remarks.push_back(fmt::format("{} triangle{} with two corners at one place {} left out", collapsed,
                                              collapsed > 1 ? "s" : "", collapsed > 1 ? "were" : "was"));
    std::vector<int> number(mesh.nodes.size(), -1);
    std::vector<Vec3> nodes;
    for (const Index3& t : mesh.triangles)
        for (const int n : t)
            if (number[static_cast<std::size_t>(n)] < 0) number[static_cast<std::size_t>(n)] = 0;
    for (std::size_t n = 0; n < number.size(); ++n)
        if (number[n] == 0) {
            number[n] = static_cast<int>(nodes.size());
            nodes.push_back(mesh.nodes[n]);
        }
    if (const std::size_t loose = mesh.nodes.size() - nodes.size(); loose > 0)
        surface.remarks.push_back(fmt::format("{} point{} that belong{} to no triangle {} left out", loose,
                                              loose > 1 ? "s" : "", loose > 1 ? "" : "s", loose > 1 ? "were" : "was"));
    renumber(mesh, number, std::move(nodes));
}

}  // namespace

void mergeNodes(SurfaceFromFile& surface) {
    TriangleMesh& mesh = surface.mesh;
    std::vector<Vec3> merged;
    const std::vector<int> same = exactly(mesh.nodes, merged);
    renumber(mesh, same, std::move(merged));
    if (openEdges(mesh) > 0) {
        std::vector<Vec3> nodes;
        double furthest = 0;
        const std::vector<int> number = nearly(mesh.nodes, mergeWithin * surface.size, nodes, furthest);
        if (nodes.size() < mesh.nodes.size()) {
            surface.remarks.push_back(
                fmt::format("{} points that differ by rounding were merged into {}: at most {:.2g} of the size of the "
                            "surface apart, {:g} is allowed",
                            mesh.nodes.size(), nodes.size(), furthest / surface.size, mergeWithin));
            renumber(mesh, number, std::move(nodes));
        }
    }
    dropLeftovers(surface);
}

// The two triangles at an edge must run through it in opposite directions; if they do not, one is turned. The search is
// breadth first, from a first triangle of each part. A surface that cannot be oriented (a Klein bottle) keeps edges
// that checkClosedManifold reports.
void orient(SurfaceFromFile& surface) {
    TriangleMesh& mesh = surface.mesh;
    const std::size_t count = mesh.triangles.size();
    // Neighbours of each triangle, and whether they run through the common edge in the same direction, which is wrong.
    std::vector<std::vector<std::pair<int, bool>>> next(count);
    const std::vector<Side> sides = sidesOf(mesh);
    forEachEdge(sides, [&](std::size_t begin, std::size_t end) {
        if (end - begin != 2) return;
        const Side &p = sides[begin], &q = sides[begin + 1];
        next[static_cast<std::size_t>(p.triangle)].emplace_back(q.triangle, p.forward == q.forward);
        next[static_cast<std::size_t>(q.triangle)].emplace_back(p.triangle, p.forward == q.forward);
    });
    std::vector<int> turned(count, -1), queue;
    std::size_t number = 0;
    for (std::size_t start = 0; start < count; ++start) {
        if (turned[start] >= 0) continue;
        turned[start] = 0;
        queue.assign(1, static_cast<int>(start));
        for (std::size_t k = 0; k < queue.size(); ++k)
            for (const auto& [t, same] : next[static_cast<std::size_t>(queue[k])])
                if (turned[static_cast<std::size_t>(t)] < 0) {
                    turned[static_cast<std::size_t>(t)] = turned[static_cast<std::size_t>(queue[k])] ^ (same ? 1 : 0);
                    queue.push_back(t);
                }
    }
    const auto turn = [&](std::size_t t) { std::swap(mesh.triangles[t][1], mesh.triangles[t][2]); };
    for (std::size_t t = 0; t < count; ++t)
        if (turned[t] == 1) turn(t);
    TriangleMesh unit = mesh;  // of size 1, so that nothing overflows
    unit.scale(1 / surface.size);
    if (unit.volume() < 0)
        for (std::size_t t = 0; t < count; ++t) {
            turn(t);
            turned[t] ^= 1;
        }
    for (const int t : turned) number += static_cast<std::size_t>(t);
    if (number == count)
        surface.remarks.push_back(fmt::format("all {} triangles pointed inwards and were turned", count));
    else if (number > 0)
        surface.remarks.push_back(fmt::format("{} of {} triangles pointed inwards and {} turned", number, count,
                                              number > 1 ? "were" : "was"));
}

}  // namespace corpuscle::geometry
