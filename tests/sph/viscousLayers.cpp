// The discrete shear flow along a plane interface of two fluids. References: the flow itself, and the same model in
// another program, benchmarks/placement/plane.py.
#include "sph/viscousLayers.hpp"

#include <gtest/gtest.h>

#include "sph/samples.hpp"

using namespace corpuscle;
using namespace corpuscle::sph;

namespace {

ViscousLayers layers() { return {*sph::testing::model("wendlandC2").kernel, 2.4}; }

double meanFilm(const ViscousLayers& all, double ratio, double kappa) {
    double mean = 0;
    for (int k = 0; k < ViscousLayers::places; ++k) mean += all.film(ViscousLayers::place(k), ratio, kappa);
    return mean / ViscousLayers::places;
}

}  // namespace

TEST(ViscousLayers, straightLinesAreFoundInOneFluid) {
    const ViscousLayers all = layers();
    const ViscousLayers::Vector line = ViscousLayers::shear(0.3, 1), none = 0 * line;
    EXPECT_LT((all.velocities(none, none, line) - line).lpNorm<Eigen::Infinity>(), 1e-10);
    EXPECT_LT(all.excess(0.3, 1, 0.3).lpNorm<Eigen::Infinity>(), 1e-15);
}

// Away from the interface the viscosities are those of the two fluids.
TEST(ViscousLayers, excessIsThatOfTheFluidsAwayFromTheInterface) {
    const ViscousLayers::Vector c = layers().excess(0.3, 5, 0.3);
    EXPECT_NEAR(c[ViscousLayers::half - 5], 4, 1e-12);
    EXPECT_NEAR(c[ViscousLayers::half + 5], 0, 1e-12);
    for (int i = 1; i < ViscousLayers::count; ++i) EXPECT_LE(c[i], c[i - 1] + 1e-12);
}

TEST(ViscousLayers, filmCoefficientMakesTheMeanFilmNone) {
    const ViscousLayers all = layers();
    const struct {
        double ratio, kappa;  // plane.py -mean laminate -weights kink -R 2
    } references[] = {{2, 0.2888}, {5, 0.2899}, {20, 0.2822}};
    for (const auto& [ratio, kappa] : references) {
        const double found = all.filmCoefficient(ratio);
        EXPECT_NEAR(found, kappa, 2e-4) << ratio;
        EXPECT_NEAR(meanFilm(all, ratio, found), 0, 1e-8) << ratio;
        EXPECT_GT(std::abs(meanFilm(all, ratio, 0)), 1e-2) << ratio;  // without a film coefficient there is a mean film
    }
}
