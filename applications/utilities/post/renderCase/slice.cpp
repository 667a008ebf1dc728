#include "slice.hpp"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"

namespace corpuscle {
namespace {

constexpr double reach = 2.2, near = 1.3;  // in spacings
constexpr int mostPoints = 700;            // number of grid points along an axis

// The values shown for a particle or for a periodic image of it, whose velocity is greater by `slide`.
struct Source {
    std::vector<double> values;                     // empty: the values are velocities
    const std::vector<Vec3>* velocities = nullptr;  // if the particles have velocities
    int component = -1;                             // component of the velocity; -1: its magnitude
    bool nearest = false;
    // Cell of each particle, if values jump at membranes: only those on the side of the nearest particle then count.
    const std::vector<std::int64_t>* sides = nullptr;

    bool isBeside(std::size_t i, std::size_t closest) const { return !sides || (*sides)[i] == (*sides)[closest]; }
    Vec3 velocity(std::size_t i, const Vec3& slide) const { return (*velocities)[i] + slide; }
    double value(std::size_t i, const Vec3& slide) const {
        if (!values.empty()) return values[i];
        return component < 0 ? velocity(i, slide).norm() : velocity(i, slide)[component];
    }
};

Source sourceOf(const io::PolyData& fluid, const std::string& field) {
    const auto& arrays = fluid.point;
    const auto velocity = arrays.vectors.find("velocity");
    const bool moves = velocity != arrays.vectors.end();
    Source source;
    if (moves) source.velocities = &velocity->second;
    const std::string components = "uvw";
    if (moves && field.size() == 1 && components.find(field) != std::string::npos) {
        source.component = static_cast<int>(components.find(field));
    } else if (moves && (field == "speed" || field == "velocity")) {
        source.component = -1;
    } else if (const auto scalars = arrays.scalars.find(field); scalars != arrays.scalars.end()) {
        source.values = scalars->second;
        if (const auto side = arrays.integers.find("side"); side != arrays.integers.end()) source.sides = &side->second;
    } else if (const auto vectors = arrays.vectors.find(field); vectors != arrays.vectors.end()) {
        for (const Vec3& v : vectors->second) source.values.push_back(v.norm());
    } else if (const auto integers = arrays.integers.find(field); integers != arrays.integers.end()) {
        source.values.assign(integers->second.begin(), integers->second.end());
        source.nearest = true;
    } else {
        auto names = arrays.names();
        if (moves) names.insert(names.begin(), {"u", "v", "w", "speed"});
        throw Failure(ExitCode::usage, fmt::format("-fluidField {}: the fluid has no such array; there are: {}.{}",
                                                   field, joinWords(names), didYouMean(field, names)));
    }
    return source;
}

double spacingOf(const io::PolyData& fluid, const Vec3& size) {
    const auto found = fluid.point.scalars.find("spacing");
    if (found != fluid.point.scalars.end() && !found->second.empty() && found->second.front() > 0)
        return found->second.front();
    return std::cbrt(size.prod() / static_cast<double>(fluid.points.size()));
}

// The particles and images near a plane, sorted into squares of the size of the reach.
class NearPlane {
  public:
    struct Particle {
        Vec3 x;
        std::size_t source;
        Vec3 slide;  // of the image relative to the particle
    };

    NearPlane(const io::PolyData& fluid, const particles::Box& box, const SlicePlane& plane, double h)
        : plane_(plane), h_(h), x0_(box.low[plane.first()] - h), y0_(box.low[plane.second()] - h) {
        columns_ = 1 + static_cast<int>((box.size()[plane.first()] + 2 * h) / h);
        rows_ = 1 + static_cast<int>((box.size()[plane.second()] + 2 * h) / h);
        squares_.resize(static_cast<std::size_t>(columns_) * rows_);
        Vec3 low = box.low - Vec3::Constant(h), high = box.high + Vec3::Constant(h);
        low[plane.axis] = plane.position - h, high[plane.axis] = plane.position + h;
        const Periodicity periodicity = periodicityOf(fluid, box);
        for (std::size_t i = 0; i < fluid.points.size(); ++i) {
            const Vec3& x = fluid.points[i];
            periodicity.forImagesWithin(x, low, high, [&](const Vec3& image) {
                squares_[static_cast<std::size_t>(row(image)) * columns_ + column(image)].push_back(
                    {image, i, periodicity.slideOf(x, image)});
            });
        }
    }

    template <class Visit>
    void around(const Vec3& x, Visit&& visit) const {
        const int c = column(x), r = row(x);
        for (int j = std::max(r - 1, 0); j <= std::min(r + 1, rows_ - 1); ++j) {
            for (int i = std::max(c - 1, 0); i <= std::min(c + 1, columns_ - 1); ++i) {
                for (const Particle& p : squares_[static_cast<std::size_t>(j) * columns_ + i]) visit(p);
            }
        }
    }

  private:
    int column(const Vec3& x) const { return std::min(square(x[plane_.first()] - x0_), columns_ - 1); }
    int row(const Vec3& x) const { return std::min(square(x[plane_.second()] - y0_), rows_ - 1); }
    int square(double distance) const { return std::max(static_cast<int>(std::floor(distance / h_)), 0); }

    SlicePlane plane_;
    double h_, x0_, y0_;
    int columns_ = 0, rows_ = 0;
    std::vector<std::vector<Particle>> squares_;
};

struct Fit {
    double value = std::numeric_limits<double>::quiet_NaN();
    Vec3 velocity = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
};

Fit fitAt(const Vec3& x, const NearPlane& particles, double dx, const Source& source, bool withVelocity) {
    const double h = reach * dx;
    Eigen::Matrix4d moments = Eigen::Matrix4d::Zero();
    Eigen::Matrix4d sums = Eigen::Matrix4d::Zero();  // columns: value, then the three velocity components
    double closest = std::numeric_limits<double>::max();
    Fit fit;
    double closestValue = fit.value;
    std::size_t closestSource = 0;
    particles.around(x, [&](const NearPlane::Particle& p) {
        const double q = ((p.x - x) / h).norm();
        if (q >= closest) return;
        closest = q;
        closestValue = source.value(p.source, p.slide);
        closestSource = p.source;
    });
    if (closest * reach > near) return fit;
    particles.around(x, [&](const NearPlane::Particle& p) {
        const Vec3 d = (p.x - x) / h;
        const double q = d.norm();
        if (q >= 1 || !source.isBeside(p.source, closestSource)) return;
        const double w = std::pow(1 - q, 4) * (4 * q + 1);
        const Eigen::Vector4d basis(1, d[0], d[1], d[2]);
        moments += w * basis * basis.transpose();
        sums.col(0) += w * basis * source.value(p.source, p.slide);
        if (withVelocity) sums.rightCols<3>() += w * basis * source.velocity(p.source, p.slide).transpose();
    });
    if (moments(0, 0) <= 0) return fit;
    const Eigen::LDLT<Eigen::Matrix4d> solver(moments);
    const bool determined = solver.info() == Eigen::Success && solver.vectorD().minCoeff() > 1e-3 * moments(0, 0);
    const Eigen::Vector4d first = determined ? Eigen::Vector4d(solver.solve(sums).row(0).transpose())
                                             : Eigen::Vector4d(sums.row(0).transpose() / moments(0, 0));
    fit.value = source.nearest ? closestValue : first[0];
    fit.velocity = first.tail<3>();
    return fit;
}

}  // namespace

Periodicity periodicityOf(const io::PolyData& data, const particles::Box& box) {
    Periodicity periodicity = box.periodicity();
    const auto axis = data.field.find("slidingAxis");
    if (axis == data.field.end() || !periodicity.isAlong(static_cast<int>(axis->second))) return periodicity;
    periodicity.slide(static_cast<int>(axis->second), Vec3(data.field.at("imageOffset"), 0, 0),
                      Vec3(data.field.at("imageVelocity"), 0, 0));
    return periodicity;
}

Vec3 Slice::place(int column, int row) const {
    Vec3 x;
    x[plane.axis] = plane.position;
    x[plane.first()] = x0 + column * dx;
    x[plane.second()] = y0 + row * dy;
    return x;
}

Slice sampleSlice(const io::PolyData& fluid, const std::optional<particles::Box>& box, const SlicePlane& plane,
                  const std::string& field, bool withVelocity) {
    const Source source = sourceOf(fluid, field);
    if (withVelocity && !source.velocities)
        throw Failure(ExitCode::usage, "-arrows: the fluid has no array 'velocity'; add it to write.fields.");

    particles::Box extent;
    if (box) {
        extent = *box;
    } else {
        extent.low = Vec3::Constant(std::numeric_limits<double>::max());
        extent.high = -extent.low;
        for (const Vec3& x : fluid.points) {
            extent.low = extent.low.cwiseMin(x);
            extent.high = extent.high.cwiseMax(x);
        }
    }
    Slice slice;
    slice.plane = plane;
    if (fluid.points.empty()) return slice;
    const double dx = spacingOf(fluid, extent.size());
    const NearPlane particles(fluid, extent, plane, reach * dx);
    const auto intervals = [&](int axis) {
        return std::clamp(static_cast<int>(std::ceil(2 * extent.size()[axis] / dx)), 1, mostPoints - 1);
    };
    slice.columns = intervals(plane.first()) + 1;
    slice.rows = intervals(plane.second()) + 1;
    slice.x0 = extent.low[plane.first()];
    slice.y0 = extent.low[plane.second()];
    slice.dx = extent.size()[plane.first()] / (slice.columns - 1);
    slice.dy = extent.size()[plane.second()] / (slice.rows - 1);
    for (int row = 0; row < slice.rows; ++row) {
        for (int column = 0; column < slice.columns; ++column) {
            const Fit fit = fitAt(slice.place(column, row), particles, dx, source, withVelocity);
            slice.values.push_back(fit.value);
            if (withVelocity) slice.velocity.push_back(fit.velocity);
        }
    }
    return slice;
}

}  // namespace corpuscle
