// The operators of the implicit step, compared with a plain double loop over all pairs and images that is written from
// the equations of sph/operators.hpp, and checked for the properties that they must have.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cstdio>

#include "core/error.hpp"
#include "sph/operatorSamples.hpp"

using namespace corpuscle;
using namespace corpuscle::sph;
using namespace corpuscle::sph::testing;

namespace {

class CorrectedDivergence : public OperatorTest {
  public:
    static std::vector<OperatorCase> chosen() {
        std::vector<OperatorCase> some;
        for (const OperatorCase& c : operatorCases)
            if (c.form == corrected && c.size[2] > 2 * support + 1) some.push_back(c);
        return some;
    }
};

}  // namespace

TEST_P(OperatorTest, equalThePlainDoubleLoop) {
    build(Precision::full);
    compare<double>(1e-12);
}

// Mixed precision: float rounding, 6e-8, of positions and weights.
TEST_P(OperatorTest, equalItToTheRoundingOfFloatInMixedPrecision) {
    build(Precision::mixed);
    compare<float>(2e-6);
}

TEST_P(OperatorTest, momentsEqualThePlainDoubleLoop) {
    build(Precision::full);
    Operators<double> operators(fluid, *system, GetParam().form);
    prepare(operators);
    std::vector<Vec3> disorder(all.size(), Vec3::Zero());
    std::vector<double> viscous(all.size(), 0.0), bulk(all.size(), 0.0);
    const auto W = [&](double r) { return fluid.kernel->normalisation(support) * fluid.kernel->value(r / support); };
    std::vector<double> evenness;
    for (const double V : volume) evenness.push_back(V * W(0));
    for (const Pair& p : pairs) {
        evenness[p.i] += volume[p.j] * W(p.d.norm());
        disorder[p.i] -= volume[p.j] * p.F * (1 + 0.2 * std::pow(W(p.d.norm()) / W(system->spacing()), 4)) * p.d;
        const double mu = GetParam().layers ? all[p.i].viscosity : fluid.viscosity;
        viscous[p.i] += 2 * mu * volume[p.i] * volume[p.j] * p.F * scale[p.i];
        bulk[p.i] += volume[p.i] * volume[p.i] * volume[p.j] * p.F * p.F * p.d.squaredNorm() / 3;
    }
    for (std::size_t i = 0; i < all.size() && GetParam().varying; ++i)
        viscous[i] += GetParam().layers ? (all[i].viscosity - fluid.lowestLayer) * bulk[i]
                                        : 4 * (inside[i] - fluid.viscosity) * bulk[i];
    forOwned([&](std::size_t id, std::size_t k) {
        if (all[id].wall) return;
        EXPECT_LT((operators.disorder(k) - disorder[id]).norm(), 1e-12);
        EXPECT_NEAR(operators.evenness(k), evenness[id], 1e-12);
        EXPECT_NEAR(operators.viscousDiagonal(k), viscous[id], 1e-12 * viscous[id]);
        EXPECT_NEAR(operators.bulkDiagonal(k), bulk[id], 1e-12 * bulk[id]);
    });
}

// Checked for particles whose support no periodic face cuts (the linear field jumps there), with and without walls.
TEST_P(CorrectedDivergence, isExactForALinearField) {
    const OperatorCase& c = GetParam();
    build(Precision::full);
    Mat3 G;
    G << 0.7, -2, 0.3, 1.1, 0.4, -0.6, 0.2, 3, -0.5;
    std::vector<Vec3> u;
    for (const Particle& p : all) u.push_back(Vec3(0.3, -1, 2) + G * p.x);
    Operators<double> operators(fluid, *system, c.form);
    prepare(operators);
    apply(operators, u, std::vector<double>(all.size(), 0.0));
    double looked = 0;
    forOwned([&](std::size_t id, std::size_t k) {
        bool far = !all[id].wall;
        for (int a = 0; a < (c.walls ? 2 : 3); ++a)
            far &= all[id].x[a] > support + 0.25 && all[id].x[a] < c.size[a] - support - 0.25;
        if (!far) return;
        EXPECT_NEAR(operators.divergence(k), G.trace(), 1e-12);
        ++looked;
    });
    EXPECT_GE(sumOverRanks(looked), 3);
}

TEST_P(OperatorTest, pressureForceIsTheTransposeOfTheDivergence) {
    build(Precision::full);
    Operators<double> operators(fluid, *system, GetParam().form);
    prepare(operators);
    const std::vector<Vec3> u = randomVectors(all.size(), 5);
    const std::vector<double> q = first(randomVectors(all.size(), 6));
    apply(operators, u, q);
    double byDivergence = 0, magnitude = 0;
    forOwned([&](std::size_t id, std::size_t k) {
        const double term = q[id] * volume[id] * operators.divergence(k);
        byDivergence += term, magnitude += std::abs(term);
    });
    apply(operators, std::vector<Vec3>(all.size(), Vec3::Zero()), q);
    const double byForce = power(operators, u);
    EXPECT_NEAR(byForce, sumOverRanks(byDivergence), 1e-14 * sumOverRanks(magnitude));
    EXPECT_GT(std::abs(byForce), 1e-3 * sumOverRanks(magnitude));
}

TEST_P(OperatorTest, viscosityIsSymmetricAndTakesPowerAway) {
    build(Precision::full);
    Operators<double> operators(fluid, *system, GetParam().form);
    prepare(operators);
    const std::vector<Vec3> u = randomVectors(all.size(), 7), v = randomVectors(all.size(), 8);
    const std::vector<double> none(all.size(), 0.0);
    apply(operators, v, none);
    const double uLv = power(operators, u);
    apply(operators, u, none);
    const double vLu = power(operators, v), uLu = power(operators, u);
    EXPECT_LT(uLu, 0);
    EXPECT_NEAR(uLv, vLu, 1e-14 * std::abs(uLu));
    EXPECT_GT(std::abs(uLv), 1e-5 * std::abs(uLu));
    // Only a uniform velocity dissipates no power.
    apply(operators, std::vector<Vec3>(all.size(), Vec3(1, 2, 3)), none);
    EXPECT_EQ(power(operators, u), 0);
}

TEST_P(OperatorTest, noForceIsLeftOver) {
    build(Precision::full);
    Operators<double> operators(fluid, *system, GetParam().form);
    prepare(operators);
    apply(operators, randomVectors(all.size(), 9), first(randomVectors(all.size(), 10)));
    Vec3 total = Vec3::Zero();
    double magnitude = 0;
    forOwned([&](std::size_t, std::size_t k) {
        total += force(operators, k);
        magnitude += force(operators, k).norm();
    });
    MPI_Allreduce(MPI_IN_PLACE, total.data(), 3, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
    EXPECT_LT(total.norm(), 1e-14 * sumOverRanks(magnitude));
    EXPECT_GT(sumOverRanks(magnitude), 1);
}

INSTANTIATE_TEST_SUITE_P(Variants, OperatorTest, ::testing::ValuesIn(operatorCases),
                         [](const auto& instance) { return instance.param.name; });

INSTANTIATE_TEST_SUITE_P(Variants, CorrectedDivergence, ::testing::ValuesIn(CorrectedDivergence::chosen()),
                         [](const auto& instance) { return instance.param.name; });

// A lattice has no disorder, so that the diagonals equal those of the operators.
TEST(OperatorsOnALattice, diagonalsAreThoseOfTheOperators) {
    const Index3 size{6, 6, 6};
    for (const OperatorForm form : {plain, corrected}) {
        ParticleSystem system(MPI_COMM_WORLD, cube(size), {}, support, 0, 1.0);
        deal(lattice(size, 0), system);
        const FluidModel fluid = model("wendlandC2");
        Operators<double> operators(fluid, system, form);
        operators.build(system);
        const ParticleStore& s = system.store();
        const std::int64_t chosen = 43;
        typename Operators<double>::Field u(4 * s.size(), 0.0);
        std::size_t at = s.size();
        for (std::size_t k = 0; k < s.size(); ++k) {
            EXPECT_LT(operators.disorder(k).norm(), 1e-13);
            if (s.id[k] == chosen) at = k, u[4 * k + 1] = 1;
        }
        operators.apply(system, u, [](std::size_t, double) { return 0.0; });
        if (at < s.size()) {
            EXPECT_NEAR(operators.viscousDiagonal(at), -operators.force()[4 * at + 1],
                        1e-12 * operators.viscousDiagonal(at));
        }
        operators.apply(system, std::vector<double, Operators<double>::Field::allocator_type>(4 * s.size(), 0.0),
                        [](std::size_t, double) { return 3.0; });
        for (const double f : operators.force()) EXPECT_NEAR(f, 0, 1e-12) << "of a uniform pressure";
        if (form == plain) {
            double square = 0;
            operators.apply(system, u,
                            [&](std::size_t k, double D) { return square += operators.volume(k) * D * D, 0; });
            square = sumOverRanks(square);
            if (at < s.size()) {
                EXPECT_NEAR(operators.bulkDiagonal(at), square, 1e-12 * square);
            }
        }
    }
}

// A region of higher viscosity that comes near a periodic face without reaching across it, at both ends of each axis:
// particles beyond the face interact with its stress through images only. Forces balance, and the operator is
// symmetric.
TEST(TwoFluids, actThroughPeriodicFacesFromOneSide) {
    const Index3 size{11, 11, 11};
    FluidModel fluid = model("wendlandC2");
    const auto number = [](std::int64_t id, int k, double seed) {
        return std::sin(seed * (static_cast<double>(id) + 1) * (k + 1.3));
    };
    for (int axis = 0; axis < 3; ++axis)
        for (const bool atEnd : {false, true}) {
            ParticleSystem system(MPI_COMM_WORLD, cube(size), {.viscosity = true}, support, 0, 1.0);
            std::vector<Particle> all = lattice(size, 0.2);
            for (Particle& p : all) {
                const double d = atEnd ? 11 - p.x[axis] : p.x[axis];  // from the face
                p.viscosity = fluid.viscosity * (d > 0.6 && d < 3 && std::abs(p.x[(axis + 1) % 3] - 5.5) < 2 ? 5 : 1);
                p.density = p.mass = 1;
            }
            deal(all, system);
            const ParticleStore& s = system.store();
            Operators<double> operators(fluid, system, corrected);
            operators.build(system);
            operators.setInside(system, insideByCentre(s, fluid.viscosity));
            typename Operators<double>::Field field[2];
            std::vector<Vec3> force[2];
            for (int f = 0; f < 2; ++f) {
                field[f].assign(4 * s.size(), 0.0);
                for (std::size_t i = 0; i < s.size(); ++i)
                    for (int k = 0; k < 3; ++k)
                        field[f][4 * i + static_cast<std::size_t>(k)] = number(s.id[i], k, f == 0 ? 1.7 : 2.9);
                operators.apply(system, field[f], [](std::size_t, double D) { return -3 * D; });
                for (std::size_t i = 0; i < s.size(); ++i)
                    force[f].push_back(Vec3::Map(operators.force().data() + 4 * i));
            }
            double cross[2] = {0, 0}, size2 = 0;
            Vec3 total = Vec3::Zero();
            for (std::size_t i = 0; i < s.size(); ++i) {
                for (std::size_t f = 0; f < 2; ++f) cross[f] += Vec3::Map(field[f].data() + 4 * i).dot(force[1 - f][i]);
                total += force[0][i], size2 += force[0][i].squaredNorm();
            }
            for (double* value : {&cross[0], &cross[1], &size2, &total[0], &total[1], &total[2]})
                *value = sumOverRanks(*value);
            EXPECT_NEAR(cross[0], cross[1], 1e-11 * size2) << "axis " << axis << (atEnd ? ", end" : ", beginning");
            EXPECT_LT(total.norm(), 1e-11 * std::sqrt(size2)) << "axis " << axis << (atEnd ? ", end" : ", beginning");
        }
}

// Two layers on a lattice: the force on a column of particles across the jump of viscosity, divided by its area. Rigid
// rotation must cause no force, although Morris' sum alone would resist it like a velocity with the same gradient along
// the jump only; a shear flow of uniform stress must cause none either.
TEST(TwoLayers, keepRigidRotationAndShearStress) {
    const Index3 size{12, 12, 20};
    const double low = 0.7, high = 3.5, jump = 10;
    ParticleSystem system(MPI_COMM_WORLD, cube(size), {.viscosity = true}, support, 0, 1.0);
    std::vector<Particle> all = lattice(size, 0);
    for (Particle& p : all) p.viscosity = p.x[2] > jump ? high : low;
    deal(all, system);
    FluidModel fluid = model("wendlandC2");
    fluid.viscosity = low, fluid.lowestLayer = low;
    const ParticleStore& s = system.store();
    const auto force = [&](const auto& velocity) {
        Operators<double> operators(fluid, system, corrected);
        operators.build(system);
        typename Operators<double>::Field u(4 * s.size(), 0.0);
        for (std::size_t i = 0; i < s.size(); ++i)
            for (int a = 0; a < 3; ++a) u[4 * i + static_cast<std::size_t>(a)] = velocity(s.position(i))[a];
        operators.apply(system, u, [](std::size_t, double) { return 0.0; });
        Vec3 sum = Vec3::Zero();
        const auto& f = operators.force();
        for (std::size_t i = 0; i < s.size(); ++i)  // the four columns that no face of the box influences
            if (const Vec3 x = s.position(i);
                std::max(std::abs(x[0] - 6), std::abs(x[1] - 6)) < 1 && std::abs(x[2] - jump) < 5)
                sum += 0.25 * Vec3(f[4 * i], f[4 * i + 1], f[4 * i + 2]);
        MPI_Allreduce(MPI_IN_PLACE, sum.data(), 3, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
        return sum;
    };
    const Vec3 middle(6, 6, jump);
    for (const Vec3& axis : {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0.3, -0.5, 1)})
        EXPECT_LT(force([&](const Vec3& x) -> Vec3 { return axis.cross(x - middle); }).norm(), 1e-12);
    const auto shear = [&](const Vec3& x) { return Vec3((x[2] - jump) / (x[2] > jump ? high : low), 0, 0); };
    EXPECT_LT(force(shear).norm(), 1e-12);
    const auto along = [&](const Vec3& x) { return Vec3(x[2] - jump, 0, 0); };
    EXPECT_LT((force(along) - Vec3(high - low, 0, 0)).norm(), 1e-12);
}

// The terms that a varying viscosity adds have either sign; the whole operator must take power from every velocity
// except uniform ones. All eigenvalues are checked, for disordered particles and any bulk modulus, which contributes
// little in short steps.
TEST(TwoViscosities, takePowerFromEveryVelocity) {
    struct Fluid {
        double ratio, bulk;
        bool layers;
    };
    const Index3 size{6, 6, 6};
    for (const auto& [ratio, bulk, layers] : {Fluid{2, 0, true},
                                              {20, 0, true},
                                              {5, 0, false},
                                              {100, 0, false},
                                              {0.2, 0, false},
                                              {0.02, 0, false},
                                              {0.2, 50, false},
                                              {0.02, 50, false}}) {
        for (const OperatorForm form : {plain, corrected}) {
            ParticleSystem system(MPI_COMM_WORLD, cube(size), {.viscosity = true}, support, 0, 1.0);
            std::vector<Particle> all = lattice(size, 0.15, 3);
            for (Particle& p : all) p.viscosity = p.x[2] > 3 ? ratio : 1;
            deal(all, system);
            FluidModel fluid = model("wendlandC2");
            fluid.viscosity = 1, fluid.lowestLayer = layers ? 1 : 0;
            Operators<double> operators(fluid, system, form);
            operators.build(system);
            const ParticleStore& s = system.store();
            std::vector<Inside> inside;  // fraction inside, between the planes at 3 and 6
            for (std::size_t k = 0; k < s.size(); ++k) {
                const double depth = std::min(s.position(k)[2] - 3, 6 - s.position(k)[2]);
                inside.push_back({std::clamp(0.5 + (depth > -1.5 ? depth : -3 - depth), 0.0, 1.0), ratio});
            }
            operators.setInside(system, inside);
            const auto n = static_cast<Eigen::Index>(3 * all.size());
            Eigen::MatrixXd K = Eigen::MatrixXd::Zero(n, n);
            for (Eigen::Index column = 0; column < n; ++column) {
                typename Operators<double>::Field u(4 * s.size(), 0.0);
                for (std::size_t k = 0; k < s.size(); ++k)
                    if (s.id[k] == column / 3) u[4 * k + static_cast<std::size_t>(column % 3)] = 1;
                operators.apply(system, u, [modulus = bulk](std::size_t, double D) { return -modulus * D; });
                for (std::size_t k = 0; k < s.size(); ++k)
                    for (std::size_t a = 0; a < 3; ++a)
                        K(3 * s.id[k] + static_cast<Eigen::Index>(a), column) = -operators.force()[4 * k + a];
            }
            MPI_Allreduce(MPI_IN_PLACE, K.data(), static_cast<int>(n * n), MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
            const Eigen::VectorXd values =
                Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(K, Eigen::EigenvaluesOnly).eigenvalues();
            const double largest = values[n - 1];
            std::printf("viscosities 1 and %g%s, %s: eigenvalues %.2e, %.2e, %.2e ... %.3g\n", ratio,
                        layers ? " in layers" : "", form == plain ? "plain" : "corrected", values[0], values[2],
                        values[3], largest);
            EXPECT_GT(values[0], -1e-12 * largest);
            EXPECT_LT(values[2], 1e-12 * largest) << "three uniform velocities cost nothing";
            EXPECT_GT(values[3], 1e-4 * largest) << "and nothing else";
        }
    }
}

TEST(LoneParticle, hasNoGradientAndIsNamed) {
    const Index3 size{8, 8, 8};
    ParticleSystem system(MPI_COMM_SELF, cube(size), {}, support, 0, 1.0);
    ParticleStore& s = system.store();
    s.resize(2);
    for (std::size_t i = 0; i < 2; ++i) {
        s.setPosition(i, Vec3(4, 4, 2 + 2 * static_cast<double>(i)));
        s.density[i] = 1, s.id[i] = 70 + static_cast<std::int64_t>(i);
    }
    system.start();
    Operators<double> operators(model("wendlandC2"), system, corrected);
    try {
        operators.build(system);
        FAIL() << "two particles on a line span no space";
    } catch (const Failure& failure) {
        EXPECT_EQ(failure.code(), ExitCode::numerics);
        const std::string text = failure.what();
        EXPECT_NE(text.find("particle 70 at (4, 4, 2) m has too few neighbours"), std::string::npos) << text;
        EXPECT_NE(text.find("left a void"), std::string::npos) << text;
    }
    Operators<double>(model("wendlandC2"), system, plain).build(system);
}
