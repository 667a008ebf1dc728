#include "geometry/flatSheet.hpp"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <numbers>
#include <random>

#include "core/error.hpp"

namespace corpuscle::geometry {
namespace {

int countOf(double length, double edge) { return std::max(1, static_cast<int>(std::lround(length / edge))); }

void checkEdge(double edge, double greatest) {
    if (!(edge > 0 && edge <= greatest))
        throw Failure(
            ExitCode::invalidCase,
            fmt::format("edge = {:.4g} um does not suit a sheet of this size: take more than 0 and at most {:.4g} um",
                        edge * 1e6, greatest * 1e6));
}

// Nodes of one row: the number of the first, and the position of each along the row.
struct Line {
    int first;
    std::vector<double> place;
};

// Adds the triangles between two open lines, `upper` on the left of `lower`: beginning at both starts, the line whose
// next node comes first advances.
void join(const Line& lower, const Line& upper, std::vector<Index3>& triangles) {
    std::size_t i = 0, j = 0;
    const auto node = [](const Line& line, std::size_t k) { return line.first + static_cast<int>(k); };
    while (i + 1 < lower.place.size() || j + 1 < upper.place.size()) {
        const bool below =
            j + 1 == upper.place.size() ||
            (i + 1 < lower.place.size() && lower.place[i + 1] + lower.place[i] <= upper.place[j + 1] + upper.place[j]);
        if (below) {
            triangles.push_back({node(lower, i), node(lower, i + 1), node(upper, j)});
            ++i;
        } else {
            triangles.push_back({node(lower, i), node(upper, j + 1), node(upper, j)});
            ++j;
        }
    }
}

}  // namespace

TriangleMesh rectangle(double sizeX, double sizeY, double edge) {
    checkEdge(edge, 0.5 * std::min(sizeX, sizeY));
    const int columns = countOf(sizeX, edge), rows = countOf(sizeY, std::sqrt(0.75) * edge);
    TriangleMesh mesh;
    Line previous{0, {}};
    for (int row = 0; row <= rows; ++row) {
        Line line{static_cast<int>(mesh.nodes.size()), {}};
        if (row % 2 == 0) {
            for (int k = 0; k <= columns; ++k) line.place.push_back(k);
        } else {
            line.place.push_back(0);
            for (int k = 0; k < columns; ++k) line.place.push_back(k + 0.5);
            line.place.push_back(columns);
        }
        for (const double x : line.place)
            mesh.nodes.emplace_back((x / columns - 0.5) * sizeX, (static_cast<double>(row) / rows - 0.5) * sizeY, 0);
        if (row > 0) join(previous, line, mesh.triangles);
        previous = std::move(line);
    }
    return mesh;
}

TriangleMesh disc(double radius, double edge) {
    checkEdge(edge, 0.5 * radius);
    const int rings = countOf(radius, edge);
    TriangleMesh mesh;
    mesh.nodes.emplace_back(0, 0, 0);
    for (int ring = 1; ring <= rings; ++ring) {
        const int inner = ring == 1 ? 0 : 1 + 3 * (ring - 2) * (ring - 1), outer = static_cast<int>(mesh.nodes.size());
        for (int k = 0; k < 6 * ring; ++k) {
            const double angle = 2 * std::numbers::pi * k / (6 * ring);
            mesh.nodes.push_back(radius * ring / rings * Vec3(std::cos(angle), std::sin(angle), 0));
        }
        // Six equal sectors: `ring` edges outside, one less inside.
        for (int sector = 0; sector < 6; ++sector) {
            const auto in = [&](int k) { return ring == 1 ? 0 : inner + (sector * (ring - 1) + k) % (6 * (ring - 1)); };
            const auto out = [&](int k) { return outer + (sector * ring + k) % (6 * ring); };
            for (int k = 0; k < ring; ++k) {
                mesh.triangles.push_back({out(k), out(k + 1), in(k)});
                if (k + 1 < ring) mesh.triangles.push_back({in(k), out(k + 1), in(k + 1)});
            }
        }
    }
    return mesh;
}

void disorder(TriangleMesh& sheet, double amplitude, unsigned long seed) {
    std::map<std::pair<int, int>, int> sides;
    double length = 0;
    for (const Index3& t : sheet.triangles)
        for (int k = 0; k < 3; ++k) {
            ++sides[std::minmax(t[k], t[(k + 1) % 3])];
            length += (sheet.nodes[t[k]] - sheet.nodes[t[(k + 1) % 3]]).norm();
        }
    length /= 3 * static_cast<double>(sheet.triangles.size());
    std::vector<char> border(sheet.nodes.size(), 0);
    for (const auto& [edge, count] : sides)
        if (count == 1) border[edge.first] = border[edge.second] = 1;
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> part(-amplitude * length, amplitude * length);
    for (std::size_t n = 0; n < sheet.nodes.size(); ++n) {
        const Vec3 step(part(random), part(random), 0);
        if (!border[n]) sheet.nodes[n] += step;
    }
}

}  // namespace corpuscle::geometry
