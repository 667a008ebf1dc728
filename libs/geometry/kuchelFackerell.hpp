// Biconcave disc of Kuchel and Fackerell (Bull. Math. Biol. 61:209-220, 1999): a quartic of revolution, also a
// disc-cyclide.
//     (u + w)^2 + P u + Q w + R = 0,        u = x^2 + y^2,  w = z^2
// with diameter d, greatest thickness h and thickness b on the axis:
//     P = -d^2/2 + (h^2/2)(d^2/b^2 - 1)(1 - sqrt(1 - b^2/h^2))
//     Q = P d^2/b^2 + (b^2/4)(d^4/b^4 - 1)
//     R = -P d^2/4 - d^4/16
// It is one closed biconcave surface around the origin when 0 < b < h and d^2 > 2 h^2 + 2 h sqrt(h^2 - b^2). Then
// R < 0, and each ray from the origin meets the surface once: r^4 + q r^2 + R = 0 with q = P sin^2 t + Q cos^2 t, t the
// angle from the axis.
//
// symbol | meaning                                       | unit | default
// d      | diameter of the disc                          | m    | required
// h      | greatest thickness, at rho^2 = -P/2 - h^2/4   | m    | required
// b      | thickness in the middle of the dimple         | m    | required
//
// The same surface in disc-cyclide coordinates, nu1 = const (Jacobi functions, m the parameter k^2):
//     x = A cn(mu|m) cn(nu1|1-m) cos(psi)/g          y the same with sin(psi)
//     z = A sn(mu|m) dn(mu|m) sn(nu1|1-m) dn(nu1|1-m)/g
//     g = 1 - dn(mu|m)^2 sn(nu1|1-m)^2               mu in [-K(m), K(m)]: 0 on the rim, +-K in the two dimples
//     A = (1/2) sqrt(d^2 - 2 h^2 - 2 h sqrt(h^2 - b^2))
//     k = 2 A sqrt(d^2 - 4 A^2 - b^2)/(sqrt(4 A^2 + b^2) sqrt(d^2 - 4 A^2)),  m = k^2
//     nu1 = F(arccos(2A/d) | 1-m)
// These formulas are often printed with errors. Correct are: A without a factor cos(psi); dn(mu), not dn(mu'); k as
// above, without a square on the last root, and m = k^2. nu1 is often left undefined. For d, h, b = 8, 2.12, 1 um the
// volume is 85.99 fL and the area 128.03 um^2.
#pragma once
#include "core/registry.hpp"
#include "geometry/shape.hpp"

namespace corpuscle::geometry {

struct KuchelFackerell : AxisymmetricShape {
    double d = 0, h = 0, b = 0;  // m

    KuchelFackerell() = default;
    KuchelFackerell(double diameter, double thickness, double dimple) : d(diameter), h(thickness), b(dimple) {}

    struct Quartic {
        double P, Q, R;  // m^2, m^2, m^4
    };
    Quartic quartic() const;

    struct DiscCyclide {
        double A;  // m
        double m, nu1, K;
        Vec3 at(double mu, double psi) const;
    };
    DiscCyclide discCyclide() const;

    static const Schema<KuchelFackerell>& schema();
    void prepare(const std::filesystem::path& caseDirectory) const override;
    double implicit(const Vec3& x) const override;  // m^4
    Vec3 gradient(const Vec3& x) const override;
    Eigen::AlignedBox3d box() const override;
    double radius() const override { return d / 2; }
    ProfilePoint profile(double t) const override;  // t: angle from the axis
};

}  // namespace corpuscle::geometry
