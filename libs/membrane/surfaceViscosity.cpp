#include "membrane/surfaceViscosity.hpp"

#include <Eigen/LU>

namespace corpuscle::membrane {

const Schema<SurfaceViscosity>& SurfaceViscosity::schema() {
    static const Schema<SurfaceViscosity> s =
        Schema<SurfaceViscosity>("surface viscosity", "viscosity of the membrane itself, a Newtonian sheet")
            .quantity("shear", &SurfaceViscosity::shear, unit::newtonSecondPerMetre, "against change of shape",
                      {.range = nonNegative})
            .quantity("dilatation", &SurfaceViscosity::dilatation, unit::newtonSecondPerMetre, "against change of area",
                      {.fallback = "0 N s/m", .range = nonNegative});
    return s;
}

void SurfaceViscosity::addForces(const Network& network, std::span<const Vec3> x, std::span<const Vec3> v,
                                 std::span<Vec3> f) const {
    using Mat2 = Eigen::Matrix2d;
    for (const int triangle : network.wholeTriangles()) {
        const Index3& node = network.triangles()[triangle];
        const Vec3 a = x[node[1]] - x[node[0]], b = x[node[2]] - x[node[0]];
        const Vec3 da = v[node[1]] - v[node[0]], db = v[node[2]] - v[node[0]];
        const Mat2 metric{{a.dot(a), a.dot(b)}, {a.dot(b), b.dot(b)}};
        const double mixed = 0.5 * (a.dot(db) + b.dot(da));
        const Mat2 rate{{a.dot(da), mixed}, {mixed, b.dot(db)}};
        const double area = 0.5 * std::sqrt(metric.determinant());
        const Mat2 inverse = metric.inverse();
        const Mat2 tension = area * (2 * shear * inverse * rate * inverse +
                                     (dilatation - shear) * inverse.cwiseProduct(rate).sum() * inverse);
        const Vec3 f1 = tension(0, 0) * a + tension(0, 1) * b, f2 = tension(1, 0) * a + tension(1, 1) * b;
        f[node[0]] += f1 + f2;
        f[node[1]] -= f1;
        f[node[2]] -= f2;
    }
}

void SurfaceViscosity::addDamping(const Network& network, std::span<const Vec3> x, Stiffness& damping) const {
    for (const int triangle : network.wholeTriangles()) {
        const Index3& node = network.triangles()[triangle];
        const Vec3 a = x[node[1]] - x[node[0]], b = x[node[2]] - x[node[0]];
        const double l = a.norm();
        const Vec3 ex = a / l;
        const double p = b.dot(ex), q = (b - p * ex).norm();  // triangle (0, 0), (l, 0), (p, q) of area l q/2
        const Vec3 ey = (b - p * ex) / q;
        const std::array<double, 3> dNdx{-1 / l, 1 / l, 0}, dNdy{(p - l) / (l * q), -p / (l * q), 1 / q};
        const double ofShape = std::sqrt(0.5 * l * q * shear), ofArea = std::sqrt(0.5 * l * q * dilatation);
        Eigen::Matrix<double, 3, 9> rates;
        for (int n = 0; n < 3; ++n) {
            const Vec3 xx = dNdx[n] * ex, yy = dNdy[n] * ey, twiceXy = dNdy[n] * ex + dNdx[n] * ey;
            rates.block<1, 3>(0, 3 * n) = ofShape * (xx - yy).transpose();
            rates.block<1, 3>(1, 3 * n) = ofShape * twiceXy.transpose();
            rates.block<1, 3>(2, 3 * n) = ofArea * (xx + yy).transpose();
        }
        damping.add(node, rates.transpose().lazyProduct(rates));
    }
}

}  // namespace corpuscle::membrane
