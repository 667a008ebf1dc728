#include "boundary/surfaceWalls.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>

#include "core/error.hpp"
#include "core/units.hpp"
#include "geometry/readSurface.hpp"

namespace corpuscle::boundary {

namespace {

using geometry::TriangleMesh;

constexpr double atEnd = 1e-4;  // how far an opening may lie from the end of the box, over the length of the box
constexpr double alikeWithin =
    2e-3;  // of the areas of two openings, and of the places of their middles over their size
constexpr double slowestMode = 2.4048;  // first zero of the Bessel function J0

Eigen::AlignedBox3d boxOf(const TriangleMesh& mesh) {
    Eigen::AlignedBox3d box;
    for (const Vec3& x : mesh.nodes) box.extend(x);
    return box;
}

std::string placeText(const Vec3& x) {
    return fmt::format("({:.4g}, {:.4g}, {:.4g}) um", 1e6 * x[0], 1e6 * x[1], 1e6 * x[2]);
}

// Edges by the number of their triangles: what is open, and what more than two triangles share.
struct Edges {
    std::vector<std::pair<int, int>> open, shared;
    explicit Edges(const TriangleMesh& mesh) {
        std::map<std::pair<int, int>, int> count;
        for (const Index3& t : mesh.triangles)
            for (std::size_t s = 0; s < 3; ++s) ++count[std::minmax(t[s], t[(s + 1) % 3])];
        for (const auto& [edge, number] : count)
            if (number == 1)
                open.push_back(edge);
            else if (number > 2)
                shared.push_back(edge);
    }
};

// The openings at one end, as the closed polygons of their edges: length, area, and means of y, z and of their products
// over the length.
struct Opening {
    double area = 0, length = 0;
    Vec3 middle = Vec3::Zero(), squares = Vec3::Zero();
    void add(const Vec3& a, const Vec3& b) {
        const double part = (b - a).norm();
        const Vec3 m = 0.5 * (a + b);
        length += part, middle += part * Vec3(0, m[1], m[2]);
        squares += part * Vec3(m[1] * m[1], m[2] * m[2], m[1] * m[2]);
    }
    void finish() {
        if (length > 0) middle /= length, squares /= length;
    }
};

// Turns each part of the surface, a set of triangles with common nodes, outwards, or inwards if it lies within an odd
// number of other parts, as an obstacle in a vessel does.
void orientParts(TriangleMesh& mesh) {
    std::vector<int> parent(mesh.nodes.size());
    std::iota(parent.begin(), parent.end(), 0);
    const auto root = [&](int n) {
        while (parent[static_cast<std::size_t>(n)] != n) {
            int& next = parent[static_cast<std::size_t>(n)];
            n = next = parent[static_cast<std::size_t>(next)];
        }
        return n;
    };
    for (const Index3& t : mesh.triangles)
        for (std::size_t s = 1; s < 3; ++s) parent[static_cast<std::size_t>(root(t[s]))] = root(t[0]);
    std::map<int, std::vector<std::size_t>> parts;  // triangles, by the root of their nodes
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) parts[root(mesh.triangles[t][0])].push_back(t);
    const auto turn = [&](const std::vector<std::size_t>& part) {
        for (const std::size_t t : part) std::swap(mesh.triangles[t][1], mesh.triangles[t][2]);
    };
    std::vector<geometry::TriangleTree> outwards;  // of each part
    for (const auto& [node, part] : parts) {
        TriangleMesh alone{mesh.nodes, {}};
        for (const std::size_t t : part) alone.triangles.push_back(mesh.triangles[t]);
        if (volumeWithin(alone) < 0) alone.flip(), turn(part);
        if (parts.size() > 1) outwards.emplace_back(alone, std::numeric_limits<double>::infinity());
    }
    if (parts.size() == 1) return;
    std::size_t number = 0;
    for (const auto& [node, part] : parts) {
        const Vec3& x = mesh.nodes[static_cast<std::size_t>(mesh.triangles[part.front()][0])];
        bool isWithin = false;
        for (std::size_t other = 0; other < outwards.size(); ++other)
            if (other != number && outwards[other].nearest(x).distance < 0) isWithin = !isWithin;
        if (isWithin) turn(part);
        ++number;
    }
}

}  // namespace

const Schema<SurfaceWalls>& SurfaceWalls::schema() {
    static const Schema<SurfaceWalls> s =
        Schema<SurfaceWalls>("surface", "walls from a surface file: a vessel along x, or obstacles")
            .text("file", &SurfaceWalls::file, "STL, OFF, PLY or VTP file, relative to the case")
            .quantity("scale", &SurfaceWalls::scale, unit::metre, "length of one unit of the file",
                      {.fallback = "1 um", .range = positive})
            .word("fluid", &SurfaceWalls::fluid, {"inside", "outside"},
                  "inside: a vessel along x; outside: obstacles in a periodic box", {.fallback = "inside"})
            .word("at", &SurfaceWalls::at, {"middle", "asWritten"},
                  "middle: the surface is moved to the middle of the box; asWritten: the origin of the file is there",
                  {.fallback = "middle"});
    return s;
}

void SurfaceWalls::prepare(const std::filesystem::path& caseDirectory) const {
    auto [mesh, size, remarks] = geometry::readSurface(caseDirectory / file);
    if (mesh.triangles.empty()) throw Failure(ExitCode::invalidCase, file + ": the surface has no triangles");
    mesh.scale(scale);
    orientParts(mesh);
    remarks_.clear();
    for (const std::string& remark : remarks) remarks_.push_back(file + ": " + remark);
    mesh_ = std::make_shared<const TriangleMesh>(std::move(mesh));
}

TriangleMesh SurfaceWalls::in(const particles::Box& box) const {
    if (!mesh_) throw Failure(ExitCode::invalidCase, fmt::format("the surface {} was not read (prepare)", file));
    TriangleMesh mesh = *mesh_;
    mesh.translate(at == "middle" ? Vec3(box.middle() - boxOf(mesh).center()) : box.middle());
    return mesh;
}

void SurfaceWalls::check(const particles::Box& box, const Mark& mark, Problems& problems) const {
    const TriangleMesh mesh = in(box);
    const Eigen::AlignedBox3d bounds = boxOf(mesh);
    const Vec3 room = box.size();
    bool isBeyond = false;
    const auto add = [&](const std::string& text) { problems.add(mark, "walls.file", file + ": " + text); };
    for (int k = 0; k < 3; ++k) {
        const double over = std::max(box.low[k] - bounds.min()[k], bounds.max()[k] - box.high[k]);
        if (over <= atEnd * room[k]) continue;
        const double size = bounds.sizes()[k];
        std::string cure = "make the box of system/mesh.yaml larger";
        for (const double one : {1e-9, 1e-6, 1e-3, 1e-2, 1.0})
            if (const double other = size / scale * one;
                one != scale && other <= room[k] * (1 + atEnd) && other >= 0.1 * room[k])
                cure += fmt::format(", or, if the file counts in other units, write 'scale: {}'",
                                    formatQuantity(one, unit::metre));
        if (size <= room[k]) cure = "write 'at: middle'";
        add(fmt::format("the surface reaches from {} to {} along {}, beyond the box, {} to {}; {}",
                        formatQuantity(bounds.min()[k], unit::metre), formatQuantity(bounds.max()[k], unit::metre),
                        "xyz"[k], formatQuantity(box.low[k], unit::metre), formatQuantity(box.high[k], unit::metre),
                        cure));
        isBeyond = true;
        break;
    }
    const Edges edges(mesh);
    const auto nodeOf = [&](int n) -> const Vec3& { return mesh.nodes[static_cast<std::size_t>(n)]; };
    if (!edges.shared.empty())
        add(
            fmt::format("{} edges belong to more than two triangles (first: at {}); make each part of the surface a "
                        "surface with two sides",
                        edges.shared.size(), placeText(nodeOf(edges.shared.front().first))));
    Opening ends[2];
    std::size_t loose = 0;
    Vec3 first = Vec3::Zero();
    for (const auto& [i, j] : edges.open) {
        const Vec3 &a = nodeOf(i), &b = nodeOf(j);
        const auto isAt = [&](double end) {
            return isInside() && std::max(std::abs(a[0] - end), std::abs(b[0] - end)) <= atEnd * room[0];
        };
        if (isAt(box.low[0]))
            ends[0].add(a, b);
        else if (isAt(box.high[0]))
            ends[1].add(a, b);
        else if (loose++ == 0)
            first = 0.5 * (a + b);
    }
    if (loose > 0 && !isBeyond)
        add(fmt::format(
            "{} edges are open (first: at {}){}; close the surface there, as with a cap that is missing", loose,
            placeText(first),
            isInside() ? fmt::format(" and do not lie at the ends of the box, x = {} and {}",
                                     formatQuantity(box.low[0], unit::metre), formatQuantity(box.high[0], unit::metre))
                       : ""));
    if (isInside() && loose == 0 && !isBeyond && !(ends[0].length > 0 && ends[1].length > 0)) {
        const bool none = ends[0].length + ends[1].length == 0;
        add(fmt::format(
            "the surface is {} at the end{} of the box, x = {}, so that nothing can flow along x; open it "
            "there",
            none ? "closed" : "open at one end only and closed", none ? "s" : "",
            none ? formatQuantity(box.low[0], unit::metre) + " and " + formatQuantity(box.high[0], unit::metre)
                 : formatQuantity(ends[0].length > 0 ? box.high[0] : box.low[0], unit::metre)));
    } else if (isInside() && loose == 0 && !isBeyond) {
        const double inset = 1.1 * atEnd * room[0];
        for (int side = 0; side < 2; ++side) {
            ends[side].area = sectionAt(mesh, side == 0 ? box.low[0] + inset : box.high[0] - inset).area;
            ends[side].finish();
        }
        const Vec3 apart = ends[1].middle - ends[0].middle;
        const double larger = std::max(ends[0].area, ends[1].area);
        if (std::abs(ends[0].area - ends[1].area) > alikeWithin * larger ||
            apart.norm() > alikeWithin * std::sqrt(larger) ||
            (ends[0].squares - ends[1].squares).norm() > alikeWithin * larger)
            add(
                fmt::format("its two ends do not fit together, as they must where the vessel meets its periodic "
                            "images: the openings at x = {} and {} have {:.5g} and {:.5g} um^2, and middles {} apart; "
                            "make both of the same shape, at the same y "
                            "and z",
                            formatQuantity(box.low[0], unit::metre), formatQuantity(box.high[0], unit::metre),
                            1e12 * ends[0].area, 1e12 * ends[1].area, formatQuantity(apart.norm(), unit::metre)));
    }
    if (const auto crossing = geometry::selfIntersections(mesh); !crossing.empty())
        add(fmt::format("{} pairs of triangles cross each other (first: at {}); unite the parts into one surface",
                        crossing.size(),
                        placeText(nodeOf(mesh.triangles[static_cast<std::size_t>(crossing.front().first)][0]))));
}

Walls SurfaceWalls::place(const particles::Box& box) const {
    Walls walls;
    walls.add(isInside() ? "vessel" : "obstacle",
              std::make_shared<TriangleSurface>(in(box), isInside() ? FluidSide::inside : FluidSide::outside, box));
    return walls;
}

double SurfaceWalls::volume(const particles::Box& box) const {
    const double within = volumeWithin(in(box));
    return isInside() ? within : box.volume() - within;
}

// Steiner's formula for a surface at distance d, without its last term.
double SurfaceWalls::volumeBehind(const particles::Box& box, const Vec3& depth) const {
    const TriangleMesh mesh = in(box);
    const double d = depth.maxCoeff(), turn = meanCurvature(mesh) * d * d;
    return isInside() ? mesh.area() * d + turn : std::min(volumeWithin(mesh), mesh.area() * d - turn);
}

Hydraulics SurfaceWalls::hydraulics(const particles::Box& box) const {
    const TriangleMesh mesh = in(box);
    constexpr int slices = 101;
    const double step = box.size()[0] / slices, whole = box.volume() / box.size()[0];
    double resistance = 0, leastArea = whole;
    Hydraulics found;
    found.width = std::cbrt(box.volume());
    double widest = 0;
    for (int k = 0; k < slices; ++k) {
        const Section section = sectionAt(mesh, box.low[0] + (k + 0.5) * step);
        const double area = isInside() ? section.area : whole - section.area;
        if (!(section.perimeter > 0 && area > 0)) continue;
        const double radius = 2 * area / section.perimeter;
        resistance += 8 / (area * radius * radius * slices);
        leastArea = std::min(leastArea, area);
        found.width = std::min(found.width, radius), widest = std::max(widest, radius);
    }
    if (resistance > 0) found.fastest = 2 / (resistance * leastArea);
    found.settling = std::pow(widest / slowestMode, 2);
    return found;
}

CORPUSCLE_REGISTER(WallShape, SurfaceWalls, "surface", "walls from a surface file: a vessel, or obstacles");

}  // namespace corpuscle::boundary
