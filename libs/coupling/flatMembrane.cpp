#include "coupling/flatMembrane.hpp"

#include <Eigen/LU>
#include <cmath>

#include "coupling/nodeBasis.hpp"

namespace corpuscle::coupling {

using sph::ViscousLayers;

FlatMembrane::FlatMembrane(const sph::Kernel& kernel, double supportOverSpacing, double radiusInSpacings, double ratio)
    : layers_(kernel, supportOverSpacing),
      ratio_(ratio),
      stepsOfSlope_(supportOverSpacing / radiusInSpacings),
      film_(layers_.filmCoefficient(ratio)) {
    for (int k = 0; k < ViscousLayers::places; ++k)
        weights_.push_back(weights(ViscousLayers::place(k), radiusInSpacings));
}

FlatMembrane::Weights FlatMembrane::weights(double place, double radius) {
    constexpr int across = 6;  // positions of the node along either axis of the membrane
    const int reach = static_cast<int>(std::ceil(radius)) + 1;
    Weights mean{Vector::Zero(ViscousLayers::count), Vector::Zero(ViscousLayers::count),
                 Vector::Zero(ViscousLayers::count)};
    for (int a = 0; a < across * across; ++a) {
        const int row = a / across, column = a % across;
        const Vec3 node((column + 0.5) / across, (row + 0.5) / across, place);
        const auto forNear = [&](auto&& f) {
            for (int i = -reach; i <= reach; ++i)
                for (int j = -reach; j <= reach; ++j)
                    for (int k = -reach; k <= reach; ++k)
                        if (const Vec3 q = (Vec3(i, j, k) - node) / radius; q.squaredNorm() < 1)
                            f(ViscousLayers::half + k, NodeBasis::weight(q.norm()), NodeBasis::at(q, Vec3::UnitZ()));
        };
        NodeBasis::Matrix A = NodeBasis::Matrix::Zero();
        forNear([&](int, double w, const NodeBasis::Vector& b) { A += w * b * b.transpose(); });
        const NodeBasis::Matrix inverse = A.inverse();
        forNear([&](int layer, double w, const NodeBasis::Vector& b) {
            const NodeBasis::Vector all = w / (across * across) * inverse * b;
            mean.one[layer] += all[0], mean.derivative[layer] += all[3], mean.kink[layer] += all[4];
        });
    }
    return mean;
}

FlatMembrane::Errors FlatMembrane::errors(int place, const NodeConditions& conditions) const {
    const double z = ViscousLayers::place(place);
    const Weights& w = weights_[static_cast<std::size_t>(place)];
    const Vector node = w.one + conditions.kink * w.kink + conditions.slope * stepsOfSlope_ * w.derivative;
    const Vector excess = layers_.excess(z, ratio_, film_), shear = ViscousLayers::shear(z, ratio_);
    Vector loaded = shear;  // becomes half of the shear flow: stress -1/2 outside and 1/2 inside
    for (int i = 0; i < ViscousLayers::count; ++i) loaded[i] *= i - ViscousLayers::half < z ? 0.5 : -0.5;
    return {node.dot(layers_.velocities(excess, Vector::Zero(ViscousLayers::count), shear)),
            node.dot(layers_.velocities(excess, node, loaded))};
}

FlatMembrane::Errors FlatMembrane::meanErrors(const NodeConditions& conditions) const {
    Errors mean;
    for (int k = 0; k < ViscousLayers::places; ++k) {
        const Errors here = errors(k, conditions);
        mean.cross += here.cross / ViscousLayers::places, mean.self += here.self / ViscousLayers::places;
    }
    return mean;
}

// The cross error is linear in v and t. With t chosen for each v so that it vanishes, the self error is a polynomial of
// second degree in v.
NodeConditions FlatMembrane::conditions(double self) const {
    const double none = meanErrors({}).cross, byKink = meanErrors({.kink = 1}).cross - none,
                 bySlope = meanErrors({.slope = 1}).cross - none;
    const auto at = [&](double kink) {
        return NodeConditions{.kink = kink, .slope = ratio_ == 1 ? 0 : -(none + kink * byKink) / bySlope};
    };
    constexpr double probe = 0.1;
    const auto missing = [&](double kink) { return meanErrors(at(kink)).self - self; };
    const double low = missing(0), middle = missing(probe), high = missing(2 * probe);
    const double a = 0.5 * (high - 2 * middle + low), b = middle - low - a;  // low + b k + a k^2, k = v/probe
    const double discriminant = b * b - 4 * a * low;
    return at(probe * (discriminant > 0 ? -b - std::sqrt(discriminant) : -b) / (2 * a));
}

}  // namespace corpuscle::coupling
