// A swirling flow on a slightly disordered lattice in a periodic box, on which integrators are compared.
#pragma once
#include "sph/samples.hpp"

namespace corpuscle::sph::testing::swirl {

inline constexpr Index3 size{8, 8, 6};
inline constexpr std::size_t particleCount = 8 * 8 * 6;

inline std::vector<Particle> particles() {
    std::vector<Particle> all = lattice(size, 0.05, 3);
    const double k = 2 * std::numbers::pi / 8;
    for (Particle& p : all)
        p.u = Vec3(std::sin(k * p.x[0]) * std::cos(k * p.x[1]), -std::cos(k * p.x[0]) * std::sin(k * p.x[1]), 0.1);
    return all;
}

// Position, velocity and density of all particles, by particle number, on every rank.
inline std::vector<double> state(const ParticleSystem& system) {
    std::vector<double> all(7 * particleCount, 0.0);
    const ParticleStore& s = system.store();
    for (std::size_t i = 0; i < s.size(); ++i) {
        const Vec3 x = system.periodicity().wrap(s.position(i));
        double* out = all.data() + 7 * s.id[i];
        for (int k = 0; k < 3; ++k) out[k] = x[k];
        out[3] = s.u[i], out[4] = s.v[i], out[5] = s.w[i], out[6] = s.density[i];
    }
    MPI_Allreduce(MPI_IN_PLACE, all.data(), static_cast<int>(all.size()), MPI_DOUBLE, MPI_SUM, system.comm());
    return all;
}

// Norm of the difference between two states.
inline double difference(const std::vector<double>& a, const std::vector<double>& b) {
    double sum = 0;
    for (std::size_t k = 0; k < a.size(); ++k) {
        double d = a[k] - b[k];
        if (k % 7 < 3) d -= std::nearbyint(d / size[k % 7]) * size[k % 7];
        sum += d * d;
    }
    return std::sqrt(sum);
}

}  // namespace corpuscle::sph::testing::swirl
