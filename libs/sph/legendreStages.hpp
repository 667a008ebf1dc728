// Coefficients of the Runge-Kutta-Legendre scheme of second order, RKL2 (Meyer, Balsara, Aslam, J. Comput. Phys. 257
// (2014) 594), for du/dt = M u with real negative eigenvalues, in increments d_j = Y_j - u:
//
//     d_0 = 0,   d_1 = mu~_1 dt M u
//     d_j = mu_j d_(j-1) + nu_j d_(j-2) + dt [mu~_j M Y_(j-1) + gamma~_j M u],   j = 2 .. s,     u <- u + d_s
//     b_0 = b_1 = b_2 = 1/3,   b_j = (j^2 + j - 2)/(2 j (j + 1)),   w = 4/(s^2 + s - 2),   mu~_1 = b_1 w
//     mu_j = (2j - 1)/j b_j/b_(j-1),   nu_j = -(j - 1)/j b_j/b_(j-2),   mu~_j = w mu_j,
//         gamma~_j = -(1 - b_(j-1)) mu~_j
//
// A step multiplies a mode of rate -lambda by the factor 1 - b_s + b_s P_s(1 - w lambda dt), with P_s the Legendre
// polynomial. The factor is between 0 and 1 up to
//     lambda dt = (s^2 + s - 2)/2,
// which is (s^2 + s - 2)/4 times forward Euler's largest step 2/lambda, for s evaluations of M. At this limit the
// factor is 2/(s^2 + s) if s is odd, and 1 if s is even, which would leave the stiffest modes undamped: s is therefore
// odd.
#pragma once
#include <vector>

namespace corpuscle::sph {

class LegendreStages {
  public:
    static constexpr int least = 3;

    explicit LegendreStages(int count);

    struct Stage {
        double last, before, rate, startRate;  // mu, nu, mu~, gamma~
    };
    double first() const { return first_; }  // mu~_1
    const std::vector<Stage>& later() const { return later_; }
    int count() const { return static_cast<int>(later_.size()) + 1; }

    // Largest lambda dt for which `count` stages are stable.
    static double reach(int count) { return 0.5 * (count * (count + 1.0) - 2); }
    // Smallest odd number of stages that is stable for this lambda dt.
    static int needed(double lambdaDt);

  private:
    double first_;
    std::vector<Stage> later_;
};

}  // namespace corpuscle::sph
