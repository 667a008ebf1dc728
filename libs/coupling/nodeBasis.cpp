#include "coupling/nodeBasis.hpp"

#include <Eigen/LU>
#include <cmath>
#include <numbers>
#include <numeric>

namespace corpuscle::coupling {

namespace {

constexpr double secondMoment = 0.1;  // of the density m, from W (c0 + c2 q^2)
constexpr std::size_t degree = 11;

// 1 - 10 q^2 + 20 q^3 - 15 q^4 + 4 q^5
constexpr std::array<double, 6> wendland{1, 0, -10, 20, -15, 4};

// Integral of q^power W over 0 < q < 1.
double moment(int power) {
    double sum = 0;
    for (int k = 0; k < 6; ++k) sum += wendland[static_cast<std::size_t>(k)] / (power + k + 1);
    return sum;
}

// phi(z) = sum_k c_k |z|^k, from phi'' = 2 m, m(z) = 2 pi int_z^1 q W (c0 + c2 q^2) dq, phi(1) = 1, phi'(0) = 0.
std::array<double, degree + 1> coefficients() {
    Eigen::Matrix2d A;
    A << moment(2), moment(4), moment(4), moment(6);
    const Eigen::Vector2d c = A.inverse() * Eigen::Vector2d(1, secondMoment) / (4 * std::numbers::pi);
    std::array<double, degree + 1> density{}, phi{};
    for (int part = 0; part < 2; ++part)
        for (int k = 0; k < 6; ++k) {
            const int power = 2 + 2 * part + k;  // of the antiderivative
            const double term = 2 * std::numbers::pi * c[part] * wendland[static_cast<std::size_t>(k)] / power;
            density[0] += term, density[static_cast<std::size_t>(power)] -= term;
        }
    double atOne = 0;
    for (std::size_t k = 0; k + 2 <= degree; ++k) {
        const double value = 2 * density[k] / static_cast<double>((k + 1) * (k + 2));
        phi[k + 2] = value, atOne += value;
    }
    phi[0] = 1 - atOne;
    return phi;
}

}  // namespace

double NodeBasis::kink(double z) {
    static const std::array<double, degree + 1> c = coefficients();
    const double x = std::abs(z);
    if (x >= 1) return x;
    return std::accumulate(c.rbegin(), c.rend(), 0.0, [x](double value, double a) { return value * x + a; });
}

}  // namespace corpuscle::coupling
