// Which rank owns which brick of space.
//
// Zoltan's recursive coordinate bisection cuts the box into one cuboid per rank with nearly equal numbers of particles.
// Bricks tile the box: [low, high) on every axis, so that every position has exactly one owner.
#pragma once
#include <mpi.h>

#include <vector>

#include "particles/box.hpp"
#include "particles/particleStore.hpp"

namespace corpuscle::particles {

struct Brick {
    Vec3 low, high;
};

class Decomposition {
  public:
    Decomposition(MPI_Comm comm, const Box& box);

    int rank() const { return rank_; }
    int size() const { return size_; }
    MPI_Comm comm() const { return comm_; }
    const Brick& brick(int rank) const { return bricks_[static_cast<std::size_t>(rank)]; }
    const Brick& own() const { return brick(rank_); }

    // Cuts the box anew by the positions of all particles, which must be wrapped into the box. Collective.
    void balance(const ParticleStore& particles);
    // Sets the bricks from a checkpoint on the same number of ranks; six numbers each (low, high), as from state().
    void restore(const std::vector<double>& bricks);
    std::vector<double> state() const;

    // The owner of a position; along walls the outermost bricks reach to infinity.
    int owner(const Vec3& p) const;

    // max over ranks of the number of particles divided by the mean. Collective.
    double imbalance(std::size_t owned) const;

  private:
    bool holds(int rank, const Vec3& p) const;
    MPI_Comm comm_;
    int rank_ = 0, size_ = 1;
    Box box_;
    std::vector<Brick> bricks_;
};

// Sends every particle to the rank that owns its position. Collective. Particles that stay come first; those that
// arrive follow in the order of the sending ranks. Particles from one rank keep their order.
void migrate(ParticleStore& particles, const Decomposition& decomposition);

}  // namespace corpuscle::particles
