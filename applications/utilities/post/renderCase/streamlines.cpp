#include "streamlines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

#include "core/error.hpp"
#include "core/units.hpp"
#include "interpolation.hpp"

namespace corpuscle {
namespace {

constexpr double stepPerSpacing = 0.25;

// The flow in the box and in its periodic images.
class Flow {
  public:
    Flow(const io::PolyData& fluid, const particles::Box& box, const boundary::Walls& walls, const std::string& field)
        : box_(box), walls_(walls), interpolation_(fluid, box, field, box.low, box.high) {
        for (int k = 0; k < 3; ++k) periodic_[static_cast<std::size_t>(k)] = box.periodic[static_cast<std::size_t>(k)];
        if (const Periodicity images = periodicityOf(fluid, box); images.slides())
            periodic_[static_cast<std::size_t>(images.slidingAxis())] = false;
        periodicity_ = Periodicity(box.low, box.high, periodic_);
    }
    const Periodicity& periodicity() const { return periodicity_; }  // images that do not slide
    const Interpolation& interpolation() const { return interpolation_; }

    Vec3 velocity(const Vec3& x) const {
        const Vec3 inside = periodicity_.wrap(x);
        return isInside(inside) ? interpolation_.at(inside).velocity : Interpolation::Values().velocity;
    }

  private:
    bool isInside(const Vec3& x) const {
        for (int k = 0; k < 3; ++k)
            if (!periodicity_.isAlong(k) && !(x[k] >= box_.low[k] && x[k] < box_.high[k])) return false;
        return !walls_.exist() || walls_.distance(x) > 0;
    }

    const particles::Box& box_;
    const boundary::Walls& walls_;
    Interpolation interpolation_;
    std::array<bool, 3> periodic_{};
    Periodicity periodicity_;
};

// Points of a fine regular grid over the section, or along a line in it, where there is fluid.
std::vector<Vec3> placesInFluid(const Flow& flow, const particles::Box& box, const Seeds& seeds) {
    constexpr double placesPerSeed = 25, leastPlaces = 2500;
    std::vector<int> axes;
    for (const int axis : {seeds.section.first(), seeds.section.second()})
        if (!seeds.within || seeds.within->axis != axis) axes.push_back(axis);
    double area = 1;
    for (const int axis : axes) area *= box.size()[axis];
    const double pitch =
        std::pow(area / std::max(leastPlaces, placesPerSeed * seeds.count), 1.0 / static_cast<double>(axes.size()));
    int count[3] = {1, 1, 1};
    for (const int axis : axes) count[axis] = std::max(1, static_cast<int>(std::lround(box.size()[axis] / pitch)));
    std::vector<Vec3> places;
    Vec3 x;
    x[seeds.section.axis] = seeds.section.position;
    if (seeds.within) x[seeds.within->axis] = seeds.within->position;
    const int a = axes.front(), b = axes.back();
    for (int j = 0; j < (a == b ? 1 : count[b]); ++j) {
        for (int i = 0; i < count[a]; ++i) {
            x[b] = box.low[b] + (j + 0.5) * box.size()[b] / count[b];
            x[a] = box.low[a] + (i + 0.5) * box.size()[a] / count[a];
            if (flow.velocity(x).allFinite()) places.push_back(x);
        }
    }
    return places;
}

double extentAlong(const std::vector<Vec3>& places, int axis) {
    const auto [low, high] = std::minmax_element(places.begin(), places.end(),
                                                 [&](const Vec3& a, const Vec3& b) { return a[axis] < b[axis]; });
    return (*high)[axis] - (*low)[axis];
}

// The place nearest to the mean of these.
Vec3 middleOf(std::span<const Vec3> places) {
    const Vec3 mean =
        std::accumulate(places.begin(), places.end(), Vec3(Vec3::Zero())) / static_cast<double>(places.size());
    return *std::min_element(places.begin(), places.end(), [&](const Vec3& a, const Vec3& b) {
        return (a - mean).squaredNorm() < (b - mean).squaredNorm();
    });
}

// Cuts the line at periodic faces and moves each piece into the box.
std::vector<DrawnLine::Piece> piecesOf(const Streamline& line, const Flow& flow, const particles::Box& box) {
    std::vector<DrawnLine::Piece> pieces;
    Vec3 shift = Vec3::Zero();
    const auto add = [&](const Vec3& x) {
        pieces.back().points.push_back(x);
        pieces.back().values.push_back(flow.interpolation().at(x).field);
    };
    for (std::size_t i = 1; i < line.points.size(); ++i) {
        const Vec3 from = line.points[i - 1], move = line.points[i] - from;
        std::vector<double> parts{0, 1};  // of the step, at its ends and at faces
        for (int k = 0; k < 3; ++k) {
            const double period = flow.periodicity().lengths()[k];
            if (!(period > 0) || move[k] == 0) continue;
            const double upper = std::max(from[k], from[k] + move[k]) - box.low[k];
            const double part = (box.low[k] + std::floor(upper / period) * period - from[k]) / move[k];
            if (part > 0 && part < 1) parts.push_back(part);
        }
        std::sort(parts.begin(), parts.end());
        for (std::size_t p = 1; p < parts.size(); ++p) {
            const Vec3 middle = from + 0.5 * (parts[p - 1] + parts[p]) * move;
            const Vec3 here = flow.periodicity().wrap(middle) - middle;
            if (pieces.empty() || (here - shift).norm() > 0.5 * stepPerSpacing * flow.interpolation().spacing()) {
                pieces.emplace_back();
                add(from + parts[p - 1] * move + here);
            }
            shift = here;
            add(from + parts[p] * move + here);
        }
    }
    return pieces;
}

}  // namespace

std::vector<Vec3> spread(std::vector<Vec3> places, const Plane& section, int count) {
    const int along = section.first(), across = section.second();
    const double width = extentAlong(places, along), height = extentAlong(places, across);
    const double ratio = width > 0 ? height / width : count;
    const int rows = std::clamp(static_cast<int>(std::lround(std::sqrt(count * ratio))), 1, count);
    const auto sort = [](auto first, auto last, int axis) {
        std::stable_sort(first, last, [axis](const Vec3& a, const Vec3& b) { return a[axis] < b[axis]; });
    };
    const auto upTo = [&](int seed) { return places.size() * static_cast<std::size_t>(seed) / count; };
    sort(places.begin(), places.end(), across);
    std::vector<Vec3> seeds;
    for (int row = 0; row < rows; ++row) {
        const int first = count * row / rows, last = count * (row + 1) / rows;
        sort(places.begin() + upTo(first), places.begin() + upTo(last), along);
        for (int seed = first; seed < last; ++seed)
            seeds.push_back(middleOf(std::span(places).subspan(upTo(seed), upTo(seed + 1) - upTo(seed))));
    }
    return seeds;
}

std::vector<DrawnLine> streamlinesOf(const io::PolyData& fluid, const std::optional<particles::Box>& box,
                                     const boundary::Walls& walls, const Seeds& seeds, const std::string& field) {
    const std::string words = fmt::format("-streamlines {}", seeds.count);
    if (!fluid.point.vectors.contains("velocity"))
        throw Failure(ExitCode::usage,
                      fmt::format("{}: the fluid has no array 'velocity'; add it to write.fields.", words));
    if (fluid.points.empty()) return {};
    const particles::Box extent = extentOf(fluid, box);
    const Flow flow(fluid, extent, walls, field);
    const std::vector<Vec3> places = placesInFluid(flow, extent, seeds);
    if (places.size() < static_cast<std::size_t>(seeds.count))
        throw Failure(ExitCode::usage,
                      fmt::format("{}: there is {} fluid at {} = {}; choose another plane by -seeds.", words,
                                  places.empty() ? "no" : "too little", seeds.section.axisName(),
                                  formatQuantity(seeds.section.position, unit::metre)));
    const Tracing tracing{stepPerSpacing * flow.interpolation().spacing(), extent.size().sum(),
                          flow.periodicity().lengths()};
    std::vector<DrawnLine> lines;
    for (const Vec3& seed : spread(places, seeds.section, seeds.count)) {
        DrawnLine line;
        line.course = trace([&](const Vec3& x) { return flow.velocity(x); }, seed, tracing);
        line.pieces = piecesOf(line.course, flow, extent);
        lines.push_back(std::move(line));
    }
    return lines;
}

}  // namespace corpuscle
