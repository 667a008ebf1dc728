// A set of particles that is known completely on every rank, and its distribution to a ParticleSystem. Unit of length:
// the particle spacing.
#pragma once
#include <mpi.h>

#include <cstdint>
#include <random>
#include <vector>

#include "particles/particleSystem.hpp"

namespace corpuscle::particles::testing {

struct Population {
    Box box;
    std::vector<Vec3> position;  // wrapped position of the particle with number id
    std::vector<bool> wall;

    // Uniformly random positions; particles in the outer `layer` at both ends of z are wall particles.
    Population(const Box& inside, int count, unsigned seed, double layer = 0) : box(inside) {
        std::mt19937_64 random(seed);
        std::uniform_real_distribution<double> unit(0, 1);
        for (int i = 0; i < count; ++i) {
            const Vec3 share(unit(random), unit(random), unit(random));
            position.push_back(box.periodicity().wrap(box.low + share.cwiseProduct(box.size())));
            wall.push_back(position.back()[2] < box.low[2] + layer || position.back()[2] >= box.high[2] - layer);
        }
    }

    int count() const { return static_cast<int>(position.size()); }

    // Distributes particles to ranks in turn, whatever brick they belong to.
    void deal(ParticleStore& store, MPI_Comm comm = MPI_COMM_WORLD) const {
        int rank = 0, size = 1;
        MPI_Comm_rank(comm, &rank);
        MPI_Comm_size(comm, &size);
        for (int i = rank; i < count(); i += size) {
            const std::size_t k = store.size();
            store.resize(k + 1);
            store.setPosition(k, position[i]);
            store.id[k] = i;
            store.kind[k] = static_cast<std::int64_t>(wall[i] ? Kind::wall : Kind::fluid);
        }
    }
};

inline Box box(const Vec3& size, bool x = true, bool y = true, bool z = true) {
    return {-0.3 * size, 0.7 * size, {x, y, z}};
}

// Boxes with random particles, from wide boxes to some that are thinner than the reach of the neighbour list.
struct PopulatedBox {
    const char* name;
    Box box;
    int count;
    double support, layer;  // layer: thickness of walls, at both ends of z
};
inline const PopulatedBox populatedBoxes[] = {
    {"wide", box({8, 7, 6}), 336, 2.0, 0},
    {"thin", box({7, 3.4, 5}), 119, 2.0, 0},
    {"thinnerThanReach", box({6, 3.1, 1.2}), 45, 2.2, 0},
    {"singleColumn", box({0.9, 0.8, 9}), 14, 1.5, 0},
    {"open", box({5, 5, 7}, false, true, false), 175, 2.0, 0},
    {"walls", box({7, 6, 9}, true, true, false), 400, 2.0, 2.4},
    {"almostEmpty", box({9, 9, 9}), 3, 2.0, 0},
};

// Records of position, id and kind. Those of owned particles are filled here, those of ghosts by the halo exchange.
inline constexpr int tagFields = 5;
inline RealArray taggedRecords(ParticleSystem& system) {
    const ParticleStore& s = system.store();
    const auto total = static_cast<std::size_t>(system.owned() + system.ghosts());
    RealArray records(total * tagFields);
    for (std::size_t i = 0; i < s.size(); ++i) {
        double* r = records.data() + tagFields * i;
        r[0] = s.x[i], r[1] = s.y[i], r[2] = s.z[i];
        r[3] = static_cast<double>(s.id[i]), r[4] = static_cast<double>(s.kind[i]);
    }
    system.forEachPair(records.data(), tagFields, 1, [](PairList::Group) {});
    return records;
}

}  // namespace corpuscle::particles::testing
