// Particles that several ranks know: this rank's ghosts that are owned by other ranks, and own particles that are
// ghosts on other ranks.
//
// An operator that is a sum over pairs is the sum of each rank's contributions, from its pairs to the particles that it
// knows, its own and ghosts. If a rank has the operand at all of these particles, an application needs only one message
// in each direction between neighbouring ranks, with the contributions to the particles that both ranks know. They are
// added up in the order of ranks, so that all ranks that know a particle get the same bits (the interface sums of
// domain decomposition, as in spectral elements). Vectors computed from such sums are then correct at particles owned
// by other ranks too, without further messages.
//
// Arrays have entries: 0 .. owned - 1 are the rank's own particles, then each known particle owned by another rank
// once, however many images of it are ghosts.
#pragma once
#include <mpi.h>

#include <vector>

#include "particles/particleSystem.hpp"

namespace corpuscle::particles {

class SharedParticles {
  public:
    // To be called after every build of the system's lists. Collective.
    void plan(ParticleSystem& system);

    std::size_t owned() const { return owned_; }
    std::size_t entries() const { return owned_ + others_; }
    // Entry of a ghost: that of the own particle it is an image of, or that of the particle owned by another rank.
    std::size_t entry(int ghost) const { return entry_[static_cast<std::size_t>(ghost)]; }
    // One ghost of each particle owned by another rank: the k-th is a ghost of entry owned() + k.
    const std::vector<int>& ghostOf() const { return ghostOf_; }

    const std::vector<std::size_t>& shared() const { return shared_; }  // all entries that other ranks know too

    // reaching(): blocks of the list with a shared particle in the block or its list; rest(): all others. away: blocks
    // without wall particles in the block or its list; atWall: those with one.
    struct Blocks {
        std::vector<int> away, atWall;
    };
    const Blocks& reaching() const { return reaching_; }
    const Blocks& rest() const { return rest_; }

    // Sums over all ranks that know it, for each shared entry, the first `count` of the entry's `width` numbers in
    // `values`. Between beginSum and finishSum these numbers must not change; all others may. Collective.
    struct Numbers {
        int width, count;
    };
    template <class Real>
    void beginSum(const Real* values, Numbers numbers);
    template <class Real>
    void finishSum(Real* values, Numbers numbers);
    // Sets the values of particles owned by other ranks to those of their owner. Collective.
    template <class Real>
    void distribute(Real* values, int width);

  private:
    struct Message {
        int rank;
        std::size_t begin, end;  // range in index_
    };
    void findMessages(const ParticleSystem& system, const std::vector<Halo::Origin>& others,
                      const std::vector<Halo::Origin>& copies);
    void sortBlocks(const ParticleSystem& system);

    MPI_Comm comm_ = MPI_COMM_NULL;
    int rank_ = 0;
    std::size_t owned_ = 0, others_ = 0;
    std::vector<std::size_t> entry_;   // entry of each ghost
    std::vector<int> ghostOf_;         // one ghost of each particle owned by another rank
    std::vector<std::size_t> index_;   // entries of all messages, message by message
    std::vector<std::size_t> shared_;  // the entries in index_, sorted, each once
    std::vector<Message> messages_;    // in the order of ranks
    Blocks reaching_, rest_;
    RealArray send_, receive_, mine_;
    std::vector<MPI_Request> requests_;
};

}  // namespace corpuscle::particles
