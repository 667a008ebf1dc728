// Mean profile of the human red cell by interference microscopy (Evans and Fung, Microvasc. Res. 4:335-347, 1972).
//     thickness t(r) = sqrt(1 - s) p(s),   p = C0 + C2 s + C4 s^2,   s = (r/R0)^2
//     F = z^2 - (1 - s) p(s)^2/4
// It is one closed surface when p > 0 on [0, 1].
//
// symbol | meaning                     | unit | default (300 mOsm)
// R0     | radius of the disc          | m    | 3.91 um
// C0     | thickness on the axis       | m    | 0.81 um
// C2, C4 | coefficients of the profile | m    | 7.83 um, -4.39 um
// With the defaults the area is 134.09 um^2 and the volume 94.09 fL (measured: 135 +- 16, 94 +- 14).
#pragma once
#include "core/registry.hpp"
#include "geometry/shape.hpp"

namespace corpuscle::geometry {

struct EvansFung : AxisymmetricShape {
    double R0 = 3.91e-6, C0 = 0.81e-6, C2 = 7.83e-6, C4 = -4.39e-6;  // m

    static const Schema<EvansFung>& schema();
    void prepare(const std::filesystem::path& caseDirectory) const override;
    double implicit(const Vec3& x) const override;  // m^2
    Vec3 gradient(const Vec3& x) const override;
    Eigen::AlignedBox3d box() const override;
    double radius() const override { return R0; }
    ProfilePoint profile(double t) const override;  // r = R0 sin t

  private:
    double p(double s) const { return C0 + s * (C2 + s * C4); }
    double dp(double s) const { return C2 + 2 * C4 * s; }
};

}  // namespace corpuscle::geometry
