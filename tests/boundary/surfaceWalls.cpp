// Walls from surface files: a tube in triangles against the round tube, and each fault that a vessel may have.
#include "boundary/surfaceWalls.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <random>

#include "boundary/tubeWalls.hpp"
#include "core/error.hpp"

namespace corpuscle::boundary {
namespace {

constexpr double pi = std::numbers::pi;
const particles::Box box{Vec3(-3, -2, -2), Vec3(3, 2, 2), {true, false, false}};

// An open tube of radius R(x) around the x axis, from `low` to `high`.
geometry::TriangleMesh tube(const std::function<double(double)>& radius, double low = -3, double high = 3,
                            int along = 48, int around = 64) {
    geometry::TriangleMesh mesh;
    for (int i = 0; i <= along; ++i)
        for (int j = 0; j < around; ++j) {
            const double x = low + (high - low) * i / along, a = 2 * pi * j / around;
            mesh.nodes.emplace_back(x, radius(x) * std::cos(a), radius(x) * std::sin(a));
        }
    for (int i = 0; i < along; ++i)
        for (int j = 0; j < around; ++j) {
            const int a = i * around + j, b = i * around + (j + 1) % around;
            mesh.triangles.push_back({a, b, a + around});
            mesh.triangles.push_back({b, b + around, a + around});
        }
    return mesh;
}

struct Folder {
    std::filesystem::path path =
        std::filesystem::temp_directory_path() / ("walls" + std::to_string(std::random_device()()));
    Folder() { std::filesystem::create_directories(path); }
    ~Folder() { std::filesystem::remove_all(path); }
};

void writeOff(const std::filesystem::path& file, const geometry::TriangleMesh& mesh) {
    std::ofstream out(file);
    out.precision(17);
    out << "OFF\n" << mesh.nodes.size() << " " << mesh.triangles.size() << " 0\n";
    for (const Vec3& x : mesh.nodes) out << x.transpose() << "\n";
    for (const Index3& t : mesh.triangles) out << "3 " << t[0] << " " << t[1] << " " << t[2] << "\n";
}

SurfaceWalls wallsOf(const geometry::TriangleMesh& mesh, const std::string& fluid = "inside", double scale = 1) {
    const Folder folder;
    writeOff(folder.path / "vessel.off", mesh);
    SurfaceWalls walls;
    walls.file = "vessel.off", walls.fluid = fluid, walls.scale = scale;
    walls.prepare(folder.path);
    return walls;
}

std::string faultsOf(const SurfaceWalls& walls, const particles::Box& in = box) {
    Problems problems;
    walls.check(in, {"constant/flow.yaml", 0, 0}, problems);
    try {
        problems.throwIfAny();
    } catch (const Failure& failure) {
        return failure.what();
    }
    return {};
}

double straight(double) { return 1.5; }
double wavy(double x) { return 1.2 * (1 + 0.3 * std::cos(2 * pi * x / 6)); }

TEST(SurfaceWalls, isTheTubeOfItsTriangles) {
    const SurfaceWalls vessel = wallsOf(tube(straight));
    EXPECT_EQ(faultsOf(vessel), "");
    const Walls walls = vessel.place(box);
    const double sagitta = 1.5 * (1 - std::cos(pi / 64));
    std::mt19937 random(2);
    std::uniform_real_distribution<double> x(-3, 3), across(-2.5, 2.5);
    for (int k = 0; k < 2000; ++k) {
        const Vec3 p(x(random), across(random), across(random));
        const double exact = 1.5 - std::hypot(p[1], p[2]);
        // Further away than four spacings of its grid, of 0.075 here, distances are interpolated.
        EXPECT_LE(std::abs(walls[0].distance(p) - exact), std::abs(exact) < 0.25 ? 1.01 * sagitta : 0.06)
            << p.transpose();
        if (std::abs(exact) > 0.05 && std::abs(exact) < 1) {
            EXPECT_GT(walls[0].normal(p).dot(Vec3(0, -p[1], -p[2]).normalized()), 0.99);
        }
        EXPECT_NEAR(walls[0].distance(p + Vec3(6, 0, 0)), walls[0].distance(p), 1e-6);
    }
    const double part = std::sin(2 * pi / 64) / (2 * pi / 64);  // area of the polygon over that of the circle
    EXPECT_NEAR(vessel.volume(box), pi * 2.25 * 6 * part, 1e-9);
    TubeWalls round;
    round.diameter = 3;
    const Vec3 depth = Vec3::Constant(0.3);
    EXPECT_NEAR(vessel.volumeBehind(box, depth), round.volumeBehind(box, depth),
                0.005 * round.volumeBehind(box, depth));
    EXPECT_NEAR(vessel.hydraulics(box).fastest, round.hydraulics(box).fastest, 0.01 * round.hydraulics(box).fastest);
    EXPECT_NEAR(vessel.hydraulics(box).width, 1.5, 0.01);
}

// At the ends a tube whose radius varies is nearest through its image.
TEST(SurfaceWalls, continuesThroughItsEnds) {
    const Walls walls = wallsOf(tube(wavy, -3, 3, 96, 96)).place(box);
    const Walls longer =
        wallsOf(tube(wavy, -9, 9, 288, 96)).place({Vec3(-9, -2, -2), Vec3(9, 2, 2), {true, false, false}});
    for (double x = -2.99; x < 3; x += 0.123)
        for (const double r : {0.0, 0.5, 0.9, 1.3}) {
            const Vec3 p(x, r * std::cos(x), r * std::sin(x));
            const double expected = longer[0].distance(p);  // near the wall exact
            EXPECT_NEAR(walls[0].distance(p), expected, std::abs(expected) < 0.25 ? 1e-12 : 0.02) << p.transpose();
        }
}

TEST(SurfaceWalls, turnsTrianglesAndSaysSo) {
    geometry::TriangleMesh mesh = tube(straight);
    for (std::size_t t = 0; t < mesh.triangles.size(); t += 3) std::swap(mesh.triangles[t][0], mesh.triangles[t][1]);
    const SurfaceWalls vessel = wallsOf(mesh);
    EXPECT_EQ(faultsOf(vessel), "");
    ASSERT_EQ(vessel.remarks().size(), 1u);
    EXPECT_NE(vessel.remarks()[0].find("turned"), std::string::npos) << vessel.remarks()[0];
    EXPECT_NEAR(vessel.place(box)[0].distance(Vec3(0.3, 0, 0)), 1.5, 0.1);
    mesh = tube(straight);
    mesh.flip();
    EXPECT_NEAR(wallsOf(mesh).place(box)[0].distance(Vec3(0.3, 0, 0)), 1.5, 0.1);
}

TEST(SurfaceWalls, obstaclesInAPeriodicBox) {
    geometry::TriangleMesh ball = tube([](double x) { return std::sqrt(std::max(0.0, 1 - x * x)); }, -1, 1, 64, 64);
    // The ends of this tube are points: its triangles there have two corners at the same place, which reading removes.
    const SurfaceWalls walls = wallsOf(ball, "outside");
    const particles::Box whole{Vec3(-3, -2, -2), Vec3(3, 2, 2), {true, true, true}};
    EXPECT_EQ(faultsOf(walls, whole), "");
    for (int k = 0; k < 3; ++k) EXPECT_FALSE(walls.isAcross(k));
    const Walls placed = walls.place(whole);
    EXPECT_NEAR(placed[0].distance(Vec3(0, 0, 1.5)), 0.5, 5e-3);
    EXPECT_NEAR(placed[0].distance(Vec3(0, 0.2, 0)), -0.8, 0.02);
    EXPECT_NEAR(placed[0].distance(Vec3(0, 0, 2.6)), placed[0].distance(Vec3(0, 0, -1.4)), 1e-6) << "an image";
    EXPECT_NEAR(walls.volume(whole), 96 - 4 * pi / 3, 0.02);
}

// An octahedron of this radius.
geometry::TriangleMesh octahedron(const Vec3& centre, double radius, bool inwards) {
    geometry::TriangleMesh mesh;
    for (int k = 0; k < 3; ++k)
        for (const double sign : {-1.0, 1.0}) mesh.nodes.push_back(centre + sign * radius * Vec3::Unit(k));
    for (const int x : {0, 1})
        for (const int y : {2, 3})
            for (const int z : {4, 5}) {
                const bool outwards = ((x + y + z) % 2 == 0) != inwards;  // 1, 3, 5 are on the positive sides
                mesh.triangles.push_back(outwards ? Index3{x, z, y} : Index3{x, y, z});
            }
    return mesh;
}

geometry::TriangleMesh joined(geometry::TriangleMesh one, const geometry::TriangleMesh& other) {
    const auto first = static_cast<int>(one.nodes.size());
    one.nodes.insert(one.nodes.end(), other.nodes.begin(), other.nodes.end());
    for (const Index3& t : other.triangles) one.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
    return one;
}

// Each part is oriented on its own, whichever way its triangles are given.
TEST(SurfaceWalls, orientsEachPart) {
    const particles::Box whole{Vec3(-3, -2, -2), Vec3(3, 2, 2), {true, true, true}};
    for (const bool first : {false, true})
        for (const bool second : {false, true}) {
            const Vec3 one(-1.5, 0, 0), two(1.5, 0.2, 0);
            const SurfaceWalls obstacles =
                wallsOf(joined(octahedron(one, 1, first), octahedron(two, 1, second)), "outside");
            EXPECT_EQ(faultsOf(obstacles, whole), "");
            const Walls walls = obstacles.place(whole);
            EXPECT_LT(walls[0].distance(one), -0.4) << first << second;
            EXPECT_LT(walls[0].distance(two), -0.4) << first << second;
            EXPECT_GT(walls[0].distance(Vec3(0, 1.5, 1.5)), 0.5) << first << second;
            EXPECT_NEAR(obstacles.volume(whole), 96 - 8.0 / 3, 1e-9);
            // The same body in a vessel: there the fluid is around it too.
            const SurfaceWalls post = wallsOf(joined(tube(straight), octahedron(Vec3(0, 0, 0), 0.8, second)));
            EXPECT_EQ(faultsOf(post), "");
            const Walls around = post.place(box);
            EXPECT_LT(around[0].distance(Vec3(0, 0, 0)), -0.3) << second;
            EXPECT_NEAR(around[0].distance(Vec3(0, 0, 1.2)), 0.3, 0.01) << second;
            EXPECT_LT(around[0].distance(Vec3(0, 0, 1.8)), -0.2) << second;
        }
}

TEST(SurfaceWalls, refusesEachFault) {
    geometry::TriangleMesh hole = tube(straight);
    hole.triangles.erase(hole.triangles.begin() + 2000);
    EXPECT_NE(faultsOf(wallsOf(hole)).find("3 edges are open"), std::string::npos) << faultsOf(wallsOf(hole));
    const std::string shorter = faultsOf(wallsOf(tube(straight, -2.5, 2.5)));
    EXPECT_NE(shorter.find("128 edges are open"), std::string::npos) << shorter;
    EXPECT_NE(shorter.find("ends of the box"), std::string::npos) << shorter;
    const std::string cone = faultsOf(wallsOf(tube([](double x) { return 1 + 0.05 * x; })));
    EXPECT_NE(cone.find("do not fit together"), std::string::npos) << cone;
    const std::string wide = faultsOf(wallsOf(tube([](double) { return 2.5; })));
    EXPECT_NE(wide.find("beyond the box"), std::string::npos) << wide;
    const std::string unit = faultsOf(wallsOf(tube(straight), "inside", 1e3));
    EXPECT_NE(unit.find("scale: 1 m"), std::string::npos) << unit;
    geometry::TriangleMesh twice = tube(straight), other = tube([](double) { return 0.5; }, -0.5, 0.5);
    const auto first = static_cast<int>(twice.nodes.size());
    for (const Vec3& x : other.nodes) twice.nodes.push_back(x + Vec3(0, 1.5, 0));
    for (const Index3& t : other.triangles) twice.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
    const std::string crossing = faultsOf(wallsOf(twice));
    EXPECT_NE(crossing.find("cross each other"), std::string::npos) << crossing;
    EXPECT_NE(crossing.find("edges are open"), std::string::npos) << "all faults at once: " << crossing;
    geometry::TriangleMesh fin = tube(straight);
    fin.nodes.emplace_back(0, 1.9, 0.2);
    fin.triangles.push_back({24 * 64, 24 * 64 + 1, static_cast<int>(fin.nodes.size()) - 1});
    EXPECT_NE(faultsOf(wallsOf(fin)).find("more than two triangles"), std::string::npos) << faultsOf(wallsOf(fin));
    geometry::TriangleMesh capped = tube(straight);
    const auto centre = static_cast<int>(capped.nodes.size());
    capped.nodes.emplace_back(-3, 0, 0);
    for (int j = 0; j < 64; ++j) capped.triangles.push_back({centre, (j + 1) % 64, j});
    const std::string oneEnd = faultsOf(wallsOf(capped));
    EXPECT_NE(oneEnd.find("open at one end only and closed at the end of the box, x = -3 m"), std::string::npos)
        << oneEnd;
    const std::string closed = faultsOf(wallsOf(octahedron(Vec3(0, 0, 0), 1, false)));
    EXPECT_NE(closed.find("closed at the ends of the box"), std::string::npos) << closed;
    geometry::TriangleMesh turned = tube(straight);  // an ellipse that lies at one end and stands at the other
    for (Vec3& x : turned.nodes) {
        const double wide = std::exp(0.08 * x[0]);
        x[1] *= wide, x[2] /= wide;
    }
    EXPECT_NE(faultsOf(wallsOf(turned)).find("do not fit together"), std::string::npos) << faultsOf(wallsOf(turned));
    EXPECT_EQ(faultsOf(wallsOf(tube(straight, -3, 3 - 2e-4))), "") << "within the tolerance of an end";
    SurfaceWalls none;
    none.file = "none.stl";
    EXPECT_THROW(none.prepare("/tmp"), Failure);
}

}  // namespace
}  // namespace corpuscle::boundary
