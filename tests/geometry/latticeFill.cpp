#include "geometry/latticeFill.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "core/error.hpp"
#include "geometry/kuchelFackerell.hpp"
#include "geometry/mesher.hpp"

using namespace corpuscle;
using namespace corpuscle::geometry;

namespace {

constexpr double um = 1e-6;
LatticeBox periodicBox() {
    LatticeBox box;
    box.size = Vec3(12, 10, 6) * um;
    box.spacing = 0.5 * um;
    return box;
}

TEST(LatticeFill, cellCentredAndComplete) {
    const Lattice lattice = fillLattice(periodicBox());
    EXPECT_EQ(lattice.count, (Index3{24, 20, 12}));
    ASSERT_EQ(lattice.points.size(), 24u * 20 * 12);
    EXPECT_LT((lattice.points.front() - Vec3(-5.75, -4.75, -2.75) * um).norm(), 1e-18);
    EXPECT_LT((lattice.points.back() - Vec3(5.75, 4.75, 2.75) * um).norm(), 1e-18);
    EXPECT_NEAR(lattice.points[1].x() - lattice.points[0].x(), 0.5 * um, 1e-18);
}

TEST(LatticeFill, adjustsTheSpacingWithinATenthOfAPercent) {
    LatticeBox box = periodicBox();
    box.size.x() = 12.008 * um;
    EXPECT_NEAR(fillLattice(box).spacing.x(), 12.008 * um / 24, 1e-18);
    box.size.x() = 12.2 * um;
    try {
        fillLattice(box);
        FAIL();
    } catch (const Failure& failure) {
        const std::string text = failure.what();
        EXPECT_EQ(failure.code(), ExitCode::invalidCase);
        EXPECT_NE(text.find("along x"), std::string::npos) << text;
        EXPECT_NE(text.find("12 um (24 spacings)"), std::string::npos) << text;
        EXPECT_NE(text.find("12.5 um (25 spacings)"), std::string::npos) << text;
    }
}

// Plane walls at both ends of the box along an axis, with this many layers of particles behind them.
LatticeBox walled(int axis, int layers) {
    LatticeBox box = periodicBox();
    box.layers[static_cast<std::size_t>(axis)] = layers;
    box.kindOf = [axis, half = 0.5 * box.size[axis]](const Vec3& x) {
        return std::abs(x[axis]) < half ? PointKind::fluid : PointKind::wall;
    };
    return box;
}

TEST(LatticeFill, wallLayersBeyondTheWalls) {
    const Lattice lattice = fillLattice(walled(2, 3));
    int lower = 0, upper = 0;
    for (std::size_t n = 0; n < lattice.points.size(); ++n) {
        const double z = lattice.points[n].z();
        if (lattice.kinds[n] == PointKind::wall) {
            ++(z < 0 ? lower : upper);
            EXPECT_GT(std::abs(z), 3 * um);
        }
        if (lattice.kinds[n] == PointKind::fluid) {
            EXPECT_LT(std::abs(z), 3 * um);
        }
    }
    EXPECT_EQ(lower, 24 * 20 * 3);
    EXPECT_EQ(upper, 24 * 20 * 3);
    EXPECT_NEAR(lattice.points.front().z(), -4.25 * um, 1e-18);
}

// A tube along x, with a wall three spacings thick, leaves the corners of the box empty.
TEST(LatticeFill, leavesOutWhereNothingIs) {
    LatticeBox box = periodicBox();
    const double radius = 2 * um, thickness = 1.5 * um;
    box.layers = {0, 1, 1};
    box.kindOf = [=](const Vec3& x) {
        const double depth = std::hypot(x[1], x[2]) - radius;
        return depth < 0 ? PointKind::fluid : depth < thickness ? PointKind::wall : PointKind::nothing;
    };
    const Lattice lattice = fillLattice(box);
    long fluid = 0, wall = 0;
    for (std::size_t n = 0; n < lattice.points.size(); ++n) {
        const double r = std::hypot(lattice.points[n][1], lattice.points[n][2]);
        EXPECT_EQ(lattice.kinds[n], r < radius ? PointKind::fluid : PointKind::wall);
        EXPECT_LT(r, radius + thickness);
        ++(lattice.kinds[n] == PointKind::fluid ? fluid : wall);
    }
    const double volume = box.size[0] * std::numbers::pi / std::pow(box.spacing, 3);
    EXPECT_NEAR(static_cast<double>(fluid), volume * radius * radius, 0.06 * static_cast<double>(fluid));
    EXPECT_NEAR(static_cast<double>(wall), volume * (std::pow(radius + thickness, 2) - radius * radius),
                0.06 * static_cast<double>(wall));
}

TEST(LatticeFill, jitterMovesTheFluidOnlyAndFollowsTheSeed) {
    LatticeBox box = walled(1, 2);
    const Lattice still = fillLattice(box);
    box.jitter = 0.2;
    const Lattice moved = fillLattice(box), again = fillLattice(box);
    box.seed = 2;
    const Lattice other = fillLattice(box);
    double largest = 0;
    for (std::size_t n = 0; n < still.points.size(); ++n) {
        const double shift = (moved.points[n] - still.points[n]).cwiseAbs().maxCoeff();
        if (still.kinds[n] != PointKind::fluid) {
            EXPECT_EQ(shift, 0);
        }
        largest = std::max(largest, shift);
    }
    EXPECT_LE(largest, 0.1 * um);
    EXPECT_GT(largest, 0.09 * um);
    EXPECT_EQ(moved.points, again.points);
    EXPECT_NE(moved.points, other.points);
}

TEST(Carve, takesTheNearestPoints) {
    const Lattice lattice = fillLattice(periodicBox());
    const std::vector<Vec3> nodes{{5.9 * um, 0, 0}, {0.1 * um, 0.2 * um, 0.3 * um}, {-2 * um, 1 * um, 2.9 * um}};
    const Vec3 lengths(12 * um, 10 * um, 0);
    const Periodicity period = Periodicity::centred(lengths);
    for (const std::size_t count : {std::size_t{1}, std::size_t{25}, std::size_t{700}, lattice.points.size()}) {
        const std::vector<int> removed = carve(lattice.points, nodes, count, period);
        ASSERT_EQ(removed.size(), count);
        EXPECT_TRUE(std::is_sorted(removed.begin(), removed.end()));
        const std::set<int> taken(removed.begin(), removed.end());
        double farthestTaken = 0, nearestLeft = std::numeric_limits<double>::infinity();
        for (int i = 0; i < static_cast<int>(lattice.points.size()); ++i) {
            double d = std::numeric_limits<double>::infinity();
            for (const Vec3& node : nodes) {
                Vec3 r = lattice.points[i] - node;
                for (int axis = 0; axis < 2; ++axis) r[axis] -= lengths[axis] * std::round(r[axis] / lengths[axis]);
                d = std::min(d, r.norm());
            }
            if (taken.contains(i))
                farthestTaken = std::max(farthestTaken, d);
            else
                nearestLeft = std::min(nearestLeft, d);
        }
        EXPECT_LE(farthestTaken, nearestLeft + 1e-15);
    }
    EXPECT_TRUE(carve(lattice.points, nodes, 0).empty());
    EXPECT_THROW(carve(lattice.points, nodes, lattice.points.size() + 1), Failure);
}

TEST(TagSides, cellsAcrossAPeriodicFace) {
    LatticeBox box = periodicBox();
    box.size = Vec3(20, 10, 6) * um;
    const Lattice lattice = fillLattice(box);
    const Periodicity period = Periodicity::centred({20 * um, 10 * um, 0});
    const KuchelFackerell shape(8 * um, 2.12 * um, 1 * um);
    std::vector<TriangleMesh> cells(2, meshSurface(shape, 0.5 * um));
    cells[1].translate({9 * um, 1 * um, 0});  // extends beyond the box at x = 10 um
    const std::vector<int> side = tagSides(lattice.points, cells, period);
    for (int n = 1; n <= 2; ++n)
        EXPECT_NEAR(static_cast<double>(std::count(side.begin(), side.end(), n)) * 0.125, cells[n - 1].volume() * 1e18,
                    6);
    for (std::size_t i = 0; i < side.size(); ++i)
        if (side[i] == 2) {
            EXPECT_GT(std::abs(lattice.points[i].x()), 5 * um - 1e-12);
        }

    // Points nearer than 0.1 um are moved out to this distance, on their own side; no other point moves.
    std::vector<Vec3> held = lattice.points;
    const double least = 0.1 * um;
    const std::size_t moved = holdOff(held, side, cells, least, period);
    std::size_t different = 0;
    for (std::size_t i = 0; i < held.size(); ++i) different += held[i] != lattice.points[i];
    EXPECT_EQ(different, moved);
    EXPECT_GT(moved, 100u);
    std::vector<Vec3> inBox = held;
    for (Vec3& x : inBox) x.x() -= period.lengths().x() * std::round(x.x() / period.lengths().x());
    EXPECT_EQ(tagSides(inBox, cells, period), side);
    EXPECT_EQ(holdOff(held, side, cells, 0.9 * least, period), 0u);

    cells[1] = cells[0];
    EXPECT_THROW(tagSides(lattice.points, cells, period), Failure);
}

}  // namespace
