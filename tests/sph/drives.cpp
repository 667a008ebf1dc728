// Drives: their factors of time, and what flows make of them.
#include <gtest/gtest.h>
#include <stdlib.h>

#include <filesystem>
#include <fstream>

#include "core/error.hpp"
#include "sph/flow.hpp"
#include "sph/samples.hpp"

using namespace corpuscle;
using namespace corpuscle::sph;
using namespace corpuscle::sph::testing;

namespace {

constexpr double pi = std::numbers::pi;

// A table in a folder of its own, read by the drive.
class TableOfFactors : public ::testing::Test {
  protected:
    void SetUp() override {
        std::string name = (std::filesystem::temp_directory_path() / "driveXXXXXX").string();
        ASSERT_NE(mkdtemp(name.data()), nullptr);
        folder_ = name;
    }
    void TearDown() override { std::filesystem::remove_all(folder_); }
    std::shared_ptr<const Drive> read(const std::string& rows, bool repeat = false) const {
        std::ofstream(folder_ / "drive.csv") << "# a comment\ntime_s,factor\n" << rows;
        auto drive =
            choose<Drive>(std::string("{type: table, file: drive.csv, repeat: ") + (repeat ? "true}" : "false}"));
        drive->prepare(folder_);
        return drive;
    }
    std::string fault(const std::string& rows, bool repeat = false) const {
        try {
            read(rows, repeat);
        } catch (const Failure& failure) {
            return failure.what();
        }
        return "none";
    }
    std::filesystem::path folder_;
};

FlowState resolved(const std::string& text) {
    Problems problems;
    FlowState flow = choose<Flow>(text)->resolve({.box = {Vec3(-2, -1, -1), Vec3(2, 1, 1), {true, true, false}},
                                                  .viscosity = 0.3,
                                                  .density = 1.5,
                                                  .leastViscosity = 0.3},
                                                 {"constant/flow.yaml", 0, 0}, problems);
    problems.throwIfAny();
    return flow;
}

}  // namespace

TEST(Drive, sineHasItsMeanAmplitudeAndPhase) {
    const auto drive = choose<Drive>("{type: sine, frequency: 4 Hz, mean: 2, amplitude: 0.5, phase: 0.25}");
    EXPECT_NEAR(drive->factor(0), 2.5, 1e-12);
    EXPECT_NEAR(drive->factor(1.0 / 16), 2, 1e-12);
    EXPECT_NEAR(drive->factor(1.0 / 8), 1.5, 1e-12);
    EXPECT_NEAR(drive->factor(10.25), 2.5, 1e-11);
    EXPECT_EQ(drive->largest(), 2.5);
    // At its fastest it changes by 0.5 omega in unit time.
    EXPECT_NEAR(drive->changesIn(), 2.5 / (0.5 * 8 * pi), 1e-12);
    EXPECT_FALSE(drive->isSteady());
    EXPECT_TRUE(choose<Drive>("steady")->isSteady());
}

TEST_F(TableOfFactors, areInterpolatedLinearly) {
    const auto drive = read("0,1\n2,3\n3,-5\n");
    EXPECT_EQ(drive->factor(0), 1);
    EXPECT_EQ(drive->factor(0.5), 1.5);
    EXPECT_EQ(drive->factor(2), 3);
    EXPECT_EQ(drive->factor(2.5), -1);
    EXPECT_EQ(drive->factor(3), -5);
    EXPECT_EQ(drive->factor(100), -5);
    EXPECT_EQ(drive->largest(), 5);
    EXPECT_EQ(drive->changesIn(), 5.0 / 8);
}

TEST_F(TableOfFactors, repeat) {
    const auto drive = read("0,1\n2,3\n4,1\n", true);
    for (const double t : {0.0, 4.0, 40.0}) EXPECT_NEAR(drive->factor(t), 1, 1e-12) << t;
    for (const double t : {1.0, 3.0, 5.0, 43.0}) EXPECT_NEAR(drive->factor(t), 2, 1e-12) << t;
}

TEST_F(TableOfFactors, thatMakeNoSenseAreRefused) {
    EXPECT_NE(fault("0,1\n").find("found 1 rows"), std::string::npos) << fault("0,1\n");
    EXPECT_NE(fault("1,1\n2,2\n").find("has to begin at 0"), std::string::npos);
    EXPECT_NE(fault("0,1\n2,2\n2,3\n").find("found 2 after 2"), std::string::npos);
    EXPECT_NE(fault("0,0\n2,0\n").find("other than 0"), std::string::npos);
    EXPECT_NE(fault("0,1\n2,2\n", true).find("have to be equal"), std::string::npos);
    EXPECT_NE(fault("0,one\n2,2\n").find("drive.csv:3"), std::string::npos) << fault("0,one\n2,2\n");
    EXPECT_EQ(fault("0,1\n2,2\n"), "none");
}

// Speed and rate are the largest at any time; velocities are those at t = 0.
TEST(Drive, scalesAFlow) {
    const std::string drive =
        ", drive: {type: sine, frequency: 1 Hz, mean: 1, amplitude: 2, phase: 0.08333333333333333}}";
    const FlowState steady = resolved("{type: shear, shearRate: 5 1/s}"),
                    moving = resolved("{type: shear, shearRate: 5 1/s" + drive);
    EXPECT_NEAR(moving.factor, 2, 1e-12);
    EXPECT_NEAR(moving.speed, 3 * steady.speed, 1e-12);
    EXPECT_NEAR(moving.rate, 3 * steady.rate, 1e-12);
    EXPECT_EQ(moving.shearRate, steady.shearRate);
    const Vec3 x(0.3, 0.2, 0.7);
    EXPECT_LT((moving.undisturbed(x) - 2 * steady.undisturbed(x)).norm(), 1e-12);
    for (std::size_t w = 0; w < 2; ++w)
        EXPECT_LT((moving.walls[w].velocity - 2 * steady.walls[w].velocity).norm(), 1e-12);
    const FlowState pushed = resolved("{type: poiseuille, bodyForce: 7 m/s^2" + drive);
    EXPECT_EQ(pushed.bodyForce, Vec3(7, 0, 0));
    EXPECT_NEAR(pushed.largestForce(), 21, 1e-12);
}

// The body force that belongs to a flow rate between planes: Q = F h^3 b/(12 nu).
TEST(Drive, aFlowRateBecomesABodyForce) {
    const FlowState flow = resolved("{type: poiseuille, flowRate: 0.4 m^3/s}");
    const double nu = 0.3 / 1.5, h = 2, b = 2;
    EXPECT_NEAR(flow.bodyForce[0], 0.4 * 12 * nu / (h * h * h * b), 1e-12);
    EXPECT_EQ(flow.flowRate, 0.4);
    EXPECT_NEAR(resolved("{type: poiseuille, flowRate: 240 L/min}").flowRate, 0.004, 1e-15);
}
