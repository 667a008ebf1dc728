// Particles that several ranks know: those of other ranks among this rank's ghosts, and own ones that are ghosts
// elsewhere.
//
// An operator that is a sum over pairs falls apart into what each rank's pairs do to the particles that the rank knows,
// its own and those of others. Where values at all of these are at hand, an application needs one message to each
// neighbour: what its pairs gave to the particles that both know, both ways, added up in the order of ranks, so that
// all who know a particle have the same bits (the interface sums of domain decomposition, as in spectral elements).
// Vectors that are made of such sums stay right at particles owned by other ranks without further messages.
//
// Arrays have entries: 0 .. owned - 1 are the rank's own particles, then each particle of other ranks once, however
// many images of it are ghosts.
#pragma once
#include <mpi.h>

#include <vector>

#include "particles/particleSystem.hpp"

namespace corpuscle::particles {

class SharedParticles {
  public:
    // After every build of the system's lists. Collective.
    void plan(ParticleSystem& system);

    std::size_t owned() const { return owned_; }
    std::size_t entries() const { return owned_ + others_; }
    // Of a ghost: that of the own particle of which it is an image, or that of another rank's.
    std::size_t entry(int ghost) const { return entry_[static_cast<std::size_t>(ghost)]; }
    // One ghost of each particle owned by another rank, entry owned() + k having the k-th.
    const std::vector<int>& ghostOf() const { return ghostOf_; }

    const std::vector<std::size_t>& shared() const { return shared_; }  // all entries that other ranks have too

    // Blocks of the list whose pairs give to a particle that others know too, and the rest: those that meet no wall,
    // those that do.
    struct Blocks {
        std::vector<int> away, atWall;
    };
    const Blocks& reaching() const { return reaching_; }
    const Blocks& rest() const { return rest_; }

    // Adds up what all ranks have of each shared entry: of the `width` numbers that stand in `values` for an entry, the
    // first `count`. From `begin` to `finish` these must stay as they are; all others may change. Collective.
    struct Numbers {
        int width, count;
    };
    template <class Real>
    void beginSum(const Real* values, Numbers numbers);
    template <class Real>
    void finishSum(Real* values, Numbers numbers);
    // The owner's values on all who share a particle. Collective.
    template <class Real>
    void distribute(Real* values, int width);

  private:
    struct Message {
        int rank;
        std::size_t begin, end;  // of index_
    };
    void findMessages(const ParticleSystem& system, const std::vector<Halo::Origin>& others,
                      const std::vector<Halo::Origin>& copies);
    void sortBlocks(const ParticleSystem& system);

    MPI_Comm comm_ = MPI_COMM_NULL;
    int rank_ = 0;
    std::size_t owned_ = 0, others_ = 0;
    std::vector<std::size_t> entry_;   // of ghosts
    std::vector<int> ghostOf_;         // of particles owned by other ranks
    std::vector<std::size_t> index_;   // entries of each message
    std::vector<std::size_t> shared_;  // entries of all of them, each once
    std::vector<Message> messages_;    // in the order of ranks
    Blocks reaching_, rest_;
    RealArray send_, receive_, mine_;
    std::vector<MPI_Request> requests_;
};

}  // namespace corpuscle::particles
