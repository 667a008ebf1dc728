#include "geometry/shape.hpp"

#include <fmt/format.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_integration.h>

#include <cmath>
#include <memory>
#include <numbers>

#include "core/error.hpp"

namespace corpuscle::geometry {
namespace {

template <class Integrand>
double integrate(const Integrand& f, double from, double to) {
    constexpr std::size_t intervals = 200;
    const std::unique_ptr<gsl_integration_workspace, decltype(&gsl_integration_workspace_free)> workspace(
        gsl_integration_workspace_alloc(intervals), gsl_integration_workspace_free);
    gsl_function function{[](double t, void* self) { return (*static_cast<const Integrand*>(self))(t); },
                          const_cast<Integrand*>(&f)};
    gsl_error_handler_t* handler = gsl_set_error_handler_off();
    double value = 0, error = 0;
    const int status = gsl_integration_qag(&function, from, to, 0, 1e-12, intervals, GSL_INTEG_GAUSS61, workspace.get(),
                                           &value, &error);
    gsl_set_error_handler(handler);
    // GSL_EROUND: rounding stops the error estimate just above the goal; the value is as good as doubles allow.
    if ((status != GSL_SUCCESS && status != GSL_EROUND) || !(std::abs(error) <= 1e-9 * std::abs(value)))
        throw Failure(ExitCode::numerics,
                      fmt::format("area or volume of a cell shape: quadrature failed ({}, error {:.2g} of "
                                  "{:.6g})",
                                  gsl_strerror(status), error, value));
    return value;
}

}  // namespace

Vec3 Shape::project(const Vec3& x) const {
    const double a = radius();
    Vec3 p = x;
    double F = implicit(p);
    for (int iteration = 0; iteration < 60; ++iteration) {
        const Vec3 g = gradient(p);
        const double g2 = g.squaredNorm();
        if (!(g2 > 0)) break;
        Vec3 step = -F / g2 * g;
        const double length = step.norm();
        if (length > 0.2 * a) step *= 0.2 * a / length;
        const Vec3 next = p + step;
        const double nextF = implicit(next);
        const bool settled = length < 1e-11 * a;  // quadratic convergence: one more step reaches rounding
        if (settled && std::abs(nextF) >= std::abs(F)) return p;
        p = next;
        F = nextF;
        if (settled && length < 4e-16 * a) return p;
    }
    if (std::abs(F) <= 1e-12 * gradient(p).norm() * a) return p;
    throw Failure(
        ExitCode::numerics,
        fmt::format(
            "no point of the cell's surface was found near ({:.4g}, {:.4g}, {:.4g}) m, where the mesher had put "
            "a node; use a smaller edge length",
            x.x(), x.y(), x.z()));
}

double AxisymmetricShape::area() const {
    const auto ring = [this](double t) {
        const ProfilePoint p = profile(t);
        return p.rho * std::hypot(p.drho, p.dz);
    };
    return 4 * std::numbers::pi * integrate(ring, 0, std::numbers::pi / 2);
}

double AxisymmetricShape::volume() const {
    const auto shell = [this](double t) {
        const ProfilePoint p = profile(t);
        return p.rho * p.z * p.drho;
    };
    return 4 * std::numbers::pi * integrate(shell, 0, std::numbers::pi / 2);
}

}  // namespace corpuscle::geometry
