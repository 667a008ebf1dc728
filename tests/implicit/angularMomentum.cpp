// Torque of the forces of each scheme, and the change of angular momentum over a turn. For a flow or a pressure that
// vanishes near the faces of a periodic box, viscosity and pressure exert no net torque; the torque of the pair forces
// is the error of the scheme. Lengths in spacings.
#include <gtest/gtest.h>

#include <functional>
#include <numbers>

#include "coupling/adjointVerlet.hpp"
#include "coupling/fluidScene.hpp"
#include "implicit/implicitStep.hpp"
#include "sph/velocityVerlet.hpp"

using namespace corpuscle;
using coupling::testing::FluidScene;
using particles::ParticleStore;
using particles::Precision;
using sph::testing::Particle;

namespace {

constexpr double R = 7, omega = 1;
const Index3 size{20, 20, 20};
const Vec3 centre(10.2, 9.9, 10.05);
const double volume = 4 * std::numbers::pi / 3 * R * R * R;

double bump(double r2) { return r2 < R * R ? std::pow(1 - r2 / (R * R), 4) : 0; }
Vec3 vortex(const Vec3& x) {  // about z, divergence-free
    const Vec3 d = x - centre;
    return bump(d.squaredNorm()) * omega * Vec3::UnitZ().cross(d);
}
double pressure(const Vec3& x) {  // an ellipsoid of which no lattice plane is a plane of symmetry
    const Vec3 d = x - centre;
    const double a = 0.8 * d[0] + 0.6 * d[1], b = -0.6 * d[0] + 0.8 * d[1];
    return bump(a * a + 2.2 * b * b + 1.4 * d[2] * d[2]);
}

std::vector<Particle> fluid(double disorder, bool moving, double inside = 1) {
    std::vector<Particle> all = sph::testing::lattice(size, disorder);
    for (Particle& p : all) {
        p.u = moving ? vortex(p.x) : Vec3(Vec3::Zero());
        p.density = p.mass = 1;
        p.viscosity = (p.x - centre).norm() < 0.5 * R ? inside : 1;
    }
    return all;
}
sph::FluidModel model(double viscosity = 1) {
    sph::FluidModel m = sph::testing::model("wendlandC2", "linear");
    m.viscosity = viscosity, m.soundSpeed = 10 * omega * R;
    return m;
}
FluidScene scene(const std::vector<Particle>& all, double viscosity, bool varying, double skin) {
    return {all, size, model(viscosity), omega, skin, MPI_COMM_WORLD, Precision::full, {.viscosity = varying}};
}

template <class Force>
double torque(const FluidScene& f, Force&& force) {
    Vec3 sum;
    for (int k = 0; k < 3; ++k)
        sum[k] = f.sum(
            [&](std::size_t i) -> double { return (f.scene.store().position(i) - centre).cross(Vec3(force(i)))[k]; });
    return sum.norm();
}

// Torque over mu omega V (viscosity) or over the largest pressure times V: by the plain pair law, and by adjoint
// operators.
double ofPairs(double disorder, bool viscous, double inside = 1) {
    std::vector<Particle> all = fluid(disorder, viscous, inside);
    if (!viscous)
        for (Particle& p : all) p.density = 1 + 1e-2 * pressure(p.x);
    FluidScene f = scene(all, 1, inside != 1, 0);
    f.scene.forces->evaluate(*f.scene.system, 0);
    const ParticleStore& s = f.scene.store();
    const double c = f.scene.model().soundSpeed, scale = viscous ? omega * volume : 1e-2 * c * c * volume;
    return torque(f, [&](std::size_t i) { return Vec3(s.fx[i], s.fy[i], s.fz[i]); }) / scale;
}
double ofOperators(double disorder, bool viscous, sph::OperatorForm form, double inside = 1) {
    FluidScene f = scene(fluid(disorder, viscous, inside), 1, inside != 1, 0);
    const ParticleStore& s = f.scene.store();
    sph::Operators<double> operators(f.scene.model(), *f.scene.system, form);
    operators.build(*f.scene.system);
    if (inside != 1) operators.setInside(*f.scene.system, sph::insideByCentre(s, 1));
    sph::Operators<double>::Field u(4 * s.size(), 0.0);
    for (std::size_t i = 0; i < s.size(); ++i) u[4 * i] = s.u[i], u[4 * i + 1] = s.v[i], u[4 * i + 2] = s.w[i];
    operators.apply(*f.scene.system, u, [&](std::size_t i, double) { return viscous ? 0 : pressure(s.position(i)); });
    return torque(f, [&](std::size_t i) { return Vec3(Vec3::Map(operators.force().data() + 4 * i)); }) /
           (omega * volume);
}

}  // namespace

TEST(AngularMomentum, torqueOfPairs) {
    std::printf("torque over mu omega V (viscosity), p V (pressure); disorder 0, 0.1, 0.2\n");
    const auto line = [](const char* name, const std::function<double(double)>& find) {
        std::vector<double> found;
        for (const double disorder : {0.0, 0.1, 0.2}) found.push_back(find(disorder));
        std::printf("%-44s %9.2e %9.2e %9.2e\n", name, found[0], found[1], found[2]);
        return found;
    };
    using sph::OperatorForm;
    const auto pairs = line("viscosity, pair law", [](double d) { return ofPairs(d, true); });
    const auto plain =
        line("viscosity, operators, plain", [](double d) { return ofOperators(d, true, OperatorForm::plain); });
    const auto corrected =
        line("viscosity, operators, corrected", [](double d) { return ofOperators(d, true, OperatorForm::corrected); });
    const auto pairsJump = line("viscosity 5 inside, pair law", [](double d) { return ofPairs(d, true, 5); });
    const auto jump = line("viscosity 5 inside, operators, corrected",
                           [](double d) { return ofOperators(d, true, OperatorForm::corrected, 5); });
    const auto pairsPressure = line("pressure, pair law", [](double d) { return ofPairs(d, false); });
    const auto plainPressure =
        line("pressure, operators, plain", [](double d) { return ofOperators(d, false, OperatorForm::plain); });
    const auto correctedPressure =
        line("pressure, operators, corrected", [](double d) { return ofOperators(d, false, OperatorForm::corrected); });
    for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_LT(pairsPressure[k], 1e-12) << "along the line of centres";
        EXPECT_LT(plainPressure[k], 1e-12) << "along the line of centres";
        EXPECT_NEAR(plain[k], pairs[k], 1e-10) << "the same sum";
        EXPECT_LT(correctedPressure[k], 1e-12) << "a rotation has no divergence by the corrected gradient";
        EXPECT_NEAR(jump[k], corrected[k], 1e-10) << "a symmetric stress by the corrected gradient has no torque";
        EXPECT_GT(pairsJump[k], 0.2) << "Morris' sum puts a torque on a jump of viscosity";
    }
    EXPECT_LT(pairs[0], 1e-12) << "the lattice's symmetry";
    for (std::size_t k = 1; k < 3; ++k) {
        EXPECT_LT(pairs[k], 2e-3 * static_cast<double>(k));
        EXPECT_LT(corrected[k], 2e-3 * static_cast<double>(k));
        EXPECT_GT(corrected[k], 1e-5) << "Morris' pairs are not along the line of centres";
    }
}

// The middle of the vortex turns by a radian; nu t/R^2 = 0.02.
TEST(AngularMomentum, keptOverATurn) {
    const double time = 1 / omega, viscosity = 0.02 * R * R / time;
    std::printf("change of angular momentum over omega t = %g, nu t/R^2 = 0.02, from disorder 0.1\n", time * omega);
    const auto change = [&](const char* name, double skin, auto&& make, int steps) {
        FluidScene f = scene(fluid(0.1, true), viscosity, false, skin);
        const ParticleStore& s = f.scene.store();
        const auto momentum = [&] {
            return f.sum([&](std::size_t i) {
                return f.scene.system->periodicity().shortest(s.position(i) - centre).cross(s.velocity(i))[2];
            });
        };
        const double before = momentum();
        const auto advance = make(f.scene);
        for (int k = 0; k < steps; ++k) advance(time / steps);
        const double found = momentum() / before - 1;
        std::printf("%-32s %9.2e in %d steps\n", name, found, steps);
        return std::abs(found);
    };
    const int acoustic = 300;
    std::unique_ptr<sph::ExplicitScheme> scheme;
    std::unique_ptr<coupling::AdjointVerlet> adjointStep;
    std::unique_ptr<implicit::ImplicitStep> step;
    const auto verlet = [&](coupling::Scene& on) {
        scheme = std::make_unique<sph::VelocityVerlet>(*on.system, *on.forces, nullptr, std::vector<sph::Load*>{});
        scheme->start();
        return [&](double dt) { scheme->advance(dt); };
    };
    const auto adjoint = [&](coupling::Scene& on) {
        adjointStep = coupling::AdjointVerlet::make(on, {});
        adjointStep->start();
        return [&](double dt) { adjointStep->advance(dt); };
    };
    const auto implicitly = [&](std::optional<double> shifting) {
        return [&, shifting](coupling::Scene& on) {
            implicit::ImplicitStep::Options options;
            options.settings = {.step = 0.05, .tolerance = 1e-5};
            options.shifting = shifting;
            step = implicit::ImplicitStep::make(on, options);
            return [&](double dt) { step->advance(dt); };
        };
    };
    EXPECT_LT(change("velocity Verlet, plain pairs", 0.3, verlet, acoustic), 2e-3);
    EXPECT_LT(change("velocity Verlet, corrected", 0.3, adjoint, acoustic), 2e-3);
    EXPECT_LT(change("implicit, corrected", 0, implicitly({}), 20), 2e-3);
    EXPECT_LT(change("the same with shifting", 0, implicitly(1), 20), 2e-3);
}
