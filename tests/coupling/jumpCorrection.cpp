// The slip of nodes against the fluid that their weights find: the length in its law, and the equation that it is the solution of.
#include "coupling/jumpCorrection.hpp"

#include <gtest/gtest.h>

#include "coupling/immersed.hpp"
#include "coupling/sphereScene.hpp"
#include "membrane/surface.hpp"

using namespace corpuscle;
using namespace corpuscle::coupling;
using namespace corpuscle::coupling::testing;

namespace {

constexpr double viscosity = 0.02, ratio = 4, duration = 0.2;

struct OneCell : SphereScene {
    Immersed immersed;
    JumpCorrection jump;

    OneCell() : SphereScene({10, 10, 10}, {Vec3(5, 5, 5)}, true), immersed(cells, 1), jump(cells, 1, viscosity) {
        cells[0].viscosityRatio = ratio;
        for (Vec3& x : cells[0].membrane.position) x[0] += 0.05 * (x[0] - 5);
        immersed.build(*system, std::vector<double>(system->store().size(), 1.0));
        jump.place();
    }
    std::vector<Vec3> areas() const {
        return membrane::volumeGradient(cells[0].membrane.position, cells[0].membrane.network().triangles());
    }
    std::vector<Vec3> shear() const {
        std::vector<Vec3> u;
        for (const Vec3& x : cells[0].membrane.position) u.push_back(Vec3(0.01 * x[2], 0, 0.02 * x[0]));
        return u;
    }
};

}  // namespace

// E|s - s'| = 2 int F (1 - F) ds with F the distribution of the weights over the distance from a plane.
TEST(JumpCorrection, hasTheMeanDistanceOfTheWeights) {
    constexpr int n = 4000;
    const auto weight = [](double r) { return std::pow(1 - r, 4) * (1 + 4 * r); };
    std::vector<double> density(n + 1, 0.0);  // over |s|/R: int_s^1 W r dr
    for (int k = n - 1; k >= 0; --k) {
        const double r = (k + 0.5) / n;
        density[static_cast<std::size_t>(k)] = density[static_cast<std::size_t>(k) + 1] + weight(r) * r / n;
    }
    double all = 0, below = 0, mean = 0;
    for (int k = -n; k <= n; ++k) all += density[static_cast<std::size_t>(std::abs(k))];
    for (int k = -n; k <= n; ++k) {
        below += density[static_cast<std::size_t>(std::abs(k))] / all;
        mean += 2 * below * (1 - below) / n;
    }
    EXPECT_NEAR(Immersed::radiusInSpacings * mean, JumpCorrection::reachInSpacings, 5e-4);
}

// Of a force that does not depend on the velocity: along the membrane only, and by the law.
TEST(JumpCorrection, movesNodesAlongTheMembraneByTheirLoad) {
    const OneCell c;
    const std::vector<Vec3> load = c.immersed.force(), areas = c.areas();
    std::vector<Vec3> v = c.shear(), f = load;
    c.jump.solve([](const std::vector<Vec3>&, std::vector<Vec3>&) {}, v, f);
    const std::vector<Vec3> before = c.shear();
    double largest = 0;
    for (std::size_t m = 0; m < v.size(); ++m) {
        const double area = areas[m].norm();
        const Vec3 n = areas[m] / area, along = load[m] - n.dot(load[m]) * n,
                   w = JumpCorrection::reachInSpacings / ((1 + ratio) * viscosity * area) * along;
        EXPECT_LT((v[m] - before[m] - w).norm(), 1e-12 + 1e-12 * w.norm());
        EXPECT_EQ(f[m], load[m]);
        largest = std::max(largest, w.norm());
    }
    EXPECT_GT(largest, 1e-3);
}

// Of a force that does: what comes out is the velocity, and the force at that velocity.
TEST(JumpCorrection, solvesForAForceThatDependsOnTheVelocity) {
    const OneCell c;
    const auto resist = [&](const std::vector<Vec3>& u, std::vector<Vec3>& f) {
        c.immersed.addResistance(duration, u, f);
    };
    const std::vector<Vec3> before = c.shear(), areas = c.areas();
    std::vector<Vec3> v = before, f = c.immersed.force(), expected = f;
    c.jump.solve(resist, v, f);
    resist(v, expected);
    std::vector<Vec3> slip(v.size(), Vec3::Zero());
    c.jump.addSlip(f, slip);
    double worst = 0, largest = 0, force = 0, forceOff = 0, flux = 0, power = 0;
    for (std::size_t m = 0; m < v.size(); ++m) {
        const Vec3 w = v[m] - before[m];
        worst = std::max(worst, (w - slip[m]).norm()), largest = std::max(largest, w.norm());
        force = std::max(force, expected[m].norm()), forceOff = std::max(forceOff, (f[m] - expected[m]).norm());
        flux += areas[m].dot(w), power += w.dot(f[m]);
    }
    EXPECT_LT(worst, 1e-5 * largest);
    EXPECT_LT(forceOff, 1e-12 * force);
    EXPECT_LT(std::abs(flux), 1e-12 * largest);
    EXPECT_GT(power, 0);
    EXPECT_GT(largest, 1e-4);
}
