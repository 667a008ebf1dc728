#include "membrane/wholeSurface.hpp"

namespace corpuscle::membrane {

void WholeSurfaceTerm::addForces(std::span<const Vec3> x, std::span<Vec3> f) const {
    if (letGo()) {
        return;
    }
    const double slopeNow = slope(x);
    const std::vector<Vec3> g = gradient(x);
    for (std::size_t n = 0; n < g.size(); ++n) {
        f[n] -= slopeNow * g[n];
    }
}

double WholeSurfaceTerm::energy(std::span<const Vec3> x) const {
    if (letGo()) {
        return 0;
    }
    const double change = value(x) - rest_;
    return 0.5 * modulus_ * change * change / rest_;
}

void WholeSurfaceTerm::addStiffness(std::span<const Vec3> x, Definiteness definiteness, Stiffness& stiffness) const {
    if (letGo()) {
        return;
    }
    addCurvature(x, slope(x), definiteness, stiffness);
    stiffness.addRankOne(modulus_ / rest_, gradient(x));
}

double WholeSurfaceTerm::maxStiffness(std::span<const Vec3> x) const {
    if (letGo()) {
        return 0;
    }
    double square = 0;
    for (const Vec3& g : gradient(x)) {
        square += g.squaredNorm();
    }
    return modulus_ / rest_ * square;
}

}  // namespace corpuscle::membrane
