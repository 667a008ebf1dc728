// Reference for the operators of the implicit step: a plain double loop over all pairs and images, written from the
// equations of sph/operators.hpp.
#pragma once
#include <gtest/gtest.h>

#include <Eigen/LU>

#include "sph/operators.hpp"
#include "sph/samples.hpp"

namespace corpuscle::sph::testing {

inline constexpr double support = 2.3, layers = 2.6;  // thickness of a wall

struct OperatorCase {
    const char* name;
    std::string kernel;
    OperatorForm form;
    bool varying, walls;  // varying: masses and viscosities vary
    Index3 size;
    bool layers = false;  // the viscosity is treated as that of layers, although it varies from particle to particle
};
inline constexpr auto plain = OperatorForm::plain, corrected = OperatorForm::corrected;

inline const OperatorCase operatorCases[] = {
    {"lucy", "lucy", corrected, false, false, {7, 6, 8}},
    {"wendland", "wendlandC2", corrected, false, false, {7, 6, 8}},
    {"quinticVarying", "quintic", corrected, true, false, {7, 6, 8}},
    {"lucyPlain", "lucy", plain, true, false, {7, 6, 8}},
    {"wendlandThinBox", "wendlandC2", corrected, false, false, {9, 4, 2}},
    {"lucyWallsVarying", "lucy", corrected, true, true, {7, 7, 11}},
    {"wendlandWalls", "wendlandC2", corrected, false, true, {7, 7, 11}},
    {"quinticWallsPlain", "quintic", plain, true, true, {7, 7, 11}},
    {"wendlandLarge", "wendlandC2", corrected, true, false, {9, 8, 9}},
    {"wendlandLayers", "wendlandC2", corrected, true, true, {7, 7, 11}, true},
    {"lucyLayersPlain", "lucy", plain, true, true, {7, 7, 11}, true},
    {"quinticLayersPeriodic", "quintic", corrected, true, false, {7, 6, 8}, true},
};

// Random numbers in [-1, 1], the same on every rank.
inline std::vector<Vec3> randomVectors(std::size_t n, unsigned seed) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> d(-1, 1);
    std::vector<Vec3> all(n);
    for (Vec3& v : all) v = Vec3(d(random), d(random), d(random));
    return all;
}

inline std::vector<double> first(const std::vector<Vec3>& vectors) {
    std::vector<double> x;
    for (const Vec3& v : vectors) x.push_back(v[0]);
    return x;
}

class OperatorTest : public ::testing::TestWithParam<OperatorCase> {
  protected:
    FluidModel fluid;
    std::vector<Particle> all;
    std::unique_ptr<ParticleSystem> system;
    // Results of the double loop, for all particles by their number.
    struct Pair {
        std::size_t i, j;
        Vec3 d;  // x_j - x_i, j an image
        double F, beta;
    };
    std::vector<Pair> pairs;
    std::vector<Mat3> B;
    std::vector<double> volume, scale;
    std::vector<double> inside;  // viscosity averaged over the kernel

    void SetUp() override {
        const OperatorCase& c = GetParam();
        fluid = model(c.kernel);
        if (c.layers) fluid.lowestLayer = 0.5;  // the lowest viscosity of lattice()
        all = lattice(c.size, 0.25, 5);
        if (!c.layers)  // few viscosity ratios, since for each a film coefficient has to be computed
            for (Particle& p : all) p.viscosity = 0.5 * std::ceil(2 * p.viscosity);
        if (c.walls) {
            fluid.walls = boundary::testing::planes(2, layers, c.size[2] - layers);
            for (Particle& p : all) p.wall = fluid.walls.distance(p.x) < 0;
            Particle& pushed = all[8];  // a fluid particle, behind a surface
            pushed.wall = false, pushed.x[2] = c.size[2] - layers + 0.3;
        }
        findPairs();
        findMoments();
    }

    void build(Precision precision) {
        const OperatorCase& c = GetParam();
        system = std::make_unique<ParticleSystem>(MPI_COMM_WORLD, cube(c.size, c.walls),
                                                  ParticleStore::Optional{c.varying, c.varying, false, false}, support,
                                                  0, 1.0, precision);
        deal(all, *system);
    }

    void findPairs() {
        const OperatorCase& c = GetParam();
        const int across = c.walls ? 0 : 2;
        std::vector<double> sum(all.size(), 0.0);
        inside.assign(all.size(), 0.0);
        for (std::size_t i = 0; i < all.size(); ++i)
            for (std::size_t j = 0; j < all.size(); ++j)
                for (int x = -2; x <= 2; ++x)
                    for (int y = -2; y <= 2; ++y)
                        for (int z = -across; z <= across; ++z) {
                            const Vec3 at =
                                all[j].x + Vec3(x * c.size[0], y * c.size[1], z * c.size[2]).cast<double>().eval();
                            const Vec3 d = at - all[i].x;
                            const double r = d.norm();
                            if (r < support) {
                                const double w = (c.varying ? all[j].mass : fluid.mass) / all[j].density *
                                                 fluid.kernel->value(r / support);
                                inside[i] += w * all[j].viscosity, sum[i] += w;
                            }
                            if (r == 0 || r >= support || (all[i].wall && all[j].wall)) continue;
                            pairs.push_back({i, j, d, -kernelDerivative(c.kernel, r, support) / r,
                                             wallFactor(fluid.walls, all[i].x, at)});
                        }
        for (std::size_t i = 0; i < all.size(); ++i) inside[i] /= sum[i];
    }

    void findMoments() {
        const OperatorCase& c = GetParam();
        for (const Particle& p : all) volume.push_back((c.varying ? p.mass : fluid.mass) / p.density);
        std::vector<Mat3> M(all.size(), Mat3::Zero());
        for (const Pair& p : pairs) M[p.i] += volume[p.j] * p.F * p.d * p.d.transpose();
        double lattice = 0;  // S2
        for (int x = -2; x <= 2; ++x)
            for (int y = -2; y <= 2; ++y)
                for (int z = -2; z <= 2; ++z)
                    if (const double r = Vec3(x, y, z).norm(); r > 0)
                        lattice -= kernelDerivative(c.kernel, r, support) * r / 3;
        for (std::size_t i = 0; i < all.size(); ++i) {
            const bool unit = all[i].wall || c.form == plain;
            B.push_back(unit ? Mat3(Mat3::Identity()) : Mat3(M[i].inverse()));
            scale.push_back(c.form == plain ? 1 : 1 / (all[i].wall ? lattice : M[i].trace() / 3));
        }
    }

    // Every particle lies completely inside, each with its own viscosity.
    template <class Real>
    void prepare(Operators<Real>& operators) const {
        operators.build(*system);
        if (!GetParam().varying) return;
        std::vector<Inside> whole;
        for (const double viscosity : system->store().viscosity) whole.push_back({1, viscosity});
        operators.setInside(*system, whole);
    }

    // tau B: the additional stress where the viscosity differs from the fluid's.
    std::vector<Mat3> stress(const std::vector<Vec3>& u) const {
        std::vector<Mat3> T(all.size(), Mat3::Zero());
        if (!GetParam().varying) return T;
        for (const Pair& p : pairs) T[p.i] += volume[p.j] * p.F * (B[p.i] * p.d) * (u[p.j] - u[p.i]).transpose();
        for (std::size_t i = 0; i < all.size(); ++i) {
            const Mat3 twice = T[i] + T[i].transpose();
            if (!GetParam().layers) {
                const double more = inside[i] - fluid.viscosity, bulk = std::max(-more, 0.0);
                T[i] = (more * twice + bulk * T[i].trace() * Mat3::Identity()) * B[i];
            } else if (all[i].wall)
                T[i].setZero();
            else
                T[i] = (all[i].viscosity - fluid.lowestLayer) * T[i] * B[i];
        }
        return T;
    }
    // The viscosity between two particles in L.
    double mean(std::size_t i, std::size_t j) const {
        const double a = all[i].viscosity, b = all[j].viscosity;
        return GetParam().layers ? 2 * a * b / (a + b) : fluid.viscosity;
    }
    std::vector<double> divergence(const std::vector<Vec3>& u) const {
        std::vector<double> D(all.size(), 0.0);
        for (const Pair& p : pairs) D[p.i] += volume[p.j] * p.F * (B[p.i] * p.d).dot(u[p.j] - u[p.i]);
        return D;
    }
    std::vector<Vec3> force(const std::vector<Vec3>& u, const std::vector<double>& pressure) const {
        std::vector<Vec3> f(all.size(), Vec3::Zero());
        const std::vector<Mat3> T = stress(u);
        for (const Pair& p : pairs) {
            const double both = volume[p.i] * volume[p.j] * p.F;
            f[p.i] -= both * (pressure[p.i] * B[p.i] + pressure[p.j] * B[p.j] - T[p.i] - T[p.j]) * p.d;
            f[p.i] -= both * mean(p.i, p.j) * (scale[p.i] + scale[p.j]) * p.beta * (u[p.i] - u[p.j]);
        }
        return f;
    }

    // Calls f(number, index in the store) for each particle of this rank.
    template <class F>
    void forOwned(F&& f) const {
        for (std::size_t k = 0; k < system->store().size(); ++k) f(static_cast<std::size_t>(system->store().id[k]), k);
    }
    template <class Real>
    typename Operators<Real>::Field field(const std::vector<Vec3>& u) const {
        typename Operators<Real>::Field all4(4 * system->store().size(), Real(0));
        forOwned([&](std::size_t id, std::size_t k) {
            for (std::size_t a = 0; a < 3; ++a) all4[4 * k + a] = static_cast<Real>(u[id][static_cast<int>(a)]);
        });
        return all4;
    }
    template <class Real>
    void apply(Operators<Real>& operators, const std::vector<Vec3>& u, const std::vector<double>& pressure) {
        operators.apply(*system, field<Real>(u), [&](std::size_t k, double) {
            return pressure[static_cast<std::size_t>(system->store().id[k])];
        });
    }
    template <class Real>
    static Vec3 force(const Operators<Real>& operators, std::size_t k) {
        const auto& f = operators.force();
        EXPECT_EQ(f[4 * k + 3], 0);
        return {f[4 * k], f[4 * k + 1], f[4 * k + 2]};
    }
    // sum_i u_i.f_i
    template <class Real>
    double power(const Operators<Real>& operators, const std::vector<Vec3>& u) const {
        double sum = 0;
        forOwned([&](std::size_t id, std::size_t k) { sum += u[id].dot(force(operators, k)); });
        return sumOverRanks(sum);
    }

    // As in the implicit step, the pressure is an earlier pressure less a multiple of the divergence of u.
    template <class Real>
    void compare(double tolerance) {
        Operators<Real> operators(fluid, *system, GetParam().form);
        prepare(operators);
        const std::vector<Vec3> u = randomVectors(all.size(), 3);
        std::vector<double> pressure = first(randomVectors(all.size(), 4));
        const auto rate = divergence(u);
        operators.apply(*system, field<Real>(u), [&](std::size_t k, double D) {
            return pressure[static_cast<std::size_t>(system->store().id[k])] - 0.4 * D;
        });
        for (std::size_t i = 0; i < all.size(); ++i) pressure[i] -= 0.4 * rate[i];
        const auto expected = force(u, pressure);
        double error = 0, rateError = 0, size = 0, rateSize = 0;
        for (std::size_t i = 0; i < all.size(); ++i)
            size = std::max(size, expected[i].norm()), rateSize = std::max(rateSize, std::abs(rate[i]));
        forOwned([&](std::size_t id, std::size_t k) {
            EXPECT_EQ(operators.isWall(k), all[id].wall);
            EXPECT_NEAR(operators.volume(k), volume[id], 1e-15);
            error = std::max(error, (force(operators, k) - expected[id]).norm());
            rateError = std::max(rateError, std::abs(operators.divergence(k) - rate[id]));
        });
        EXPECT_LT(error, tolerance * size);
        EXPECT_LT(rateError, tolerance * rateSize);
    }
};

}  // namespace corpuscle::sph::testing
