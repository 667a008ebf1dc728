// Networks of tubes, against other methods: distances against the nearest of many points of the surface, made from the
// parametric form of each tube; volumes against random points; flows against resistances in series and in parallel.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <random>

#include "boundary/networkWalls.hpp"
#include "boundary/tubeWalls.hpp"
#include "core/settings.hpp"

namespace corpuscle::boundary {
namespace {

constexpr double pi = std::numbers::pi;
const particles::Box box{Vec3(-6, -4, -2), Vec3(6, 4, 2), {true, false, false}};

Tube tube(const Vec3& from, const Vec3& to, double diameter) { return {from, to, diameter}; }

// A tube that divides into two of different widths, which join again at the ends of the box.
const std::vector<Tube> loop{tube({-6, 0.5, 0}, {-3, 0.5, 0}, 3),   tube({-3, 0.5, 0}, {-1, 2, 0.2}, 2.4),
                             tube({-1, 2, 0.2}, {1, 2, 0.2}, 2.4),  tube({1, 2, 0.2}, {3, 0.5, 0}, 2.4),
                             tube({-3, 0.5, 0}, {0, -1.8, 0}, 1.8), tube({0, -1.8, 0}, {3, 0.5, 0}, 1.8),
                             tube({3, 0.5, 0}, {6, 0.5, 0}, 3)};

// Whether x lies within a tube, by the way along and across its axis; images included.
bool isWithin(const std::vector<Tube>& tubes, const Vec3& x, double margin = 0) {
    for (const Tube& t : tubes)
        for (const int image : {-1, 0, 1}) {
            const Vec3 a = t.from + Vec3(12 * image, 0, 0), e = (t.to - t.from).normalized(), r = x - a;
            const double s = r.dot(e), R = t.radius() - margin;
            const bool side = s >= 0 && s <= t.length() && (r - s * e).norm() < R;
            if (side || r.norm() < R || (r - t.length() * e).norm() < R) return true;
        }
    return false;
}

// Points of the surface, about h apart, over three boxes.
std::vector<Vec3> surfaceOf(const std::vector<Tube>& tubes, double h) {
    std::vector<Vec3> points;
    for (const int image : {-1, 0, 1})
        for (const Tube& t : tubes) {
            const Vec3 e = (t.to - t.from).normalized(), p = e.unitOrthogonal(), q = e.cross(p);
            const double R = t.radius();
            const auto add = [&](const Vec3& x) {
                if (!isWithin(tubes, x, 1e-9)) points.push_back(x);
            };
            const int around = static_cast<int>(2 * pi * R / h), along = static_cast<int>(t.length() / h) + 1;
            for (int i = 0; i <= along; ++i)
                for (int j = 0; j < around; ++j) {
                    const double a = 2 * pi * j / around;
                    add(t.from + Vec3(12 * image, 0, 0) + t.length() * i / along * e +
                        R * (std::cos(a) * p + std::sin(a) * q));
                }
            for (const auto& [end, out] : {std::pair{t.from, Vec3(-e)}, std::pair{t.to, e}})
                for (double polar = 0; polar < pi / 2; polar += h / R)
                    for (int j = 0, n = static_cast<int>(2 * pi * R * std::sin(polar) / h) + 1; j < n; ++j) {
                        const double a = 2 * pi * j / n;
                        add(end + Vec3(12 * image, 0, 0) +
                            R * (std::cos(polar) * out + std::sin(polar) * (std::cos(a) * p + std::sin(a) * q)));
                    }
        }
    return points;
}

TEST(NetworkWalls, distanceAndNormal) {
    const TubeNetwork network(loop, box);
    constexpr double h = 0.04;
    const std::vector<Vec3> surface = surfaceOf(loop, h);
    ASSERT_GT(surface.size(), 50000u);
    std::mt19937 random(1);
    std::uniform_real_distribution<double> x(-6, 6), y(-3.5, 3.5), z(-1.8, 1.8);
    int inside = 0, nearJoint = 0;
    for (int k = 0; k < 400; ++k) {
        const Vec3 p = k < 200 ? Vec3(x(random), y(random), z(random))
                               : Vec3(3.2 * (k % 2 ? 1 : -1) + 0.3 * x(random), 0.5 + 0.3 * y(random), 0.5 * z(random));
        double least = 1e9;
        for (const Vec3& s : surface) least = std::min(least, (s - p).norm());
        const double found = network.distance(p);
        EXPECT_EQ(found > 0, isWithin(loop, p)) << p.transpose();
        inside += found > 0;
        nearJoint += found > 0 && k >= 200;
        EXPECT_LE(std::abs(found), least + 1e-9) << p.transpose();
        // On a curve where tubes meet there may be no point: it is then up to h further away.
        EXPECT_GE(std::abs(found) + h, least) << p.transpose();
        EXPECT_NEAR(network.distance(p + Vec3(12, 0, 0)), found, 1e-12) << "the period of the box";
        if (std::abs(found) > 0.05 && std::abs(found) < 0.4) {
            EXPECT_NEAR(network.normal(p).norm(), 1, 1e-12);
            EXPECT_NEAR(network.distance(p + 1e-4 * network.normal(p)) - found, 1e-4, 2e-6) << p.transpose();
        }
    }
    EXPECT_GT(inside, 100);
    EXPECT_GT(nearJoint, 60);
}

// Where two branches part, a wedge of solid points into the fluid. max (R - d) is too small before its edge; the
// distance from the edge itself is not.
TEST(NetworkWalls, distanceBeforeTheWedge) {
    const std::vector<Tube> fork{tube({-6, 0, 0}, {-2, 0, 0}, 2), tube({-2, 0, 0}, {2, 2, 0}, 2),
                                 tube({2, 2, 0}, {6, 0, 0}, 2), tube({-2, 0, 0}, {2, -2, 0}, 2),
                                 tube({2, -2, 0}, {6, 0, 0}, 2)};
    const TubeNetwork network(fork, box);
    const double half = std::atan(0.5), edge = -2 + 1 / std::sin(half);  // in the plane of the fork
    for (const double before : {0.02, 0.1, 0.3}) {
        EXPECT_NEAR(network.distance(Vec3(edge - before, 0, 0)), before, 1e-6);
        EXPECT_NEAR(network.normal(Vec3(edge - before, 0, 0))[0], -1, 1e-6);
    }
    EXPECT_NEAR(network.distance(Vec3(edge + 0.1, 0, 0)), -0.1 * std::sin(half), 1e-9) << "within the wedge";
}

// At a joint that is nearly straight, the walls of both tubes meet at a small angle. With a third tube nearby, no other
// wall may be taken for the nearest one.
TEST(NetworkWalls, distanceAtSmallKinks) {
    for (const double degrees : {0.1, 0.3, 0.6, 1.0, 2.0, 3.0, 6.0}) {
        const double aside = 6 * std::tan(degrees * pi / 180);
        std::vector<Tube> bent{tube({-6, -0.5, 0}, {0, -0.5, 0}, 2), tube({0, -0.5, 0}, {6, -0.5 + aside, 0}, 2),
                               tube({0, -0.5, 0}, {0, 2.5, 0}, 1.2)};
        const TubeNetwork network(bent, box);
        std::mt19937 random(3);
        std::uniform_real_distribution<double> x(-2, 2), y(-1.3, 1), z(-0.8, 0.8);
        const std::vector<Vec3> surface = surfaceOf(bent, 0.03);
        for (int k = 0; k < 60; ++k) {
            const Vec3 p(x(random), y(random), z(random));
            if (!isWithin(bent, p)) continue;
            double least = 1e9;
            for (const Vec3& s : surface) least = std::min(least, (s - p).norm());
            EXPECT_LE(network.distance(p), least + 2e-3) << degrees << " degrees, " << p.transpose();
            EXPECT_GE(network.distance(p) + 0.03, least) << degrees << " degrees, " << p.transpose();
        }
    }
}

TEST(NetworkWalls, aSingleTubeIsATube) {
    const std::string text =
        "{type: network, tubes: [{from: [-6 m, 0.3 m, 0 m], to: [6 m, 0.3 m, 0 m], diameter: 3 m}]}";
    Problems problems;
    const auto shape = readChoice<WallShape>(parseValue(text, "constant/flow.yaml", problems), problems).model;
    shape->check(box, {}, problems);
    problems.throwIfAny();
    EXPECT_FALSE(shape->isAcross(0));
    const Walls walls = shape->place(box);
    for (const Vec3& x : {Vec3(5.9, 1.2, 0.5), Vec3(-5.99, 0.3, -1.3), Vec3(0, 0.3, 1.7)})
        EXPECT_NEAR(walls[0].distance(x), 1.5 - std::hypot(x[1] - 0.3, x[2]), 1e-12);
    EXPECT_NEAR(shape->volume(box), pi * 2.25 * 12, 5e-4 * pi * 2.25 * 12);
    EXPECT_NEAR(walls[0].surface->area(), pi * 3 * 12, 1e-3 * pi * 3 * 12);
    EXPECT_NEAR(shape->volumeBehind(box, Vec3::Constant(0.5)), pi * (4 - 2.25) * 12, 1e-3 * pi * 1.75 * 12);
    const Hydraulics flow = shape->hydraulics(box);
    EXPECT_NEAR(flow.fastest, 2.25 / 4, 1e-12) << "R^2/4 on the axis";
    EXPECT_DOUBLE_EQ(flow.width, 1.5);
}

TEST(NetworkWalls, volumes) {
    NetworkWalls walls;
    walls.tubes = loop;
    std::mt19937 random(2);
    std::uniform_real_distribution<double> x(-6, 6), y(-4.5, 4.5), z(-2.5, 2.5);
    constexpr int count = 1000000;
    const double whole = 12 * 9 * 5;
    int within = 0, behind = 0;
    for (int k = 0; k < count; ++k) {
        const Vec3 p(x(random), y(random), z(random));
        if (isWithin(loop, p))
            ++within;
        else if (isWithin(loop, p, -0.4))
            ++behind;
    }
    const auto share = [&](int number) { return whole * number / count; };
    const auto error = [&](int number) { return 4 * whole * std::sqrt(number) / count; };  // four standard deviations
    EXPECT_NEAR(walls.volume(box), share(within), error(within));
    EXPECT_NEAR(walls.volumeBehind(box, Vec3::Constant(0.4)), share(behind), error(behind));
}

// Resistances l/R^4 in series and in parallel; the force acts along x alone.
TEST(NetworkWalls, flows) {
    const std::vector<double> flows = networkFlows(loop, 12);
    const auto resistance = [](const Tube& t) { return 8 * t.length() / (pi * std::pow(t.radius(), 4)); };
    const double upper = resistance(loop[1]) + resistance(loop[2]) + resistance(loop[3]),
                 lower = resistance(loop[4]) + resistance(loop[5]);
    const double total = 12 / (resistance(loop[0]) + resistance(loop[6]) + 1 / (1 / upper + 1 / lower));
    EXPECT_NEAR(flows[0], total, 1e-12 * total);
    EXPECT_NEAR(flows[6], total, 1e-12 * total);
    EXPECT_NEAR(flows[1], total * lower / (upper + lower), 1e-12 * total);
    EXPECT_NEAR(flows[4], total * upper / (upper + lower), 1e-12 * total);
    EXPECT_NEAR(flows[4], flows[5], 1e-12 * total);

    std::vector<Tube> withBlindEnd = loop;
    withBlindEnd.push_back(tube({0, -1.8, 0}, {0, -3, 0}, 1));
    EXPECT_NEAR(networkFlows(withBlindEnd, 12).back(), 0, 1e-12 * total);
    EXPECT_NEAR(networkFlows(withBlindEnd, 12)[0], total, 1e-12 * total);
}

TEST(NetworkWalls, problemsOfACase) {
    const auto messages = [](std::vector<Tube> tubes) {
        NetworkWalls walls;
        walls.tubes = std::move(tubes);
        Problems problems;
        walls.check(box, {"constant/flow.yaml", 3, 1}, problems);
        try {
            problems.throwIfAny();
        } catch (const CaseError& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    EXPECT_EQ(messages(loop), "");
    EXPECT_NE(messages({}).find("found no tubes"), std::string::npos);
    EXPECT_NE(messages({tube({-6, 0, 0}, {5, 0, 0}, 2)}).find("no tubes lead from one end"), std::string::npos);
    EXPECT_NE(messages({tube({-6, 0, 0}, {6, 1, 0}, 2)}).find("no tubes lead from one end"), std::string::npos)
        << "its ends are not at the same y";
    EXPECT_NE(messages({tube({-6, 0, 0}, {0, 0, 0}, 2), tube({0, 0.01, 0}, {6, 0, 0}, 2)})
                  .find("walls.tubes[0].to: lies 10 mm from an end of walls.tubes[1]"),
              std::string::npos)
        << messages({tube({-6, 0, 0}, {0, 0, 0}, 2), tube({0, 0.01, 0}, {6, 0, 0}, 2)});
    EXPECT_NE(messages({tube({-6, 0, 0}, {6, 0, 0}, 2), tube({4, 0, 0}, {4, 2, 0}, 1)})
                  .find("walls.tubes[1].from: lies on the axis of walls.tubes[0], which has no end there"),
              std::string::npos);
    const std::string several = messages({tube({-6, 3.5, 0}, {6, 3.5, 0}, 2), tube({1, 0, 0}, {1, 0, 0}, 2)});
    EXPECT_NE(several.find("walls.tubes[0]: reaches 4.5 m from the middle of the box along y"), std::string::npos)
        << several;
    EXPECT_NE(several.find("walls.tubes[1]: its two ends are at the same place"), std::string::npos) << several;
}

}  // namespace
}  // namespace corpuscle::boundary
