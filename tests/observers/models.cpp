// Each observer on small scenes, on any number of ranks.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/kuchelFackerell.hpp"
#include "geometry/spheroid.hpp"
#include "observers/sampleScene.hpp"
#include "observers/summary.hpp"

namespace corpuscle::observers::testing {
namespace {

constexpr double pi = std::numbers::pi;

const geometry::TriangleMesh& redCell() {
    static const geometry::TriangleMesh mesh =
        geometry::meshSurface(geometry::KuchelFackerell(8 * um, 2.12 * um, 1 * um), 0.6 * um);
    return mesh;
}
const geometry::TriangleMesh& sphere() {
    static const geometry::TriangleMesh mesh = geometry::meshSurface(geometry::Sphere(3 * um), 0.8 * um);
    return mesh;
}

Vec3 turned(const Vec3& x, double angle) {  // rotated about y, in the sense of the flow
    return {std::cos(angle) * x[0] + std::sin(angle) * x[2], x[1], -std::sin(angle) * x[0] + std::cos(angle) * x[2]};
}

TEST(Shape, RigidTumbleTurnsTheMaterialAndNotTheMembrane) {
    Scene scene = sampleScene({.cells = {{"rbc", Vec3::Zero()}}, .surface = &redCell()});
    couple(scene);
    const auto shape = begin("{type: shape, every: 0.1 strain}", scene);
    const auto rest = shape->observe(scene, {});
    const double D = value(*shape, rest, "D12_extent"), phase = value(*shape, rest, "treadPhase_rad");
    EXPECT_NEAR(D, 0.581, 0.015);
    EXPECT_NEAR(phase, 0, 0.2);  // the node nearest to the axis is within half an edge of it
    std::vector<Row> rows;
    for (int n = 1; n <= 25; ++n) {
        deform(scene, 0, [&](const Vec3& x) { return turned(x, 0.3 * n); });
        rows = shape->observe(scene, {});
        EXPECT_NEAR(value(*shape, rows, "angleTurned_rad"), 0.3 * n, 1e-9);
        EXPECT_NEAR(value(*shape, rows, "treadPhase_rad"), phase, 1e-9);
        EXPECT_NEAR(value(*shape, rows, "D12_extent"), D, 1e-9);
    }
    EXPECT_NEAR(value(*shape, rows, "inclination_rad"), value(*shape, rest, "inclination_rad") - 7.5 + 2 * pi, 1e-8);
}

// Material moves round an ellipse (1.2 a, a/1.2) of constant shape 1.8 times; after each half turn the marker is at the
// same place of the ellipse or opposite.
TEST(Shape, TankTreadingTurnsTheMembraneAndNotTheShape) {
    Scene scene = sampleScene({.cells = {{"capsule", Vec3::Zero()}}, .surface = &sphere()});
    couple(scene);
    const auto shape = begin("{type: shape, every: 0.1 strain}", scene);
    const auto stretched = [&](double angle) {
        deform(scene, 0,
               [&](const Vec3& x) { return turned(turned(x, angle).cwiseProduct(Vec3(1.2, 1, 1 / 1.2)), -0.4); });
        return shape->observe(scene, {});
    };
    std::vector<Row> rows = stretched(0);
    const double start = value(*shape, rows, "treadPhase_rad");
    const double D = (1.2 - 1 / 1.2) / (1.2 + 1 / 1.2);
    for (int n = 1; n <= 36; ++n) {
        rows = stretched(0.1 * pi * n);
        EXPECT_NEAR(value(*shape, rows, "inclination_rad"), 0.4, 0.02);
        EXPECT_NEAR(value(*shape, rows, "D12_inertia"), D, 0.01);
        if (n % 10 == 0) {
            EXPECT_NEAR(value(*shape, rows, "treadPhase_rad") - start, 0.1 * pi * n, 0.03);
        }
    }
    EXPECT_NEAR(value(*shape, rows, "angleTurned_rad"), 3.6 * pi - 0.4,
                0.15);  // the ellipse's angle differs from the parametric one
}

TEST(Shape, AnglesGoOnAfterARestart) {
    Scene scene = sampleScene({.cells = {{"rbc", Vec3::Zero()}}, .surface = &redCell()});
    couple(scene);
    const auto before = begin("{type: shape, every: 0.1 strain}", scene);
    for (int n = 0; n <= 20; ++n) {
        deform(scene, 0, [&](const Vec3& x) { return turned(x, 0.4 * n); });
        before->observe(scene, {});
    }
    const auto after = begin("{type: shape, every: 0.1 strain}", scene);
    after->restore(before->state());
    EXPECT_NEAR(value(*after, after->observe(scene, {}), "angleTurned_rad"), 8, 1e-9);
    EXPECT_THROW(after->restore(std::vector<double>{1, 2, 3}), Failure);
}

TEST(Conservation, FluidWithoutCells) {
    Scene scene = sampleScene({});
    particles::ParticleStore& s = scene.store();
    for (std::size_t i = 0; i < s.size(); ++i) s.density[i] = s.z[i] > 0 ? 1010 : 1000;
    const auto observation = begin("{type: conservation, every: 10 steps}", scene);
    const auto rows = observation->observe(scene, {});
    ASSERT_EQ(rows.size(), 1u);
    EXPECT_EQ(observation->tables()[0].columns.size(), 8u);  // no columns of cells
    EXPECT_NEAR(value(*observation, rows, "density_mean"), 1.005, 1e-13);
    EXPECT_EQ(value(*observation, rows, "density_min"), 1);
    EXPECT_EQ(value(*observation, rows, "density_max"), 1.01);
    EXPECT_EQ(value(*observation, rows, "particles"), 16 * 12 * 12);
    // sum over z = +-0.5 .. +-5.5 um of z^2 = 143 um^2 per column of 12.
    const double energy = 0.5 * 1e-15 * 1e6 * 16 * 12 * 143e-12;
    EXPECT_NEAR(value(*observation, rows, "kineticEnergy_J"), energy, 1e-12 * energy);
    EXPECT_NEAR(value(*observation, rows, "momentum_x_Ns"), 0, 1e-27);
    for (std::size_t i = 0; i < s.size(); ++i) s.w[i] = 2e-3;
    EXPECT_NEAR(value(*observation, observation->observe(scene, {}), "momentum_z_Ns"), 2304 * 1e-15 * 2e-3, 1e-24);
}

TEST(Conservation, CellsAcrossAPeriodicFace) {
    Scene scene =
        sampleScene({.cells = {{"a", Vec3(8 * um, 0, 0)}, {"b", Vec3(0.3 * um, 0, 0)}}, .surface = &sphere()});
    // Cell a lies across the face, so fluid inside it is at both ends of the box.
    couple(scene);
    const auto observation = begin("{type: conservation, every: 10 steps}", scene);
    auto rows = observation->observe(scene, {});
    EXPECT_EQ(value(*observation, rows, "changedSide"), 0);
    EXPECT_EQ(value(*observation, rows, "guardMoves"), 0);
    EXPECT_NEAR(value(*observation, rows, "area_m2", 1), sphere().area(), 1e-20);
    EXPECT_NEAR(value(*observation, rows, "volume_m3", 2), sphere().volume(), 1e-27);
    EXPECT_NEAR(value(*observation, rows, "volumeChange", 1), 0, 1e-12);
    EXPECT_NEAR(value(*observation, rows, "membraneEnergy_J"), 0, 1e-30);

    particles::ParticleStore& s = scene.store();
    long inside = 0, left = 0;
    for (std::size_t i = 0; i < s.size(); ++i)
        if (s.side[i] == 1) s.side[i] = 0, ++inside, left += s.x[i] > 0;
    inside = Communicator().sum(inside), left = Communicator().sum(left);
    // Lattice points about the centre: 88 with r^2 <= 6.75, and 48 more with 8.75, so near the surface at r = 3 that
    // flat facets may exclude some of them.
    EXPECT_GE(inside, 88);
    EXPECT_LE(inside, 136);
    EXPECT_NEAR(static_cast<double>(left), 0.5 * static_cast<double>(inside), 8);
    scene.movedBack = 3;
    rows = observation->observe(scene, {});
    EXPECT_EQ(value(*observation, rows, "changedSide"), static_cast<double>(inside));
    EXPECT_EQ(value(*observation, rows, "guardMoves"), 3.0 * Communicator().size());

    deform(scene, 1, [](const Vec3& x) { return Vec3(0.3 * um + 1.1 * (x[0] - 0.3 * um), 1.1 * x[1], 1.1 * x[2]); });
    rows = observation->observe(scene, {});
    EXPECT_NEAR(value(*observation, rows, "areaChange", 2), 0.21, 1e-9);
    EXPECT_NEAR(value(*observation, rows, "volumeChange", 2), 0.331, 1e-9);
    EXPECT_NEAR(value(*observation, rows, "areaChange", 1), 0, 1e-12);
    EXPECT_NEAR(value(*observation, rows, "areaChange"), 0.21, 1e-9) << "the greatest of both";
    EXPECT_NEAR(value(*observation, rows, "volumeChange"), 0.331, 1e-9);
    EXPECT_EQ(value(*observation, rows, "cell", 2), 2);
    double energy = 0;  // k/2 (0.1 l0)^2 of each bond
    for (const membrane::Bond& bond : networkOf(scene, 1).allBonds())
        energy += 0.5 * 5e-4 * 0.01 * bond.rest * bond.rest;
    EXPECT_NEAR(value(*observation, rows, "membraneEnergy_J"), energy, 1e-9 * energy);
}

// Energies and momentum of the state against the work and impulse of the forces as given in the budget, from a start at
// which the budget is not zero.
TEST(Conservation, BudgetOfWorkAndState) {
    using sph::Budget;
    Scene scene = sampleScene({.walls = true, .cells = {{"a", Vec3::Zero()}}, .surface = &sphere()});
    couple(scene);
    EXPECT_EQ(begin("{type: conservation, every: 10 steps}", scene)->tables().size(), 2u) << "no budget is kept";
    scene.budget.kept = true;
    const double ranks = Communicator().size();
    std::fill(scene.budget.total.begin(), scene.budget.total.end(), 7e-15);
    const auto observation = begin("{type: conservation, every: 10 steps}", scene);
    const auto now = [&](const std::unique_ptr<Observation>& o, const std::string& header) {
        return value(*o, o->observe(scene, {}), header, 2);
    };
    for (const char* name :
         {"workOfWalls_J", "dissipated_J", "stored_J", "compressed_J", "kineticEnergy_J", "residual_J", "residualShare",
          "momentum_y_Ns", "momentumDrift_y_Ns", "massChange", "volumeChange"})
        EXPECT_EQ(now(observation, name), 0) << name;

    particles::ParticleStore& s = scene.store();
    double moving = 0, compression = 0;
    for (std::size_t i = 0; i < s.size(); ++i) {
        const double before =
            rho0 * dx * dx * dx * scene.model().equationOfState->energy(s.density[i], rho0, scene.model().soundSpeed);
        if (!particles::isBoundary(s.kindOf(i))) s.v[i] += 2e-3, moving += s.mass[i];
        s.density[i] *= 1.001;
        compression +=
            s.mass[i] * scene.model().equationOfState->energy(s.density[i], rho0, scene.model().soundSpeed) - before;
    }
    moving = Communicator().sum(moving), compression = Communicator().sum(compression);
    EXPECT_NEAR(compression / (moving / rho0 * 0.5 * 1e-6 * rho0 * 0.01), 1.5, 0.5)
        << "p^2/2K of the fluid, and that of the walls";
    deform(scene, 0, [](const Vec3& x) { return Vec3(1.1 * x); });
    double elastic = 0;  // k/2 (0.1 l0)^2 of each bond
    for (const membrane::Bond& bond : networkOf(scene, 0).allBonds())
        elastic += 0.5 * 5e-4 * 0.01 * bond.rest * bond.rest;
    const double kinetic = 0.5 * moving * 4e-6, stored = kinetic + compression + elastic, walls = 3 * stored;
    const auto addTotal = [&](std::size_t entry, double sum) { scene.budget.total[entry] += sum / ranks; };
    addTotal(Budget::ofWalls, walls), addTotal(Budget::viscous, 1.9 * stored);
    addTotal(Budget::kinetic, kinetic + 0.06 * stored), addTotal(Budget::elastic, elastic + 0.03 * stored);
    addTotal(Budget::compression, compression + 0.01 * stored);
    addTotal(Budget::wall(0) + 1, 1e-3 * moving), addTotal(Budget::wall(1) + 1, 0.8e-3 * moving);
    const double close = 1e-9 * stored;
    EXPECT_NEAR(now(observation, "workOfWalls_J"), walls, close);
    EXPECT_NEAR(now(observation, "stored_J"), elastic, close);
    EXPECT_NEAR(now(observation, "kineticEnergy_J"), kinetic, close);
    EXPECT_NEAR(now(observation, "compressed_J"), compression, 1e-6 * stored);
    EXPECT_NEAR(now(observation, "residual_J"), 0.1 * stored, 1e-6 * stored);
    EXPECT_NEAR(now(observation, "residualOfInertia_J"), 0.06 * stored, close);
    EXPECT_NEAR(now(observation, "residualOfMembranes_J"), 0.03 * stored, close);
    EXPECT_NEAR(now(observation, "residualOfCompression_J"), 0.01 * stored, 1e-6 * stored);
    EXPECT_NEAR(now(observation, "residualShare"), 0.1 / 3, 1e-6);
    EXPECT_NEAR(now(observation, "momentum_y_Ns"), 2e-3 * moving, 1e-9 * moving);
    EXPECT_NEAR(now(observation, "momentumDrift_y_Ns"), 0.2e-3 * moving, 1e-9 * moving);
    EXPECT_NEAR(now(observation, "volumeChange"), 1 / 1.001 - 1, 1e-9);
    const auto summary = observation->summary(scene, {});
    EXPECT_NEAR(summary->figures["residualShare"].get<double>(), 0.1 / 3, 1e-6);
    EXPECT_NE(summary->lines[0].find("closes to 3.3 %"), std::string::npos) << summary->lines[0];

    // A new observation starts at zero; after a restart it continues from the original start.
    const auto restarted = begin("{type: conservation, every: 10 steps}", scene);
    EXPECT_EQ(now(restarted, "workOfWalls_J"), 0);
    restarted->restore(observation->state());
    EXPECT_EQ(now(restarted, "residual_J"), now(observation, "residual_J"));
}

TEST(Rupture, EventsHolesAndReleasedFluid) {
    Scene scene = sampleScene({.size = Vec3(20 * um, 12 * um, 12 * um),
                               .cells = {{"a", Vec3(-5 * um, 0, 0)}, {"b", Vec3(5 * um, 0, 0)}},
                               .surface = &sphere(),
                               .rupture = "{type: bondStretch, limit: 1.05}",
                               .margin = coupling::DualIdentity::margin(dx, 0.3 * dx)});
    couple(scene);
    if (Communicator().size() > 1) {
        EXPECT_TRUE(Communicator().anyTrue(!scene.cells.find(2)));
    }
    const auto observation = begin("{type: rupture, every: 10 steps}", scene);
    ASSERT_TRUE(observation->watchesSteps());
    const Time time{.t = 0.25, .step = 7, .shearRate = 2, .strained = 0.5};
    EXPECT_TRUE(observation->afterStep(scene, time).empty());
    auto rows = observation->observe(scene, time);
    EXPECT_TRUE(std::isnan(value(*observation, rows, "firstBreak_s", 1)));
    EXPECT_EQ(value(*observation, rows, "bondsBroken", 1), 0);
    EXPECT_EQ(value(*observation, rows, "released", 1), 0);
    EXPECT_EQ(observation->summary(scene, time)->lines.size(), 1u) << "no membrane broke";

    // A particle of b outside the intact cell counts as a numerical leak, not as a release.
    particles::ParticleStore& s = scene.store();
    const auto sideOf = [&](std::int64_t id, int side) {
        for (std::size_t i = 0; i < s.size(); ++i)
            if (s.id[i] == id) s.side[i] = side;
    };
    sideOf(0, 2);
    rows = observation->observe(scene, time);
    EXPECT_EQ(value(*observation, rows, "leaked", 1), 1);
    EXPECT_EQ(value(*observation, rows, "released", 1), 0);
    EXPECT_EQ(value(*observation, rows, "releasedVolume_m3", 1), 0);
    EXPECT_EQ(value(*observation, rows, "haemolysisIndex_percent", 1), 0);
    EXPECT_EQ(value(*observation, rows, "leaked", 4), 1);
    sideOf(0, 0);

    // One node of b pulled out by a tenth of the radius: its bonds break.
    const std::vector<Vec3> rest = networkOf(scene, 1).stressFree();
    const Vec3 pulled = rest[5];
    const Vec3 centre(5 * um, 0, 0);
    deform(scene, 1, [&](const Vec3& x) { return x == pulled ? Vec3(x + 0.13 * (x - centre)) : x; });
    scene.broken = scene.coupling->endStep(*scene.system, 0);
    const auto events = observation->afterStep(scene, time);
    scene.broken.clear();
    std::size_t expected = 0;
    for (const membrane::Bond& bond : networkOf(scene, 1).allBonds())
        expected += bond.node[0] == 5 || bond.node[1] == 5;
    ASSERT_EQ(events.size(), expected);
    for (const Row& event : events) {
        EXPECT_EQ(event.table, 2u);
        EXPECT_EQ(event.values[0], 2);
        EXPECT_TRUE(event.values[2] == 5 || event.values[3] == 5);
        EXPECT_GT(event.values[4], 1.05);
        const Vec3 middle(&event.values[5]), atRest(&event.values[8]), ends = rest[5];
        const auto other = static_cast<std::size_t>(event.values[2] + event.values[3] - 5);
        EXPECT_LT((atRest - 0.5 * (ends + rest[other])).norm(), 1e-18);
        EXPECT_LT((middle - atRest - 0.065 * (ends - centre)).norm(), 1e-12) << "half of what the node was pulled";
    }
    EXPECT_LT(events[0].values[1], events[1].values[1]);
    rows = observation->observe(scene, time);
    EXPECT_EQ(value(*observation, rows, "bondsBroken", 0), 0);
    EXPECT_EQ(value(*observation, rows, "bondsBroken", 1), static_cast<double>(expected));
    const double lost = value(*observation, rows, "trianglesLost", 1);
    EXPECT_EQ(lost, static_cast<double>(expected));  // all triangles of the node, as many as its bonds
    EXPECT_GT(value(*observation, rows, "holeArea_m2", 1), 0);
    EXPECT_NEAR(value(*observation, rows, "holeRestArea_m2", 1), value(*observation, rows, "holeArea_m2", 1),
                0.2 * value(*observation, rows, "holeArea_m2", 1));
    EXPECT_EQ(value(*observation, rows, "firstBreak_s", 1), 0.25);
    EXPECT_EQ(value(*observation, rows, "firstBreak_strain", 1), 0.5);
    const auto first = std::max_element(events.begin(), events.end(), [](const Row& a, const Row& b) {
                           return a.values[4] < b.values[4];
                       })->values;  // the most stretched
    EXPECT_EQ(value(*observation, rows, "firstBreak_bond", 1), first[1]);
    EXPECT_EQ(value(*observation, rows, "firstBreak_x_m", 1), first[5]);
    EXPECT_EQ(value(*observation, rows, "firstBreak_z0_m", 1), first[10]);
    EXPECT_TRUE(std::isnan(value(*observation, rows, "firstBreak_x0_m", 0)));
    EXPECT_EQ(value(*observation, rows, "holes", 1), 1);
    EXPECT_EQ(value(*observation, rows, "cell", 3), 2);
    EXPECT_EQ(value(*observation, rows, "hole", 3), 1);
    EXPECT_EQ(value(*observation, rows, "edges", 3), static_cast<double>(expected));
    EXPECT_EQ(value(*observation, rows, "area_m2", 3), value(*observation, rows, "holeArea_m2", 1));
    const double perimeter = value(*observation, rows, "perimeter_m", 3),
                 area = value(*observation, rows, "area_m2", 3);
    EXPECT_GT(perimeter * perimeter, 4 * pi * area) << "longer than the circle of the same area";
    EXPECT_LT(perimeter * perimeter, 1.3 * 4 * pi * area);
    EXPECT_NEAR(value(*observation, rows, "maxBondStrain", 1), 0, 1e-12);  // the other bonds are at rest
    // outside the fan of triangles that now closes the hole
    const double underTheCap = value(*observation, rows, "released", 1);
    EXPECT_LE(underTheCap, 6);

    // Three particles at a corner of the box are assigned to b.
    for (std::size_t i = 0; i < s.size(); ++i)
        if (s.side[i] == 0 && s.kindOf(i) == particles::Kind::fluid && s.id[i] < 3) s.side[i] = 2;
    rows = observation->observe(scene, time);
    EXPECT_EQ(value(*observation, rows, "released", 1), underTheCap + 3);
    EXPECT_NEAR(value(*observation, rows, "releasedVolume_m3", 1), (underTheCap + 3) * 1e-18, 1e-30);
    EXPECT_EQ(value(*observation, rows, "released", 0), 0);
    EXPECT_EQ(value(*observation, rows, "leaked", 1), 0) << "the cell is open";
    std::vector<double> inside(2, 0.0);
    for (std::size_t i = 0; i < s.size(); ++i)
        if (s.kindOf(i) == particles::Kind::fluid && s.side[i] > 0)
            inside[static_cast<std::size_t>(s.side[i]) - 1] += 1;
    inside = Communicator().sum(std::move(inside));
    const double released = underTheCap + 3;
    EXPECT_NEAR(value(*observation, rows, "haemolysisIndex_percent", 1), 100 * released / inside[1], 1e-9);
    EXPECT_NEAR(value(*observation, rows, "haemolysisIndex_percent", 4), 100 * released / (inside[0] + inside[1]),
                1e-9);
    EXPECT_EQ(value(*observation, rows, "cellsBroken", 4), 1);
    const auto summary = observation->summary(scene, time);
    EXPECT_EQ(summary->figures["cells"]["b"]["bondsBroken"], static_cast<double>(expected));
    EXPECT_EQ(summary->figures["firstBreak_strain"], 0.5);
    ASSERT_EQ(summary->lines.size(), 2u);
    EXPECT_NE(summary->lines[0].find("b: first break at strain 0.5"), std::string::npos) << summary->lines[0];
    EXPECT_NE(summary->lines[1].find("1 of 2 cells broke"), std::string::npos) << summary->lines[1];

    // A later break does not replace the first.
    scene.broken = {{2, {{0, 9, Vec3::Zero()}}}};
    observation->afterStep(scene, {.t = 0.5, .step = 8, .shearRate = 2, .strained = 1});
    scene.broken.clear();

    const auto after = begin("{type: rupture, every: 10 steps}", scene);
    after->restore(observation->state());
    EXPECT_EQ(value(*after, after->observe(scene, time), "firstBreak_s", 1), 0.25);
    EXPECT_EQ(value(*after, after->observe(scene, time), "firstBreak_z0_m", 1), first[10]);
}

// The linear profile between walls that move with it: sigma = mu gammadot at both, no pressure. A lattice at Hs = 3 dx
// gives the viscosity to about 1 %.
TEST(WallStress, CouetteFlow) {
    Scene scene = sampleScene({.walls = true});
    scene.forces->evaluate(*scene.system, 0);
    const auto observation = begin("{type: wallStress, every: 10 steps}", scene);
    const auto rows = observation->observe(scene, {});
    EXPECT_NEAR(value(*observation, rows, "shearStress_lower_Pa"), 1, 0.05);
    EXPECT_NEAR(value(*observation, rows, "shearStress_upper_Pa"), 1, 0.05);
    EXPECT_NEAR(value(*observation, rows, "effectiveViscosity"), 1, 0.05);
    EXPECT_NEAR(value(*observation, rows, "pressure_upper_Pa"), 0, 1e-6);

    // Fluid and walls compressed alike by 0.1 %: p = rho0 c0^2/7 ((1.001)^7 - 1) on both.
    for (double& density : scene.store().density) density = 1001;
    scene.forces->evaluate(*scene.system, 0);
    const auto pressed = observation->observe(scene, {});
    const double p = rho0 * 0.01 / 7 * (std::pow(1.001, 7) - 1);
    EXPECT_NEAR(value(*observation, pressed, "pressure_lower_Pa"), p, 0.05 * p);
    EXPECT_NEAR(value(*observation, pressed, "pressure_upper_Pa"), p, 0.05 * p);
}

TEST(Profile, LinearVelocity) {
    Scene scene = sampleScene({.walls = true});
    particles::ParticleStore& s = scene.store();
    for (std::size_t i = 0; i < s.size(); ++i)
        if (s.z[i] > 5 * um) s.density[i] = 1020;
    const auto observation = begin("{type: profile, every: 10 steps, axis: z, bins: 6}", scene);
    const auto rows = observation->observe(scene, {});
    ASSERT_EQ(rows.size(), 6u);
    for (int b = 0; b < 6; ++b) {
        const double z = (-5 + 2 * b) * um;
        EXPECT_NEAR(rows[b].values[0], z, 1e-18);
        EXPECT_NEAR(rows[b].values[1], 1000 * z, 1e-15);
        EXPECT_EQ(rows[b].values[2], 0);
        EXPECT_NEAR(rows[b].values[4], b < 5 ? 1000 : 1010, 1e-9);
        EXPECT_EQ(rows[b].values[5], 16 * 12 * 2);  // walls are not counted
    }
    const auto fine = begin("{type: profile, every: 10 steps, axis: x, bins: 64}", scene);
    const auto slabs = fine->observe(scene, {});
    EXPECT_TRUE(std::isnan(slabs[0].values[1]));  // no lattice plane in the first quarter spacing
    EXPECT_EQ(slabs[0].values[5], 0);
    EXPECT_EQ(slabs[0].values.size(), 6) << "nothing of cells where there are none";
}

// The haematocrit is by volume: particles inside are made twice as dense, so that they have half the volume.
TEST(Profile, HaematocritOfSlabs) {
    Scene scene = sampleScene({.walls = true, .cells = {{"a", Vec3::Zero()}}, .surface = &sphere()});
    particles::ParticleStore& s = scene.store();
    for (std::size_t i = 0; i < s.size(); ++i) {
        const bool isInside = s.z[i] > 2 * um && s.x[i] > 0;
        s.side[i] = isInside ? 1 : 0;
        if (isInside) s.density[i] *= 2;
    }
    const auto rows = begin("{type: profile, every: 10 steps, axis: z, bins: 6}", scene)->observe(scene, {});
    ASSERT_EQ(rows.size(), 6u);
    for (std::size_t b = 0; b < 6; ++b) EXPECT_NEAR(rows[b].values.at(6), b < 4 ? 0 : 1.0 / 3, 1e-12) << b;
}

}  // namespace
}  // namespace corpuscle::observers::testing
