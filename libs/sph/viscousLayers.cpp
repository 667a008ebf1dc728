#include "sph/viscousLayers.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace corpuscle::sph {

namespace {

// Sum of f(q), q = r/H, over the particles of a layer at a distance of z spacings.
template <class F>
double sumOverLayer(int z, double support, F&& f) {
    const int n = static_cast<int>(std::ceil(support));
    double sum = 0;
    for (int i = -n; i <= n; ++i)
        for (int j = -n; j <= n; ++j)
            if (const double q = std::sqrt(i * i + j * j + z * z) / support; q < 1) sum += f(q);
    return sum;
}

}  // namespace

ViscousLayers::ViscousLayers(const Kernel& kernel, double supportOverSpacing)
    : support_(supportOverSpacing),
      reach_(static_cast<int>(std::ceil(supportOverSpacing))),
      ends_(2 * reach_ + 2),
      share_(reach_ + 1),
      gradient_(2 * reach_ + 1),
      pairs_(Eigen::MatrixXd::Zero(count, count)) {
    Vector a(reach_ + 1);
    double second = 0;
    for (int k = 0; k <= reach_; ++k) {
        a[k] = sumOverLayer(k, support_, [&](double q) { return kernel.slope(q); });
        share_[k] = sumOverLayer(k, support_, [&](double q) { return kernel.value(q); });
        second += k * k * a[k];
    }
    a /= second;
    share_ /= 2 * share_.sum() - share_[0];
    for (int k = -reach_; k <= reach_; ++k) gradient_[reach_ + k] = 0.5 * k * a[std::abs(k)];
    for (int k = 1; k <= reach_; ++k)
        for (int i = 0; i + k < count; ++i) {
            pairs_(i, i) += a[k], pairs_(i + k, i + k) += a[k];
            pairs_(i, i + k) -= a[k], pairs_(i + k, i) -= a[k];
        }
}

ViscousLayers::Vector ViscousLayers::excess(double place, double ratio, double kappa) const {
    const auto inside = [&](int i) { return std::clamp(0.5 + place - (i - half), 0.0, 1.0); };
    Vector c(count);
    for (int i = 0; i < count; ++i) {
        double p = 0;
        for (int k = -reach_; k <= reach_; ++k) p += share_[std::abs(k)] * inside(std::clamp(i + k, 0, count - 1));
        c[i] = laminate(p, ratio, kappa) - 1;
    }
    return c;
}

Eigen::MatrixXd ViscousLayers::matrix(const Vector& excess) const {
    Eigen::MatrixXd A = pairs_;
    const auto width = gradient_.size();
    for (int i = reach_; i < count - reach_; ++i)
        A.block(i - reach_, i - reach_, width, width) += excess[i] * gradient_ * gradient_.transpose();
    return A;
}

ViscousLayers::Vector ViscousLayers::velocities(const Vector& excess, const Vector& force, const Vector& ends) const {
    const Eigen::MatrixXd A = matrix(excess);
    const int free = count - 2 * ends_;
    Vector u = ends;
    u.segment(ends_, free).setZero();
    u.segment(ends_, free) =
        A.block(ends_, ends_, free, free).partialPivLu().solve((force - A * u).segment(ends_, free));
    return u;
}

double ViscousLayers::stress(const Vector& excess, const Vector& velocities) const {
    return (matrix(excess) * velocities).tail(ends_).sum();
}

ViscousLayers::Vector ViscousLayers::shear(double place, double ratio) {
    Vector u(count);
    for (int i = 0; i < count; ++i) {
        const double z = i - half - place;
        u[i] = z < 0 ? z / ratio : z;
    }
    return u;
}

// The stress is linear in a jump added to the prescribed velocities outside: comparison with a jump of 1 gives the jump
// at which the stress would be exact.
double ViscousLayers::film(double place, double ratio, double kappa) const {
    const Vector c = excess(place, ratio, kappa), none = Vector::Zero(count), exact = shear(place, ratio);
    Vector stepped = exact;
    for (int i = 0; i < count; ++i)
        if (i - half > place) stepped[i] += 1;
    const double found = stress(c, velocities(c, none, exact)), withStep = stress(c, velocities(c, none, stepped));
    const double unit = (pairs_ * shear(0, 1)).tail(ends_).sum();  // stress of a linear profile in one fluid
    return (unit - found) / (withStep - found);
}

// Bisection: the mean film increases with kappa and is negative at kappa = 0.
double ViscousLayers::filmCoefficient(double ratio) const {
    if (ratio <= 1) return 0;
    double low = 0, high = 1;
    for (int halving = 0; halving < 50; ++halving) {
        const double kappa = 0.5 * (low + high);
        double sum = 0;
        for (int k = 0; k < places; ++k) sum += film(place(k), ratio, kappa);
        (sum < 0 ? low : high) = kappa;
    }
    return 0.5 * (low + high);
}

double ViscousLayers::laminate(double p, double ratio, double kappa) {
    const double fluidity = p / ratio + 1 - p, jump = (1 - 1 / ratio) / fluidity;
    return 1 / fluidity - kappa * jump * jump * p * (1 - p);
}

}  // namespace corpuscle::sph
