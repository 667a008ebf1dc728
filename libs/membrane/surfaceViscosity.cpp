#include "membrane/surfaceViscosity.hpp"

#include <Eigen/LU>
#include <cmath>

namespace corpuscle::membrane {

namespace {

using Mat2 = Eigen::Matrix2d;

// The metric of a triangle, and its rate of change by given velocities.
class Patch {
  public:
    Patch(const Index3& node, std::span<const Vec3> x)
        : node_(node),
          a_(x[node[1]] - x[node[0]]),
          b_(x[node[2]] - x[node[0]]),
          metric_{{a_.dot(a_), a_.dot(b_)}, {a_.dot(b_), b_.dot(b_)}},
          inverse_(metric_.inverse()) {}
    const Vec3& a() const { return a_; }
    const Vec3& b() const { return b_; }
    const Mat2& inverse() const { return inverse_; }
    double area() const { return 0.5 * std::sqrt(metric_.determinant()); }
    Mat2 rate(std::span<const Vec3> v) const {  // D
        const Vec3 da = v[node_[1]] - v[node_[0]], db = v[node_[2]] - v[node_[0]];
        const double mixed = 0.5 * (a_.dot(db) + b_.dot(da));
        return Mat2{{a_.dot(da), mixed}, {mixed, b_.dot(db)}};
    }
    double shearRate(std::span<const Vec3> u) const {  // q^2 = 2 D:D - (tr D)^2
        const Mat2 mixed = inverse_ * rate(u);
        const double trace = mixed.trace();
        return std::sqrt(std::max(0.0, 2 * (mixed * mixed).trace() - trace * trace));
    }

  private:
    const Index3& node_;
    Vec3 a_, b_;
    Mat2 metric_, inverse_;
};

}  // namespace

const Schema<ShearThinning>& ShearThinning::schema() {
    static const Schema<ShearThinning> s =
        Schema<ShearThinning>("shear thinning", "viscosity of the membrane that falls with its rate of shear")
            .quantity("rate", &ShearThinning::rate, unit::perSecond, "rate of shear from which it falls",
                      {.range = positive})
            .quantity("index", &ShearThinning::index, unit::none,
                      "of the power law beyond: viscosity as rate^(index - 1)",
                      {.range = {.low = 0, .high = 1, .lowOpen = true}});
    return s;
}

double ShearThinning::factor(double shearRate) const {
    const double ratio = shearRate / rate;
    return std::pow(1 + ratio * ratio, 0.5 * (index - 1));
}

const Schema<SurfaceViscosity>& SurfaceViscosity::schema() {
    static const Schema<SurfaceViscosity> s =
        Schema<SurfaceViscosity>("surface viscosity",
                                 "viscosity of the membrane itself, a Newtonian sheet unless it thins")
            .quantity("shear", &SurfaceViscosity::shear, unit::newtonSecondPerMetre,
                      "against change of shape; at rest, where it thins", {.range = nonNegative})
            .quantity("dilatation", &SurfaceViscosity::dilatation, unit::newtonSecondPerMetre, "against change of area",
                      {.fallback = "0 N s/m", .range = nonNegative})
            .table("thinning", &SurfaceViscosity::thinning, "shear falls with the sheet's rate of shear (Carreau)");
    return s;
}

void SurfaceViscosity::addForces(const Network& network, const SurfaceMotion& motion, std::span<const Vec3> v,
                                 std::span<Vec3> f) const {
    for (const int triangle : network.wholeTriangles()) {
        const Index3& node = network.triangles()[triangle];
        const Patch patch(node, motion.x);
        const double ofShape = thinning ? shearAt(patch.shearRate(motion.u)) : shear;
        const Mat2 &inverse = patch.inverse(), rate = patch.rate(v);
        const Mat2 tension = patch.area() * (2 * ofShape * inverse * rate * inverse +
                                             (dilatation - ofShape) * inverse.cwiseProduct(rate).sum() * inverse);
        const Vec3 f1 = tension(0, 0) * patch.a() + tension(0, 1) * patch.b(),
                   f2 = tension(1, 0) * patch.a() + tension(1, 1) * patch.b();
        f[node[0]] += f1 + f2;
        f[node[1]] -= f1;
        f[node[2]] -= f2;
    }
}

void SurfaceViscosity::addDamping(const Network& network, const SurfaceMotion& motion, Stiffness& damping) const {
    const std::span<const Vec3> x = motion.x;
    for (const int triangle : network.wholeTriangles()) {
        const Index3& node = network.triangles()[triangle];
        const Vec3 a = x[node[1]] - x[node[0]], b = x[node[2]] - x[node[0]];
        const double l = a.norm();
        const Vec3 ex = a / l;
        const double p = b.dot(ex), q = (b - p * ex).norm();  // triangle (0, 0), (l, 0), (p, q) of area l q/2
        const Vec3 ey = (b - p * ex) / q;
        const std::array<double, 3> dNdx{-1 / l, 1 / l, 0}, dNdy{(p - l) / (l * q), -p / (l * q), 1 / q};
        const double viscosity = thinning ? shearAt(Patch(node, x).shearRate(motion.u)) : shear;
        const double ofShape = std::sqrt(0.5 * l * q * viscosity), ofArea = std::sqrt(0.5 * l * q * dilatation);
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
