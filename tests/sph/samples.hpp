// Fluids for the tests: particles that are known completely on every rank. Unit of length: the particle spacing;
// densities are about 1.
#pragma once
#include <mpi.h>

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "core/registry.hpp"
#include "sph/fluidForces.hpp"
#include "support/planeWalls.hpp"

namespace corpuscle::sph::testing {

using particles::Box;
using particles::Kind;
using particles::ParticleStore;
using particles::ParticleSystem;
using particles::Precision;

template <class Family>
std::shared_ptr<const Family> choose(const std::string& text) {
    Problems problems;
    auto choice = readChoice<Family>(parseValue(text, "test", problems), problems);
    problems.throwIfAny();
    return choice.model;
}

struct Particle {
    Vec3 x, u;
    double density = 1, mass = 1, viscosity = 1;
    bool wall = false;
};

inline Box cube(const Index3& n, bool walls = false) {
    return {Vec3::Zero(), Vec3(n[0], n[1], n[2]), {true, true, !walls}};
}

// A lattice in which positions, velocities, densities, masses and viscosities are perturbed, by up to `disorder` in
// position.
inline std::vector<Particle> lattice(const Index3& n, double disorder, unsigned seed = 1) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> d(-disorder, disorder);
    std::vector<Particle> all;
    for (int a = 0; a < n[0]; ++a)
        for (int b = 0; b < n[1]; ++b)
            for (int c = 0; c < n[2]; ++c) {
                Particle p;
                p.x = Vec3(a + 0.5 + d(random), b + 0.5 + d(random), c + 0.5 + d(random));
                p.u = 3 * Vec3(d(random), d(random), d(random));
                p.density = 1 + 0.3 * d(random);
                p.mass = 1 + d(random);
                p.viscosity = 1 + 2 * d(random);
                all.push_back(p);
            }
    return all;
}

inline void deal(const std::vector<Particle>& all, ParticleSystem& system) {
    int rank = 0, size = 1;
    MPI_Comm_rank(system.comm(), &rank);
    MPI_Comm_size(system.comm(), &size);
    ParticleStore& s = system.store();
    for (std::size_t i = static_cast<std::size_t>(rank); i < all.size(); i += static_cast<std::size_t>(size)) {
        const std::size_t k = s.size();
        s.resize(k + 1);
        s.setPosition(k, all[i].x), s.setVelocity(k, all[i].u);
        s.density[k] = all[i].density;
        s.id[k] = static_cast<std::int64_t>(i);
        s.kind[k] = static_cast<std::int64_t>(all[i].wall ? Kind::wall : Kind::fluid);
        if (s.optional().mass) s.mass[k] = all[i].mass;
        if (s.optional().viscosity) s.viscosity[k] = all[i].viscosity;
    }
    system.start();
}

inline FluidModel model(const std::string& kernel, const std::string& equationOfState = "tait") {
    FluidModel m;
    m.kernel = choose<Kernel>(kernel);
    m.equationOfState = choose<EquationOfState>(equationOfState);
    m.density = 1;
    m.viscosity = 0.7;
    m.soundSpeed = 3;
    m.mass = 1;
    return m;
}

// dW/dr as printed in the literature.
inline double kernelDerivative(const std::string& kernel, double r, double H) {
    constexpr double pi = std::numbers::pi;
    const double q = r / H;
    if (q >= 1) return 0;
    if (kernel == "lucy") return -315 / (4 * pi * std::pow(H, 4)) * q * (1 - q) * (1 - q);
    if (kernel == "wendlandC2") return -210 / (pi * std::pow(H, 4)) * q * std::pow(1 - q, 3);
    const double h = H / 3, t = r / h;
    double sum = std::pow(3 - t, 4);
    if (t < 2) sum -= 6 * std::pow(2 - t, 4);
    if (t < 1) sum += 15 * std::pow(1 - t, 4);
    return -5 * sum / (120 * pi * std::pow(h, 4));
}

// The factor by which walls multiply the viscosity between two particles (noSlip.hpp).
inline double wallFactor(const boundary::Walls& walls, const Vec3& a, const Vec3& b) {
    if (!walls.exist()) return 1;
    const double ga = walls.distance(a), gb = walls.distance(b), least = 0.25;
    double value = 1;
    if (gb < 0) value += -gb / std::max(ga, least);
    if (ga < 0) value += -ga / std::max(gb, least);
    return std::min(value, 10.0);
}

inline double sumOverRanks(double value) {
    MPI_Allreduce(MPI_IN_PLACE, &value, 1, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
    return value;
}

}  // namespace corpuscle::sph::testing
