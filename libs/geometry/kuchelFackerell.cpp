#include "geometry/kuchelFackerell.hpp"

#include <fmt/format.h>
#include <gsl/gsl_sf_ellint.h>
#include <gsl/gsl_sf_elljac.h>

#include <cmath>

#include "core/error.hpp"

namespace corpuscle::geometry {

CORPUSCLE_REGISTER(Shape, KuchelFackerell, "kuchelFackerell", "biconcave disc, quartic of Kuchel and Fackerell 1999");

const Schema<KuchelFackerell>& KuchelFackerell::schema() {
    static const Schema<KuchelFackerell> s =
        Schema<KuchelFackerell>("kuchelFackerell", "biconcave disc")
            .quantity("d", &KuchelFackerell::d, unit::metre, "diameter", {.range = positive})
            .quantity("h", &KuchelFackerell::h, unit::metre, "greatest thickness", {.range = positive})
            .quantity("b", &KuchelFackerell::b, unit::metre, "thickness in the middle of the dimple",
                      {.range = positive});
    return s;
}

KuchelFackerell::Quartic KuchelFackerell::quartic() const {
    const double d2 = d * d, h2 = h * h, b2 = b * b;
    const double P = -d2 / 2 + h2 / 2 * (d2 / b2 - 1) * (1 - std::sqrt(1 - b2 / h2));
    return {P, P * d2 / b2 + b2 / 4 * (d2 * d2 / (b2 * b2) - 1), -P * d2 / 4 - d2 * d2 / 16};
}

KuchelFackerell::DiscCyclide KuchelFackerell::discCyclide() const {
    const double A = std::sqrt(d * d - 2 * h * h - 2 * h * std::sqrt(h * h - b * b)) / 2;
    const double f = 4 * A * A;
    const double k = 2 * A * std::sqrt(d * d - f - b * b) / (std::sqrt(f + b * b) * std::sqrt(d * d - f));
    const double m = k * k;
    return {A, m, gsl_sf_ellint_F(std::acos(2 * A / d), std::sqrt(1 - m), GSL_PREC_DOUBLE),
            gsl_sf_ellint_Kcomp(k, GSL_PREC_DOUBLE)};
}

Vec3 KuchelFackerell::DiscCyclide::at(double mu, double psi) const {
    double sn = 0, cn = 0, dn = 0, sn1 = 0, cn1 = 0, dn1 = 0;
    gsl_sf_elljac_e(mu, m, &sn, &cn, &dn);
    gsl_sf_elljac_e(nu1, 1 - m, &sn1, &cn1, &dn1);
    const double g = 1 - dn * dn * sn1 * sn1;
    const double rho = A * cn * cn1 / g;
    return {rho * std::cos(psi), rho * std::sin(psi), A * sn * dn * sn1 * dn1 / g};
}

void KuchelFackerell::prepare(const std::filesystem::path&) const {
    const auto um = [](double metres) { return fmt::format("{:.6g} um", metres * 1e6); };
    const auto refuse = [](const std::string& text) {
        throw Failure(ExitCode::invalidCase, "kuchelFackerell: " + text);
    };
    if (!(d > 0 && h > 0 && b > 0)) refuse("d, h and b must be greater than 0");
    if (!(b < h))
        refuse(fmt::format("b = {} (thickness in the dimple) must be less than h = {} (greatest thickness)", um(b),
                           um(h)));
    const double smallest = std::sqrt(2 * h * h + 2 * h * std::sqrt(h * h - b * b));
    if (!(d > smallest))
        refuse(fmt::format(
            "d = {} is too small for h = {} and b = {}: no biconcave disc has these sizes. Take d greater than {}, "
            "or a smaller h",
            um(d), um(h), um(b), um(smallest)));
}

double KuchelFackerell::implicit(const Vec3& x) const {
    const auto [P, Q, R] = quartic();
    const double u = x.x() * x.x() + x.y() * x.y(), w = x.z() * x.z();
    return (u + w) * (u + w) + P * u + Q * w + R;
}

Vec3 KuchelFackerell::gradient(const Vec3& x) const {
    const auto [P, Q, R] = quartic();
    const double r2 = x.squaredNorm();
    const double du = 2 * r2 + P, dw = 2 * r2 + Q;
    return {2 * x.x() * du, 2 * x.y() * du, 2 * x.z() * dw};
}

Eigen::AlignedBox3d KuchelFackerell::box() const {
    const Vec3 half(d / 2, d / 2, h / 2);
    return {-half, half};
}

AxisymmetricShape::ProfilePoint KuchelFackerell::profile(double t) const {
    const auto [P, Q, R] = quartic();
    const double s = std::sin(t), c = std::cos(t);
    const double q = P * s * s + Q * c * c, root = std::sqrt(q * q - 4 * R);
    // r^2 = (root - q)/2, written without cancellation where q > 0.
    const double r = std::sqrt(q > 0 ? -2 * R / (root + q) : (root - q) / 2);
    const double dr = -(P - Q) * s * c * r / root;
    return {r * s, r * c, dr * s + r * c, dr * c - r * s};
}

}  // namespace corpuscle::geometry
