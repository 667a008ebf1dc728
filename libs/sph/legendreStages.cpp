#include "sph/legendreStages.hpp"

namespace corpuscle::sph {

namespace {
double b(int j) { return j < 2 ? 1.0 / 3 : (j * (j + 1.0) - 2) / (2 * j * (j + 1.0)); }
}  // namespace

LegendreStages::LegendreStages(int count) {
    const double w = 2 / reach(count);
    first_ = b(1) * w;
    for (int j = 2; j <= count; ++j) {
        const double mu = (2.0 * j - 1) / j * b(j) / b(j - 1), nu = -(j - 1.0) / j * b(j) / b(j - 2);
        later_.push_back({mu, nu, w * mu, -(1 - b(j - 1)) * w * mu});
    }
}

int LegendreStages::needed(double lambdaDt) {
    int count = least;
    while (reach(count) < lambdaDt) count += 2;
    return count;
}

}  // namespace corpuscle::sph
