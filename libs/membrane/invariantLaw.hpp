// Triangle laws of the two invariants of the Cauchy-Green tensor C = 1 + e, with principal stretches l1, l2:
//     I1 = tr C - 2 = l1^2 + l2^2 - 2,     I2 = det C - 1 = l1^2 l2^2 - 1
//     dI1/de = (1, 0, 1),   dI2/de = (1 + e22, -2 e12, 1 + e11)
// Law: W(I1, I2) [J/m^2]; firstDerivatives = (dW/dI1, dW/dI2); secondDerivatives = (W_11, W_12, W_22), all N/m.
// Principal tensions: T1 = 2/(l1 l2) (l1^2 dW/dI1 + l1^2 l2^2 dW/dI2), T2 likewise.
#pragma once
#include <array>

#include "membrane/triangleLaw.hpp"

namespace corpuscle::membrane {

template <class Law>
class InvariantLawOf : public TriangleLawOf<Law> {
  public:
    double energy(const Vec3& e) const final { return law().W(first(e), second(e)); }

    Vec3 slope(const Vec3& e) const final {
        const auto [w1, w2] = law().firstDerivatives(first(e), second(e));
        return {w1 + w2 * (1 + e[2]), -2 * w2 * e[1], w1 + w2 * (1 + e[0])};
    }

    Mat3 curvature(const Vec3& e) const final {
        const double i1 = first(e), i2 = second(e), w2 = law().firstDerivatives(i1, i2)[1];
        const auto [w11, w12, w22] = law().secondDerivatives(i1, i2);
        const Vec3 d1(1, 0, 1), d2(1 + e[2], -2 * e[1], 1 + e[0]);
        Mat3 m = w11 * d1 * d1.transpose() + w22 * d2 * d2.transpose();
        m += w12 * (d1 * d2.transpose() + d2 * d1.transpose());
        m(0, 2) += w2;
        m(2, 0) += w2;
        m(1, 1) -= 2 * w2;
        return m;
    }

  private:
    static double first(const Vec3& e) { return e[0] + e[2]; }
    static double second(const Vec3& e) { return e[0] + e[2] + (e[0] * e[2] - e[1] * e[1]); }
    const Law& law() const { return static_cast<const Law&>(*this); }
};

}  // namespace corpuscle::membrane
