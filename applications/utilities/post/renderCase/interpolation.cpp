#include "interpolation.hpp"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "core/error.hpp"

namespace corpuscle {
namespace {

constexpr double reach = 2.2, near = 1.3;  // in spacings

double spacingOf(const io::PolyData& fluid, const Vec3& size) {
    const auto found = fluid.point.scalars.find("spacing");
    if (found != fluid.point.scalars.end() && !found->second.empty() && found->second.front() > 0)
        return found->second.front();
    return std::cbrt(size.prod() / static_cast<double>(fluid.points.size()));
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

particles::Box extentOf(const io::PolyData& fluid, const std::optional<particles::Box>& box) {
    if (box) return *box;
    particles::Box extent;
    extent.low = Vec3::Constant(std::numeric_limits<double>::max());
    extent.high = -extent.low;
    for (const Vec3& x : fluid.points) {
        extent.low = extent.low.cwiseMin(x);
        extent.high = extent.high.cwiseMax(x);
    }
    return extent;
}

Interpolation::Source Interpolation::sourceOf(const io::PolyData& fluid, const std::string& field) {
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

Interpolation::Interpolation(const io::PolyData& fluid, const particles::Box& extent, const std::string& field,
                             const Vec3& low, const Vec3& high)
    : source_(sourceOf(fluid, field)),
      spacing_(spacingOf(fluid, extent.size())),
      h_(reach * spacing_),
      origin_(low - Vec3::Constant(h_)) {
    const Vec3 end = high + Vec3::Constant(h_);
    std::size_t cubes = 1;
    for (std::size_t k = 0; k < 3; ++k) {
        const auto axis = static_cast<int>(k);
        count_[k] = 1 + static_cast<int>((end[axis] - origin_[axis]) / h_);
        cubes *= static_cast<std::size_t>(count_[k]);
    }
    cubes_.resize(cubes);
    const Periodicity periodicity = periodicityOf(fluid, extent);
    for (std::size_t i = 0; i < fluid.points.size(); ++i) {
        const Vec3& x = fluid.points[i];
        periodicity.forImagesWithin(x, origin_, end, [&](const Vec3& image) {
            const Index3 c = cubeOf(image);
            cube(c[0], c[1], c[2]).push_back({image, i, periodicity.slideOf(x, image)});
        });
    }
}

Index3 Interpolation::cubeOf(const Vec3& x) const {
    Index3 c{};
    for (std::size_t k = 0; k < 3; ++k) {
        const double place = (x - origin_)[static_cast<int>(k)] / h_;
        c[k] = std::clamp(static_cast<int>(std::floor(place)), 0, count_[k] - 1);
    }
    return c;
}

std::vector<Interpolation::Particle>& Interpolation::cube(int i, int j, int k) {
    return cubes_[(static_cast<std::size_t>(k) * count_[1] + j) * count_[0] + i];
}

// Visits the particles of the cubes around x, which include all within h.
template <class Visit>
void Interpolation::around(const Vec3& x, Visit&& visit) const {
    const Index3 c = cubeOf(x);
    for (int k = std::max(c[2] - 1, 0); k <= std::min(c[2] + 1, count_[2] - 1); ++k)
        for (int j = std::max(c[1] - 1, 0); j <= std::min(c[1] + 1, count_[1] - 1); ++j)
            for (int i = std::max(c[0] - 1, 0); i <= std::min(c[0] + 1, count_[0] - 1); ++i)
                for (const Particle& p : cubes_[(static_cast<std::size_t>(k) * count_[1] + j) * count_[0] + i])
                    visit(p);
}

Interpolation::Values Interpolation::at(const Vec3& x) const {
    Eigen::Matrix4d moments = Eigen::Matrix4d::Zero();
    Eigen::Matrix4d sums = Eigen::Matrix4d::Zero();  // columns: field, then the three velocity components
    double closest = std::numeric_limits<double>::max();
    Values fit;
    double closestValue = fit.field;
    std::size_t closestSource = 0;
    around(x, [&](const Particle& p) {
        const double q = ((p.x - x) / h_).norm();
        if (q >= closest) return;
        closest = q;
        closestValue = source_.value(p.source, p.slide);
        closestSource = p.source;
    });
    if (closest * reach > near) return fit;
    around(x, [&](const Particle& p) {
        const Vec3 d = (p.x - x) / h_;
        const double q = d.norm();
        if (q >= 1 || !source_.isBeside(p.source, closestSource)) return;
        const double w = std::pow(1 - q, 4) * (4 * q + 1);
        const Eigen::Vector4d basis(1, d[0], d[1], d[2]);
        moments += w * basis * basis.transpose();
        sums.col(0) += w * basis * source_.value(p.source, p.slide);
        if (hasVelocity()) sums.rightCols<3>() += w * basis * source_.velocity(p.source, p.slide).transpose();
    });
    if (moments(0, 0) <= 0) return fit;
    const Eigen::LDLT<Eigen::Matrix4d> solver(moments);
    const bool determined = solver.info() == Eigen::Success && solver.vectorD().minCoeff() > 1e-3 * moments(0, 0);
    const Eigen::Vector4d first = determined ? Eigen::Vector4d(solver.solve(sums).row(0).transpose())
                                             : Eigen::Vector4d(sums.row(0).transpose() / moments(0, 0));
    fit.field = source_.nearest ? closestValue : first[0];
    if (hasVelocity()) fit.velocity = first.tail<3>();
    return fit;
}

}  // namespace corpuscle
