// Rigid surfaces in contact: derivatives of their energy against differences, and the free fraction of motions.
#include "packing/crowd.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "boundary/planeWalls.hpp"
#include "contact/barrier.hpp"
#include "core/random.hpp"
#include "geometry/mesher.hpp"
#include "geometry/spheroid.hpp"

namespace corpuscle::packing {
namespace {

constexpr double um = 1e-6;

geometry::TriangleMesh disc() {
    geometry::Spheroid shape(3 * um, 1 * um);
    shape.prepare("");
    return geometry::meshSurface(shape, 0.8 * um);
}

std::shared_ptr<contact::Barrier> barrier() {
    auto law = std::make_shared<contact::Barrier>();
    law->thickness = 0.1 * um, law->length = 0.6 * um, law->strength = 1e-6;
    return law;
}

// Two discs with axes in general directions, one of them near -z, a fixed disc and a wall, all in contact; the second
// disc touches the first through the periodic boundary as well.
struct Meeting {
    std::vector<Pose> poses{{0, Vec3(0, 0, 0), Vec3(0.3, -0.2, 0.9).normalized()},
                            {0, Vec3(5.6 * um, 0.4 * um, 0.6 * um), Vec3(0.5, 0.1, -0.8).normalized()}};
    Crowd crowd;

    explicit Meeting(bool mayTurn = true) : crowd(makeCrowd(mayTurn)) { crowd.populate(poses); }

    static Crowd makeCrowd(bool mayTurn) {
        geometry::TriangleMesh fixed = disc();
        fixed.translate(Vec3(0, 0, 3 * um));
        const particles::Box box{Vec3(-5.35, -5, -2.1) * um, Vec3(5.35, 5, 20) * um, {true, true, false}};
        return {{{disc(), mayTurn}}, {fixed}, boundary::PlaneWalls().place(box), box.periodicity(), barrier()};
    }
    double energyAt(const Eigen::VectorXd& q) {
        crowd.evaluate(crowd.nodes(crowd.moved(poses, q), 1));
        return crowd.energy();
    }
};

Eigen::VectorXd unit(Eigen::Index size, Eigen::Index at) { return Eigen::VectorXd::Unit(size, at); }

TEST(Crowd, hasTheGradientOfItsEnergy) {
    Meeting meeting;
    meeting.crowd.evaluate(meeting.crowd.nodes(meeting.poses, 1));
    ASSERT_GT(meeting.crowd.contacts(), 20u);
    const Eigen::VectorXd g = meeting.crowd.gradient(meeting.poses);
    const double h = 1e-5 * um;
    for (Eigen::Index i = 0; i < g.size(); ++i) {
        const double difference =
            (meeting.energyAt(h * unit(g.size(), i)) - meeting.energyAt(-h * unit(g.size(), i))) / (2 * h);
        EXPECT_NEAR(g[i], difference, 1e-5 * g.cwiseAbs().maxCoeff()) << i;
    }
}

// The springs of contact leave out that normals and nearest points turn; this softens the energy, whose second
// difference is smaller than the stiffness of the springs.
TEST(Crowd, hasAStiffnessLikeTheSecondDifference) {
    Meeting meeting;
    meeting.crowd.evaluate(meeting.crowd.nodes(meeting.poses, 1));
    const Eigen::MatrixXd lower = meeting.crowd.stiffness(meeting.poses);
    const Eigen::MatrixXd k = lower.selfadjointView<Eigen::Lower>();
    EXPECT_GE(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(k).eigenvalues().minCoeff(), -1e-12 * k.norm());
    const auto gradientAt = [&](const Eigen::VectorXd& q) {
        const std::vector<Pose> there = meeting.crowd.moved(meeting.poses, q);
        meeting.crowd.evaluate(meeting.crowd.nodes(there, 1));
        return meeting.crowd.gradient(there);
    };
    const double h = 1e-4 * um;
    Random random(2);
    for (int n = 0; n < 10; ++n) {
        const Eigen::VectorXd q = Eigen::VectorXd::NullaryExpr(k.rows(), [&] { return random.between(-1, 1); });
        const Eigen::VectorXd change = (gradientAt(h * q) - gradientAt(-h * q)) / (2 * h);
        EXPECT_GT(q.dot(k * q), q.dot(change)) << n;
        EXPECT_LT(q.dot(k * q), 1.6 * q.dot(change)) << n;
    }
}

TEST(Crowd, doesNotTurnWhatIsAligned) {
    Meeting meeting(false);
    meeting.crowd.evaluate(meeting.crowd.nodes(meeting.poses, 1));
    const Eigen::VectorXd g = meeting.crowd.gradient(meeting.poses);
    EXPECT_GT(g.segment<3>(0).norm(), 0);
    EXPECT_EQ(g.segment<2>(3).norm(), 0);
    EXPECT_EQ(g.segment<2>(8).norm(), 0);
    const Eigen::MatrixXd k = meeting.crowd.stiffness(meeting.poses);
    EXPECT_EQ(k.row(3).norm() + k.col(3).norm() + k.row(9).norm() + k.col(9).norm(), 0);
}

// Without walls and fixed surfaces, the forces on all surfaces sum to zero.
TEST(Crowd, pushesEquallyBothWays) {
    const Periodicity period = Periodicity::centred(Vec3(10.7, 0, 0) * um);
    Crowd crowd({{disc(), true}}, {}, {}, period, barrier());
    const std::vector<Pose> poses = Meeting().poses;
    crowd.populate(poses);
    crowd.evaluate(crowd.nodes(poses, 1));
    const Eigen::VectorXd g = crowd.gradient(poses);
    ASSERT_GT(g.segment<3>(0).norm(), 0);
    EXPECT_NEAR((g.segment<3>(0) + g.segment<3>(5)).norm(), 0, 1e-9 * g.segment<3>(0).norm());
}

// A disc that would move through a fixed one, and one that would move through a wall.
TEST(Crowd, knowsHowFarTheWayIsFree) {
    const particles::Box box{Vec3(-20, -20, -6) * um, Vec3(20, 20, 20) * um, {true, true, false}};
    geometry::TriangleMesh fixed = disc();
    Crowd crowd({{disc(), true}}, {fixed}, boundary::PlaneWalls().place(box), box.periodicity(), barrier());
    const std::vector<Pose> poses{{0, Vec3(0, 0, 5) * um, Vec3::UnitZ()}};
    crowd.populate(poses);
    const std::vector<Vec3> x = crowd.nodes(poses, 1);
    crowd.evaluate(x);
    const auto freeAlong = [&](const Vec3& d) {
        std::vector<Vec3> u(x.size(), Vec3::Zero());
        std::fill(u.begin(), u.end() - static_cast<std::ptrdiff_t>(fixed.nodes.size()), d);
        return crowd.freeTravel(u, 0.1);
    };
    EXPECT_EQ(freeAlong(Vec3(10, 0, 0) * um), 1);
    // The poles are 3 um apart; facets make the gap a little larger, the thickness makes it smaller; a tenth of the gap
    // is kept.
    const double free = freeAlong(Vec3(0, 0, -6) * um) * 6;
    EXPECT_NEAR(free, 0.9 * 2.9, 0.1);
    crowd.evaluate(crowd.nodes({{0, Vec3(8, 8, 0) * um, Vec3::UnitZ()}}, 1));
    const double down = freeAlong(Vec3(0, 0, -10) * um) * 10;  // 5 um to the wall, checked at eight points
    EXPECT_LE(down, 4.9);
    EXPECT_GT(down, 3);
}

}  // namespace
}  // namespace corpuscle::packing
