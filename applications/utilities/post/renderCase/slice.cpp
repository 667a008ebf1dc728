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
constexpr int mostPoints = 700;            // of the grid along an axis

struct Source {
    std::vector<double> values;
    bool nearest = false;
};

Source sourceOf(const io::PolyData& fluid, const std::string& field) {
    const auto& arrays = fluid.point;
    const auto velocity = arrays.vectors.find("velocity");
    const bool moves = velocity != arrays.vectors.end();
    Source source;
    const std::string components = "uvw";
    if (moves && field.size() == 1 && components.find(field) != std::string::npos) {
        for (const Vec3& v : velocity->second) source.values.push_back(v[static_cast<int>(components.find(field))]);
    } else if (moves && (field == "speed" || field == "velocity")) {
        for (const Vec3& v : velocity->second) source.values.push_back(v.norm());
    } else if (const auto scalars = arrays.scalars.find(field); scalars != arrays.scalars.end()) {
        source.values = scalars->second;
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

// The particles, and images of those at periodic faces, near a plane, in squares of the reach.
class NearPlane {
  public:
    struct Particle {
        Vec3 x;
        int source;
    };

    NearPlane(const io::PolyData& fluid, const particles::Box& box, const SlicePlane& plane, double h)
        : plane_(plane), h_(h), x0_(box.low[plane.first()] - h), y0_(box.low[plane.second()] - h) {
        columns_ = 1 + static_cast<int>((box.size()[plane.first()] + 2 * h) / h);
        rows_ = 1 + static_cast<int>((box.size()[plane.second()] + 2 * h) / h);
        squares_.resize(static_cast<std::size_t>(columns_) * rows_);
        for (std::size_t i = 0; i < fluid.points.size(); ++i)
            add(box.periodicity().wrap(fluid.points[i]), static_cast<int>(i), box, 0);
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
    int column(const Vec3& x) const { return static_cast<int>(std::floor((x[plane_.first()] - x0_) / h_)); }
    int row(const Vec3& x) const { return static_cast<int>(std::floor((x[plane_.second()] - y0_) / h_)); }
    // The particle with its images along axis k and those after it.
    void add(const Vec3& x, int source, const particles::Box& box, int k) {
        if (k == 3) {
            if (std::abs(x[plane_.axis] - plane_.position) > h_) return;
            const int c = column(x), r = row(x);
            if (c < 0 || c >= columns_ || r < 0 || r >= rows_) return;
            squares_[static_cast<std::size_t>(r) * columns_ + c].push_back({x, source});
            return;
        }
        add(x, source, box, k + 1);
        if (!box.periodic[k]) return;
        const double length = box.size()[k];
        Vec3 image = x;
        image[k] += x[k] < box.low[k] + h_ ? length : -length;
        if (image[k] > box.low[k] - h_ && image[k] < box.high[k] + h_) add(image, source, box, k + 1);
    }

    SlicePlane plane_;
    double h_, x0_, y0_;
    int columns_ = 0, rows_ = 0;
    std::vector<std::vector<Particle>> squares_;
};

struct Fit {
    double value = std::numeric_limits<double>::quiet_NaN();
    Vec3 velocity = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
};

Fit fitAt(const Vec3& x, const NearPlane& particles, double dx, const Source& source,
          const std::vector<Vec3>* velocity) {
    const double h = reach * dx;
    Eigen::Matrix4d moments = Eigen::Matrix4d::Zero();
    Eigen::Matrix4d sums = Eigen::Matrix4d::Zero();  // columns: value, velocity
    double closest = std::numeric_limits<double>::max();
    int closestSource = -1;
    particles.around(x, [&](const NearPlane::Particle& p) {
        const Vec3 d = (p.x - x) / h;
        const double q = d.norm();
        if (q < closest) {
            closest = q;
            closestSource = p.source;
        }
        if (q >= 1) return;
        const double w = std::pow(1 - q, 4) * (4 * q + 1);
        const Eigen::Vector4d basis(1, d[0], d[1], d[2]);
        moments += w * basis * basis.transpose();
        sums.col(0) += w * basis * source.values[static_cast<std::size_t>(p.source)];
        if (velocity)
            for (int k = 0; k < 3; ++k)
                sums.col(1 + k) += w * basis * (*velocity)[static_cast<std::size_t>(p.source)][k];
    });
    Fit fit;
    if (closest * reach > near || moments(0, 0) <= 0) return fit;
    const Eigen::LDLT<Eigen::Matrix4d> solver(moments);
    const bool determined = solver.info() == Eigen::Success && solver.vectorD().minCoeff() > 1e-3 * moments(0, 0);
    const Eigen::Vector4d first = determined ? Eigen::Vector4d(solver.solve(sums).row(0).transpose())
                                             : Eigen::Vector4d(sums.row(0).transpose() / moments(0, 0));
    fit.value = source.nearest ? source.values[static_cast<std::size_t>(closestSource)] : first[0];
    fit.velocity = first.tail<3>();
    return fit;
}

}  // namespace

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
    const auto velocity = fluid.point.vectors.find("velocity");
    if (withVelocity && velocity == fluid.point.vectors.end())
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
            const Fit fit =
                fitAt(slice.place(column, row), particles, dx, source, withVelocity ? &velocity->second : nullptr);
            slice.values.push_back(fit.value);
            if (withVelocity) slice.velocity.push_back(fit.velocity);
        }
    }
    return slice;
}

}  // namespace corpuscle
