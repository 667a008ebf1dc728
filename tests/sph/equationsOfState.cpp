#include "sph/equationOfState.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "sph/samples.hpp"

using namespace corpuscle::sph;
using corpuscle::sph::testing::choose;

namespace {
const double rho0 = 1050, c0 = 0.3;
const char* const names[] = {"tait", "{type: tait, gamma: 3}", "linear"};
}  // namespace

TEST(EquationsOfState, valuesOfTheFormulas) {
    EXPECT_NEAR(choose<EquationOfState>("tait")->pressure(1060.5, rho0, c0),
                rho0 * c0 * c0 / 7 * (std::pow(1.01, 7) - 1), 1e-12 * rho0);
    EXPECT_NEAR(choose<EquationOfState>("{type: tait, gamma: 3}")->pressure(1060.5, rho0, c0),
                rho0 * c0 * c0 / 3 * (std::pow(1.01, 3) - 1), 1e-12 * rho0);
    EXPECT_NEAR(choose<EquationOfState>("linear")->pressure(1060.5, rho0, c0), c0 * c0 * 10.5, 1e-12 * rho0);
}

TEST(EquationsOfState, pressureVanishesAtRestAndTheSlopeIsTheSoundSpeed) {
    for (const char* name : names) {
        const auto e = choose<EquationOfState>(name);
        EXPECT_EQ(e->pressure(rho0, rho0, c0), 0) << name;
        const double step = 1e-3;
        EXPECT_NEAR((e->pressure(rho0 + step, rho0, c0) - e->pressure(rho0 - step, rho0, c0)) / (2 * step), c0 * c0,
                    1e-7 * c0 * c0)
            << name;
    }
}

TEST(EquationsOfState, densityIsTheInverseOfPressure) {
    for (const char* name : names) {
        const auto e = choose<EquationOfState>(name);
        for (const double rho : {0.97, 0.999, 1.0, 1.004, 1.05})
            EXPECT_NEAR(e->density(e->pressure(rho * rho0, rho0, c0), rho0, c0), rho * rho0, 1e-9);
    }
}

TEST(EquationsOfState, specificPressureIsPressureOverDensitySquared) {
    std::vector<double> rho, out(37);
    for (int i = 0; i < 37; ++i) rho.push_back(rho0 * (0.98 + 0.001 * i));
    for (const char* name : names) {
        const auto e = choose<EquationOfState>(name);
        e->specificPressure(rho.data(), out.data(), 37, rho0, c0);
        for (std::size_t i = 0; i < 37; ++i)
            EXPECT_NEAR(out[i] * rho[i] * rho[i], e->pressure(rho[i], rho0, c0), 1e-12 * rho0 * c0 * c0) << name;
    }
}
