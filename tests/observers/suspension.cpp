// The stress that cells add: the contribution of the membranes against the change of their energy in a small strain,
// that of the cells' inside against the closed form of a linear flow.
#include <gtest/gtest.h>

#include <numbers>

#include "geometry/spheroid.hpp"
#include "observers/sampleScene.hpp"

namespace corpuscle::observers::testing {
namespace {

// Columns of suspension.csv and of <cell>.csv.
enum Whole { haematocrit, membranes, interiors, contact, N1, N2, relativeViscosity };
enum Each { place = 1, velocity = 4, axis = 7, semiaxes = 10, shear = 13, ofN1, ofN2 };

const geometry::TriangleMesh& spheroid() {
    static const geometry::TriangleMesh mesh = geometry::meshSurface(geometry::Spheroid(3 * um, 2 * um), 0.8 * um);
    return mesh;
}

// Nodes at x = (1 + G) y, y: positions in the mesh, moving with the velocity rate G x.
Scene strained(const Mat3& G, double rate, double viscosityRatio) {
    Scene scene = sampleScene(
        {.cells = {{"cell", Vec3(1, 2, -1) * um}}, .surface = &spheroid(), .viscosityRatio = viscosityRatio});
    for (coupling::Cell& cell : scene.cells)
        for (std::size_t n = 0; n < cell.membrane.position.size(); ++n) {
            Vec3& x = cell.membrane.position[n];
            x += G * x;
            cell.membrane.velocity[n] = rate * G * x;
        }
    return scene;
}

std::vector<Row> rowsOf(const Scene& scene) {
    const auto observer = choose<Observer>("{type: suspension, every: 1 steps}");
    return observer.model->begin(scene)->observe(scene, Time{});
}

double energyOf(const Scene& scene) { return scene.cells[0].membrane.energy(); }

Mat3 unit(int a, int b) {
    Mat3 m = Mat3::Zero();
    m(a, b) = 1;
    return m;
}

}  // namespace

TEST(Suspension, membranesStressIsTheChangeOfTheirEnergy) {
    Mat3 G;
    G << 0.05, 0.02, 0.11, 0, -0.03, 0.04, 0.03, 0, 0.02;
    const std::vector<Row> rows = rowsOf(strained(G, 0, 1));
    // Under a further strain E of the strained cell: x <- (1 + E)(1 + G) x.
    const auto change = [&](const Mat3& E) {
        constexpr double small = 1e-4;
        const auto at = [&](double e) { return energyOf(strained(G + e * E * (Mat3::Identity() + G), 0, 1)); };
        return (at(small) - at(-small)) / (2 * small);
    };
    const double xz = 0.5 * (change(unit(0, 2)) + change(unit(2, 0)));
    const double xx = change(unit(0, 0)), yy = change(unit(1, 1)), zz = change(unit(2, 2));
    const double scale = std::abs(xx) + std::abs(yy) + std::abs(zz) + std::abs(xz);
    EXPECT_NEAR(rows[1].values[shear], xz, 1e-6 * scale);
    EXPECT_NEAR(rows[1].values[ofN1], xx - zz, 1e-6 * scale);
    EXPECT_NEAR(rows[1].values[ofN2], zz - yy, 1e-6 * scale);
    const double volume = 16 * 12 * 12 * um * um * um;
    EXPECT_NEAR(rows[0].values[membranes], xz / volume, 1e-6 * scale / volume);
    EXPECT_NEAR(rows[0].values[N1], (xx - zz) / volume, 1e-6 * scale / volume);
    EXPECT_GT(std::abs(xz), 0.1 * scale);  // the shear stress does not vanish
    EXPECT_EQ(rows[0].values[interiors], 0);
    EXPECT_EQ(rows[0].values[contact], 0);
}

TEST(Suspension, insidesStressIsThatOfALinearFlow) {
    Mat3 G;
    G << 0.02, 0.01, 0.1, 0, -0.05, 0.04, 0.03, 0, 0.03;
    constexpr double rate = 1000, ratio = 5;
    const Scene scene = strained(G, rate, ratio);
    const Mat3 gradient = rate * G;  // of the velocity: u = rate G x
    const std::vector<Row> rows = rowsOf(scene);
    const double V = scene.cells[0].membrane.volume(), mu = scene.model().viscosity, box = scene.fluidVolume;
    EXPECT_NEAR(rows[0].values[haematocrit], V / box, 1e-12);
    EXPECT_NEAR(rows[0].values[interiors] / (mu * (ratio - 1) * (gradient(0, 2) + gradient(2, 0)) * V / box), 1, 1e-9);
    const double sum = rows[0].values[membranes] + rows[0].values[interiors];
    EXPECT_NEAR(rows[0].values[relativeViscosity], 1 + sum / (mu * scene.flow.shearRate), 1e-9);
}

TEST(Suspension, givesTheAxisAndSemiaxesOfASpheroid) {
    const std::vector<double> row = rowsOf(strained(Mat3::Zero(), 0, 1))[1].values;
    EXPECT_EQ(row[0], 1);
    EXPECT_NEAR(row[place], 1 * um, 0.01 * um);
    EXPECT_NEAR(row[place + 1], 2 * um, 0.01 * um);
    EXPECT_NEAR(row[axis + 2], 1, 1e-3);
    EXPECT_NEAR(row[semiaxes], 3 * um, 0.06 * um);
    EXPECT_NEAR(row[semiaxes + 1], 3 * um, 0.06 * um);
    EXPECT_NEAR(row[semiaxes + 2], 2 * um, 0.06 * um);
}

}  // namespace corpuscle::observers::testing
