// Cells that extend more than half a box from their centroid, and surfaces that meet: sides, distances and crossings
// through periodic boundaries, compared with sums over all images.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "geometry/crossings.hpp"
#include "geometry/latticeFill.hpp"
#include "geometry/mesher.hpp"
#include "geometry/periodicSurface.hpp"
#include "geometry/sidesByRays.hpp"
#include "geometry/spheroid.hpp"

using namespace corpuscle;
using namespace corpuscle::geometry;

namespace {

constexpr double um = 1e-6;

TriangleMesh ball(double radius, double edge, const Vec3& centre = Vec3::Zero()) {
    TriangleMesh mesh = meshSurface(Sphere(radius), edge);
    mesh.translate(centre);
    return mesh;
}

// A ball of radius 2.5 um, of which the upper half is stretched to a tail of 8.5 um.
TriangleMesh tailed(const Vec3& axis, const Vec3& centre) {
    static const TriangleMesh straight = [] {
        TriangleMesh mesh = ball(2.5 * um, 0.6 * um);
        for (Vec3& x : mesh.nodes)
            if (x.z() > 0) x.z() *= 1 + 2.4 * std::pow(x.z() / (2.5 * um), 3);
        return mesh;
    }();
    TriangleMesh mesh = straight;
    mesh.rotate(rotationFromZ(axis));
    mesh.translate(centre);
    return mesh;
}

// Points of a lattice in the box [-size/2, size/2).
std::vector<Vec3> lattice(const Vec3& size, double spacing) {
    LatticeBox box;
    box.size = size;
    box.spacing = spacing;
    box.jitter = 0.2;
    return fillLattice(box).points;
}

// By the solid angles of the surface, for all 7 x 7 x 7 images of the point.
bool insideAnyImage(const TriangleMesh& mesh, const Vec3& x, const Periodicity& period) {
    Vec3 low = mesh.nodes.front(), high = low;
    for (const Vec3& n : mesh.nodes) low = low.cwiseMin(n), high = high.cwiseMax(n);
    for (int n = 0; n < 343; ++n) {
        const Vec3 image = x + Vec3(n % 7 - 3, n / 7 % 7 - 3, n / 49 - 3).cwiseProduct(period.lengths());
        if ((image.array() < low.array()).any() || (image.array() > high.array()).any()) continue;
        if (windingNumber(mesh, image) > 0.5) return true;
    }
    return false;
}

struct TailedCase {
    Vec3 axis, centre, size;
    std::array<bool, 3> periodic;
};

class Tailed : public testing::TestWithParam<TailedCase> {
  protected:
    Periodicity period() const { return {low(), high(), GetParam().periodic}; }
    Vec3 low() const { return -0.5 * GetParam().size; }
    Vec3 high() const { return 0.5 * GetParam().size; }
};

TEST_P(Tailed, sidesAreThoseOfTheSurfaceByThreeMethods) {
    const TriangleMesh mesh = tailed(GetParam().axis, GetParam().centre);
    const std::vector<Vec3> points = lattice(GetParam().size, 0.5 * um);
    const std::vector<int> columns = tagSides(points, {mesh}, period());
    const std::vector<RaySide> rays = sidesByRays(points, {mesh}, low(), high(), period());
    long inside = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        inside += columns[i];
        ASSERT_EQ(columns[i], rays[i].mesh) << points[i].transpose();
        ASSERT_FALSE(rays[i].isInSeveral);
        if (i % 17 == 0) {
            ASSERT_EQ(columns[i] == 1, insideAnyImage(mesh, points[i], period())) << points[i].transpose();
        }
    }
    EXPECT_NEAR(static_cast<double>(inside) * std::pow(0.5 * um, 3), mesh.volume(), 0.02 * mesh.volume());
}

TEST_P(Tailed, theNearestImageIsTheNearestOfAll) {
    const TriangleMesh mesh = tailed(GetParam().axis, GetParam().centre);
    const double reach = 1.5 * um;
    const TriangleTree grid(mesh, reach);
    const NearestImages images(grid, mesh.nodes, period());
    const PeriodicSurface surface(mesh, reach, period());
    std::size_t found = 0;
    const std::vector<Vec3> points = lattice(GetParam().size, 0.5 * um);
    for (std::size_t i = 0; i < points.size(); i += 7) {
        const Vec3& x = points[i];
        double least = reach, signedLeast = 0;
        for (int n = 0; n < 343; ++n) {
            const SurfacePoint at =
                grid.nearest(x + Vec3(n % 7 - 3, n / 7 % 7 - 3, n / 49 - 3).cwiseProduct(period().lengths()));
            if (at && std::abs(at.distance) < least) least = std::abs(at.distance), signedLeast = at.distance;
        }
        const NearestImages::Found nearest = images.nearest(x);
        ASSERT_EQ(static_cast<bool>(nearest), least < reach) << x.transpose();
        const PeriodicSurface::Place place = surface.at(x);
        ASSERT_EQ(place.distance < 0, insideAnyImage(mesh, x, period())) << x.transpose();
        if (!nearest) continue;
        ++found;
        ASSERT_NEAR(nearest.at.distance, signedLeast, 1e-12 * um);
        ASSERT_NEAR((nearest.image - nearest.at.point).norm(), least, 1e-9 * um);
        ASSERT_EQ(place.distance, nearest.at.distance);
    }
    EXPECT_GT(found, 100);
}

// Particles within 0.1 um are moved out to this distance on their own side, also in the tail.
TEST_P(Tailed, particlesAreHeldOffOnTheirOwnSide) {
    const TriangleMesh mesh = tailed(GetParam().axis, GetParam().centre);
    std::vector<Vec3> points = lattice(GetParam().size, 0.5 * um);
    const std::vector<int> side = tagSides(points, {mesh}, period());
    EXPECT_GT(holdOff(points, side, {mesh}, 0.1 * um, period()), 10);
    EXPECT_EQ(tagSides(points, {mesh}, period()), side);
    EXPECT_LT(holdOff(points, side, {mesh}, 0.099 * um, period()), points.size() / 1000);
}

constexpr std::array<bool, 3> alongX{true, false, false}, alongXY{true, true, false}, alongAll{true, true, true};

INSTANTIATE_TEST_SUITE_P(
    boxes, Tailed,
    testing::Values(TailedCase{{1, 0, 0}, {0, 0, 0}, {12 * um, 12 * um, 12 * um}, alongX},
                    TailedCase{{1, 0, 0}, {0, 0, 0}, {18 * um, 12 * um, 12 * um}, alongX},
                    TailedCase{{1, 0, 0}, {5 * um, 3 * um, 0}, {11.5 * um, 8 * um, 8 * um}, alongXY},
                    TailedCase{{0, 1, 0}, {1 * um, 20 * um, 0}, {8 * um, 12 * um, 8 * um}, alongXY},
                    TailedCase{{1, 1, 0}, {-3 * um, 2 * um, 0}, {11 * um, 11 * um, 9 * um}, alongXY},
                    TailedCase{{0, 0, -1}, {1 * um, -2 * um, 3 * um}, {9 * um, 9 * um, 12 * um}, alongAll},
                    TailedCase{{1, -1, 1}, {4 * um, 4 * um, 4 * um}, {10 * um, 10 * um, 10 * um}, alongAll},
                    TailedCase{{1, 1, 1}, {0, 0, 0}, {16 * um, 9 * um, 9 * um}, alongAll}));

// An inclined rod longer than the box, which passes its own images without touching them.
TEST(PeriodicSurface, surfacesLongerThanTheBoxHaveTheirSidesToo) {
    TriangleMesh rod = ball(1 * um, 0.35 * um);
    for (Vec3& x : rod.nodes) x.z() *= 7;
    rod.rotate(rotationFromZ({1, 0, 0.8}));  // 14 um long; 10.9 um of it along x
    const Periodicity period = Periodicity::centred({6 * um, 0, 0});
    const SurfaceView view{&rod.nodes, &rod.triangles};
    for (const ImagePair& pair : neighbours({view.bounds()}, period)) EXPECT_FALSE(crossing(view, view, pair.shift));
    const Vec3 size(6 * um, 6 * um, 14 * um);
    const std::vector<Vec3> points = lattice(size, 0.5 * um);
    const std::vector<int> side = tagSides(points, {rod}, period);
    const std::vector<RaySide> rays = sidesByRays(points, {rod}, -0.5 * size, 0.5 * size, period);
    for (std::size_t i = 0; i < points.size(); i += 5)
        ASSERT_TRUE(side[i] == rays[i].mesh && (side[i] == 1) == insideAnyImage(rod, points[i], period));
}

struct Meeting {
    const char* what;
    Vec3 centre;  // of the second ball, radius 1 um; the first stands at the origin with radius 2 um
    Vec3 period;  // 0 along an axis that is not periodic
    bool cross;
};

class Meetings : public testing::TestWithParam<Meeting> {};

TEST_P(Meetings, areFound) {
    const TriangleMesh one = ball(2 * um, 0.5 * um), other = ball(1 * um, 0.3 * um, GetParam().centre);
    const SurfaceView views[2] = {{&one.nodes, &one.triangles}, {&other.nodes, &other.triangles}};
    std::size_t found = 0;
    for (const ImagePair& pair :
         neighbours({views[0].bounds(), views[1].bounds()}, Periodicity::centred(GetParam().period))) {
        const auto cut = crossing(views[pair.first], views[pair.second], pair.shift);
        if (!cut) continue;
        ++found;
        ASSERT_EQ(pair.first, 0);
        ASSERT_EQ(pair.second, 1);
        EXPECT_NEAR(cut->place.norm(), 2 * um, 0.15 * um) << "on the first";
        EXPECT_NEAR((cut->place - GetParam().centre - pair.shift).norm(), 1 * um, 0.15 * um) << "and on the second";
    }
    EXPECT_EQ(found, GetParam().cross ? 1 : 0);
}

const Vec3 none = Vec3::Zero(), box(10 * um, 10 * um, 10 * um);

INSTANTIATE_TEST_SUITE_P(pairs, Meetings,
                         testing::Values(Meeting{"apart", {3.2 * um, 0, 0}, none, false},
                                         Meeting{"touching", {2.94 * um, 0, 0}, none, true},
                                         Meeting{"overlapping", {1.5 * um, 1.5 * um, 0}, none, true},
                                         Meeting{"inside", {0.5 * um, 0, 0}, none, false},
                                         Meeting{"apart, periodic", {5 * um, 5 * um, 5 * um}, box, false},
                                         Meeting{"through one face", {7.5 * um, 0, 0}, box, true},
                                         Meeting{"through an edge", {-8 * um, 8.5 * um, 0}, box, true},
                                         Meeting{"through a corner", {8.5 * um, 8.5 * um, -8.5 * um}, box, true},
                                         Meeting{"boxes away", {102.5 * um, -50 * um, 30 * um}, box, true},
                                         Meeting{"not periodic there", {7.5 * um, 0, 0}, {0, 10 * um, 10 * um}, false}),
                         [](const testing::TestParamInfo<Meeting>& info) {
                             std::string name = info.param.what;
                             std::erase_if(name, [](char c) { return !std::isalnum(static_cast<unsigned char>(c)); });
                             return name;
                         });

TEST(Crossings, aSurfaceAndItsOwnImage) {
    for (const auto& [axis, length, expected] :
         {std::tuple(Vec3(1, 0, 0), 11.05, 0), std::tuple(Vec3(1, 0, 0), 10.0, 1), std::tuple(Vec3(1, 0, 0), 6.0, 1),
          std::tuple(Vec3(0, 0, 1), 4.9, 2), std::tuple(Vec3(0, 1, 0), 4.9, 2)}) {
        const TriangleMesh mesh = tailed(axis, {3 * um, 20 * um, 0});
        const SurfaceView view{&mesh.nodes, &mesh.triangles};
        const Periodicity period = Periodicity::centred({length * um, expected < 2 ? 0 : length * um, 0});
        std::size_t found = 0;
        for (const ImagePair& pair : neighbours({view.bounds()}, period)) {
            EXPECT_EQ(pair.first, pair.second);
            found += crossing(view, view, pair.shift).has_value();
        }
        EXPECT_GE(found, static_cast<std::size_t>(expected > 0)) << axis.transpose() << ", " << length;
        if (expected == 0) {
            EXPECT_EQ(found, 0);
        }
    }
}

// Each pair of images is found once, however many box lengths the cells have drifted, and the number of pairs is
// proportional to the number of cells.
TEST(Crossings, neighboursOfALattice) {
    for (const int n : {3, 6}) {
        std::vector<Bounds> bounds;
        std::mt19937_64 random(1);
        const double length = n;
        for (int k = 0; k < n * n * n; ++k) {
            const Vec3 drift = length * Vec3(static_cast<int>(random() % 7) - 3, static_cast<int>(random() % 7) - 3, 0);
            const Vec3 at = Vec3(k % n, k / n % n, k / (n * n)) + drift;
            bounds.emplace_back(at, at + Vec3(1.2, 0.9, 0.9));
        }
        EXPECT_EQ(neighbours(bounds, Periodicity::centred({length, length, length})).size(), n * n * n)
            << "along x only";
        EXPECT_EQ(neighbours(bounds, Periodicity::centred({length, length, length}), 0.15).size(), 13 * n * n * n)
            << "all 26 around";
    }
    EXPECT_TRUE(neighbours({}, Periodicity::centred(box)).empty());
    Bounds empty;
    EXPECT_TRUE(neighbours({empty, empty}, Periodicity::centred(box)).empty());
}

// Comparison with every image, enumerated, where images slide: cuboids anywhere, some longer than half the box.
TEST(Crossings, neighboursWhereImagesSlide) {
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> unit(0, 1);
    const Vec3 length(5, 4, 6);
    for (const auto& [axis, offset] : {std::pair(2, Vec3(2.4, 0, 0)), {2, Vec3(-1.1, 0, 0)}, {1, Vec3(0.3, 0, -2)}}) {
        Periodicity period = Periodicity::centred(length);
        period.slide(axis, offset, Vec3::Zero());
        std::vector<Bounds> bounds;
        for (int k = 0; k < 12; ++k) {
            const Vec3 at = 20 * (Vec3(unit(random), unit(random), unit(random)) - Vec3::Constant(0.5));
            bounds.emplace_back(at, at + Vec3(0.3 + 3 * unit(random), 0.5, 0.3 + 3 * unit(random)));
        }
        constexpr double margin = 0.2;
        std::size_t expected = 0;
        const std::vector<ImagePair> found = neighbours(bounds, period, margin);
        for (std::size_t a = 0; a < bounds.size(); ++a)
            for (std::size_t b = a; b < bounds.size(); ++b) {
                std::size_t images = 0, listed = 0;
                for (int n = 0; n < 21 * 21 * 21; ++n) {
                    const Index3 by{n % 21 - 10, n / 21 % 21 - 10, n / 441 - 10};
                    if (a == b && by == Index3{0, 0, 0}) continue;
                    const Vec3 shift = period.image(by).shift;
                    const Bounds grown(bounds[a].min() - Vec3::Constant(margin),
                                       bounds[a].max() + Vec3::Constant(margin));
                    if (!grown.intersects(bounds[b].translated(shift))) continue;
                    ++images;
                    for (const ImagePair& pair : found) {
                        const bool same = (pair.shift - shift).norm() < 1e-12;
                        const bool opposite = a == b && (pair.shift + shift).norm() < 1e-12;
                        listed += pair.first == a && pair.second == b && (same || opposite) ? 1 : 0;
                    }
                }
                EXPECT_EQ(listed, images) << a << " " << b;
                expected += a == b ? images / 2 : images;
            }
        EXPECT_EQ(found.size(), expected);
    }
}

}  // namespace
