// Steps that end where bonds break: the search for their length, the time of the first break, and what broke when the
// step is asked to be of different lengths. Lengths in spacings, density 1.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/communicator.hpp"
#include "coupling/sphereScene.hpp"
#include "implicit/breakSearch.hpp"
#include "implicit/implicitStep.hpp"
#include "membrane/bondStretch.hpp"

using namespace corpuscle;
using coupling::testing::SphereScene;
using implicit::BreakSearch;
using implicit::BreakTimes;
using implicit::findBreaks;
using implicit::ImplicitStep;
using implicit::never;

namespace {

constexpr double rate = 0.01;  // [1/s]
const Vec3 centre(5.1, 4.9, 5);

struct Found {
    double length;
    int steps;
    bool isCoarse;
};
// Runs a search in which a step of length d has its first break at first(d), and its deadline w or `later` after it.
template <class First>
Found search(double asked, double perStrain, First&& first, double later = 0) {
    BreakSearch s(asked, perStrain);
    int steps = 1;
    for (; steps < 50; ++steps) {
        const double d = s.length(), c = first(d), deadline = c + std::max(later, s.resolution());
        if (s.accepts({c <= s.horizon() ? c : never, deadline < s.horizon() ? deadline : never})) break;
    }
    return {s.length(), steps, s.isCoarse()};
}

Vec3 flow(const Vec3& x) {  // periodic in the box: a wave
    const double k = 2 * std::numbers::pi / 10;
    return {rate / k * std::sin(k * (x[2] - centre[2])), 0, 0};
}

// A soft spherical membrane that a flow of little viscosity carries along; its bonds break at this stretch.
coupling::Scene shearedSphere(double limit) {
    coupling::Scene scene = SphereScene({10, 10, 10}, {centre}, true, coupling::Cells::everywhere, [&](auto& laws) {
                                using coupling::testing::choice;
                                laws.bonds = choice<membrane::BondLaw>("{type: harmonic, k: 1e-6 N/m}");
                                laws.bending = choice<membrane::BendingLaw>("{type: dihedral, kappa: 1e-7 J}");
                                auto rupture = std::make_shared<membrane::BondStretch>();
                                rupture->limit = limit;
                                laws.rupture = {"bondStretch", rupture};
                            }).immersedScene(rate, [](const Vec3& d) { return d; });
    sph::FluidModel model = sph::testing::model("wendlandC2");
    model.viscosity = 1e-3;
    scene.forces = std::make_unique<sph::FluidForces>(model, *scene.system);
    particles::ParticleStore& s = scene.store();
    for (std::size_t i = 0; i < s.size(); ++i) s.setVelocity(i, flow(s.position(i)));
    for (coupling::Cell& cell : scene.cells)
        for (std::size_t m = 0; m < cell.membrane.position.size(); ++m)
            cell.membrane.velocity[m] = flow(cell.membrane.position[m]);
    return scene;
}

struct Break {
    double strain = 0, stretch = 0;
    int bond = -1;
    long steps = 0;
};
// Advances until something breaks, in steps asked to be of this strain.
Break firstBreak(double limit, double strain) {
    coupling::Scene scene = shearedSphere(limit);
    ImplicitStep::Options options;
    options.settings = {.step = strain, .tolerance = 1e-6, .error = 1, .bondStrain = 1};
    const auto step = ImplicitStep::make(scene, options);
    Break found;
    for (double t = 0; t * rate < 1; ++found.steps) {
        const ImplicitStep::Made made = step->advance(strain / rate);
        t += made.length, found.strain = t * rate;
        if (made.broken.empty()) continue;
        const membrane::BrokenBond& bond = made.broken.front().bonds.front();
        found.bond = bond.bond, found.stretch = bond.stretch;
        EXPECT_EQ(step->state.sinceBreak, 0);
        EXPECT_LE(made.length, strain / rate);
        // The membrane goes on from there.
        for (int k = 0; k < 5; ++k) EXPECT_GT(step->advance(strain / rate).length, 0);
        EXPECT_EQ(step->statistics.coarseBreaks, 0);
        break;
    }
    return found;
}

}  // namespace

// A displacement that relaxes, y = 1 - exp(-t/tau), by backward Euler: mean velocity 1/(tau + d) in a step of d, so
// that y = s is reached at s (tau + d), and at the end of the step if d = s tau/(1 - s).
TEST(BreakSearch, endsTheStepAtTheBreakOfAMotionThatRelaxes) {
    for (const double tau : {0.01, 0.3, 1.0, 20.0})
        for (const double s : {0.02, 0.3, 0.6, 0.9}) {
            const double end = s * tau / (1 - s);
            if (end > 1) continue;
            const Found found = search(1, 1e9, [&](double d) { return s * (tau + d); });
            // c is known to lie between d - w and d: d is wrong by up to w/(1 - s), as dc/dd = s
            EXPECT_GE(found.length, end * (1 - 1e-9)) << tau << " " << s;
            EXPECT_LE(found.length, end + 1e-3 / (1 - s) * 1.001) << tau << " " << s;
            EXPECT_LE(found.steps, 6) << tau << " " << s;
            EXPECT_FALSE(found.isCoarse);
        }
}

TEST(BreakSearch, takesTwoStepsWhereTheVelocityDoesNotDependOnTheLength) {
    const Found found = search(1, 1e9, [](double) { return 0.37; });
    EXPECT_EQ(found.steps, 2);
    EXPECT_NEAR(found.length, 0.3705, 1e-6);
}

TEST(BreakSearch, leavesAStepAloneInWhichNothingBreaks) {
    const Found found = search(0.5, 1e9, [](double) { return never; });
    EXPECT_EQ(found.steps, 1);
    EXPECT_EQ(found.length, 0.5);
}

TEST(BreakSearch, resolvesStrainWhereThatIsCoarserThanAThousandthOfTheStep) {
    const Found found = search(1, 0.01, [](double d) { return 0.4 + 0.1 * d; });  // w = 1e-4/0.01
    EXPECT_GE(found.length, 0.4 / 0.9);
    EXPECT_LE(found.length, 0.4 / 0.9 + 0.01 / 0.9);
    EXPECT_LE(found.steps, 3);
}

// A deadline far behind the first break is met by a step that ends anywhere before it.
TEST(BreakSearch, acceptsAnyEndBetweenTheFirstBreakAndTheDeadline) {
    EXPECT_EQ(search(
                  1, 1e9, [](double) { return 0.3; }, 0.8)
                  .steps,
              1);
    const Found found = search(
        1, 1e9, [](double d) { return 0.2 + 0.1 * d; }, 0.5);
    EXPECT_LE(found.steps, 2);
    EXPECT_GE(found.length, 0.2 / 0.9);
    EXPECT_LE(found.length, 0.7 / 0.9);
}

// Shorter steps break nothing, longer ones something early: it ends with the shortest of the latter, found by halving.
TEST(BreakSearch, endsWhereTheTimeOfTheBreakJumps) {
    const Found found = search(1, 1e9, [](double d) { return d < 0.6 ? never : 0.1; });
    EXPECT_GE(found.length, 0.6);
    EXPECT_LT(found.length, 0.61);
    EXPECT_TRUE(found.isCoarse);
    EXPECT_LE(found.steps, 13);
}

// Compared with the law itself, asked at times 1e-5 of the horizon before and after.
TEST(BreakTime, isThatAtWhichTheLawBreaksTheFirstBond) {
    coupling::Scene scene = shearedSphere(1.05);
    const coupling::Immersed immersed(scene.cells, scene.model(), *scene.system);
    for (const double stretching : {0.06, 0.2, 3.0}) {
        coupling::Immersed::Vectors velocity;
        for (const coupling::Cell& cell : scene.cells)
            for (const Vec3& x : cell.membrane.position) {
                const Vec3 d = x - centre;
                velocity.emplace_back(stretching * d[0] + 0.3 * d[2] * d[1], -0.4 * stretching * d[1],
                                      0.2 * d[0] * d[1]);
            }
        const BreakTimes breaks = findBreaks(immersed, MPI_COMM_WORLD, 0, velocity, 1, 0.01);
        const double time = breaks.first;
        ASSERT_LT(time, 0.9);
        EXPECT_NEAR(breaks.deadline, time + 0.01, 1e-12) << "nothing has broken before";
        for (coupling::Cell& cell : scene.cells) {
            const std::vector<Vec3> start = cell.membrane.position;
            const auto isBreak = [&](double t) {
                for (std::size_t n = 0; n < start.size(); ++n) cell.membrane.position[n] = start[n] + t * velocity[n];
                const bool some = !cell.membrane.findBroken(0).empty();
                cell.membrane.position = start;
                return some;
            };
            EXPECT_FALSE(isBreak(time - 1e-5)) << stretching;
            EXPECT_TRUE(isBreak(time + 1e-12)) << stretching;
        }
        EXPECT_EQ(findBreaks(immersed, MPI_COMM_WORLD, 0, velocity, 0.9 * time, 0.01).first, never);
    }
}

// In a cell that has lost 40 bonds, the deadline is when a third element would break late.
TEST(BreakTime, allowsATwentiethOfTheBrokenBondsToBreakLate) {
    coupling::Scene scene = shearedSphere(1.05);
    const coupling::Immersed immersed(scene.cells, scene.model(), *scene.system);
    coupling::Immersed::Vectors velocity;
    for (coupling::Cell& cell : scene.cells) {
        const auto& bonds = cell.membrane.network().bonds();
        std::vector<membrane::BrokenBond> some;
        for (std::size_t k = 0; k < bonds.size() && some.size() < 40; k += 9)
            some.push_back({bonds[k].number, 1, Vec3::Zero()});
        ASSERT_EQ(some.size(), 40u);
        cell.membrane.breakBonds(some);
        for (const Vec3& x : cell.membrane.position) velocity.push_back(0.4 * (x - centre)[0] * Vec3(1, 0.3, -0.2));
    }
    const BreakTimes breaks = findBreaks(immersed, MPI_COMM_WORLD, 0, velocity, 1, 1e-9);
    ASSERT_LT(breaks.deadline, 1);
    for (const coupling::Cell& cell : scene.cells) {
        std::vector<double> times;  // at which |x + t v| of a bond passes its limit: a quadratic equation
        for (const membrane::Bond& bond : cell.membrane.network().bonds()) {
            const Vec3 d = cell.membrane.position[bond.node[1]] - cell.membrane.position[bond.node[0]],
                       v = velocity[static_cast<std::size_t>(bond.node[1])] -
                           velocity[static_cast<std::size_t>(bond.node[0])];
            const double a = v.squaredNorm(), b = d.dot(v), c = d.squaredNorm() - std::pow(1.05 * bond.rest, 2);
            if (b * b - a * c > 0 && a > 0) times.push_back((-b + std::sqrt(b * b - a * c)) / a);
        }
        std::sort(times.begin(), times.end());
        EXPECT_NEAR(breaks.first, times[0], 2e-6);
        EXPECT_NEAR(breaks.deadline, times[2], 2e-6);
    }
}

// Strain at which the first bond would reach this stretch if the nodes moved with the flow: along x, each with its own
// velocity, so that |d + t u| of a bond is the root of a quadratic polynomial.
double strainInTheFlow(double limit) {
    coupling::Scene scene = shearedSphere(limit);
    double first = never;
    for (const coupling::Cell& cell : scene.cells)
        for (const membrane::Bond& bond : cell.membrane.network().bonds()) {
            const Vec3 &a = cell.membrane.position[bond.node[0]], &b = cell.membrane.position[bond.node[1]];
            const Vec3 d = b - a, u = flow(b) - flow(a);
            const double uu = u.squaredNorm(), ud = u.dot(d), c = d.squaredNorm() - std::pow(limit * bond.rest, 2);
            first = std::min(first, (-ud + std::sqrt(ud * ud - uu * c)) / uu);
        }
    return Communicator(MPI_COMM_WORLD).min(first) * rate;
}

TEST(Breaks, comeAtTheSameStrainWhateverTheStep) {
    constexpr double limit = 1.06;
    const Break exact = firstBreak(limit, 0.0025);
    ASSERT_GE(exact.bond, 0);
    EXPECT_GT(exact.steps, 10);
    // Nodes take velocities that are means over particles, and the membrane is not quite passive: 6 % earlier.
    EXPECT_NEAR(exact.strain / strainInTheFlow(limit), 1, 0.1);
    for (const double strain : {0.1, 0.05, 0.025, 0.0125}) {
        const Break found = firstBreak(limit, strain);
        EXPECT_NEAR(found.strain / exact.strain, 1, 5e-3) << strain;
        EXPECT_EQ(found.bond, exact.bond) << strain;
        EXPECT_GT(found.stretch, limit);
        EXPECT_LT(found.stretch, limit * (1 + 2e-4)) << strain;
    }
}
