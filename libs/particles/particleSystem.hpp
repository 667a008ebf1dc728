// Particles of one rank with their ghosts and neighbour list: what every pair law runs on.
//
//     while (time.running()) {
//         ... move particles ...
//         if (system.mustRebuild()) system.rebuild();
//         ... pack records of the owned ...
//         sumOverPairs(system, kernel, ...);
//     }
#pragma once
#include <mpi.h>

#include <memory>

#include "particles/box.hpp"
#include "particles/columns.hpp"
#include "particles/decomposition.hpp"
#include "particles/halo.hpp"
#include "particles/pairList.hpp"
#include "particles/particleStore.hpp"

namespace corpuscle::particles {

class ParticleSystem {
  public:
    // support: support radius of the kernel H_s [m]; skin [m]; spacing: particle spacing [m] (width of columns);
    // precision of the laws between pairs that are to run on its list.
    ParticleSystem(MPI_Comm comm, const Box& box, ParticleStore::Optional fields, double support, double skin,
                   double spacing, Precision precision = Precision::full);

    ParticleStore& store() { return store_; }
    const ParticleStore& store() const { return store_; }
    const Box& box() const { return box_; }
    const Periodicity& periodicity() const { return periodicity_; }
    const Decomposition& decomposition() const { return decomposition_; }
    const PairList& list() const { return list_; }
    Halo& halo() { return halo_; }
    const Halo& halo() const { return halo_; }
    MPI_Comm comm() const { return decomposition_.comm(); }
    int owned() const { return static_cast<int>(store_.size()); }
    int ghosts() const { return halo_.ghostCount(); }
    double support() const { return support_; }
    double skin() const { return skin_; }
    double spacing() const { return spacing_; }
    Precision precision() const { return precision_; }
    long rebuilds() const { return rebuilds_; }
    long builds() const { return builds_; }  // of the lists, by this object
    std::size_t bytes() const;

    // Images across the faces of this axis move at this velocity [m/s], without a component along the axis; they lie
    // off by nothing now. Before the first particles.
    void slideImages(int axis, const Vec3& velocity);
    // They move on for so long, or back; lists and ghosts are those of before until the next rebuild.
    void moveImages(double seconds) {
        if (periodicity_.slides()) setOffset(periodicity_.offset() + seconds * slide_);
    }
    // Images as they were so long ago.
    Periodicity imagesAgo(double seconds) const {
        Periodicity images = periodicity_;
        if (images.slides() && seconds != 0)
            images.slide(images.slidingAxis(), images.offset() - seconds * slide_, slide_);
        return images;
    }
    // The offset of the next image [m] (core/periodicity.hpp), at least within half a period.
    void setOffset(const Vec3& offset);
    // All of this rank's particles in the box, with the velocities of there.
    void wrapAll() {
        for (std::size_t i = 0; i < store_.size(); ++i) wrap(i);
    }

    // From the next build on, lists hold pairs of two particles of bodies too, as if they were fluid.
    void pairWithinBodies() { pairWithinBodies_ = true; }

    // Fills the store for the first time: cuts bricks, sends every particle to its owner, builds lists. Collective.
    void start();
    // Takes up a checkpoint on the same number of ranks: the store holds this rank's particles in their saved order.
    // Lists are built from xBuilt, yBuilt, zBuilt, so that the run goes on bit for bit.
    // rebuilds: how many there had been (it times the rebalancing).
    void resume(const std::vector<double>& bricks, long rebuilds);

    // Whether some particle of any rank has moved more than skin/2 since the last build. Collective.
    bool mustRebuild() const;
    // The same from a square of displacement that the caller has at hand; NaN or infinity where a position is not
    // finite: the rebuild then reports the particle.
    bool mustRebuild(double largestDisplacement2) const;
    double largestDisplacement2() const;
    // Wraps, migrates, sorts, plans the halo, builds the list; rebalances bricks when they are uneven. Collective.
    void rebuild();

    // Runs work(group) on the four groups of blocks: those without ghosts while the halo is under way. `records` holds
    // `fields` numbers per particle, owned ones filled, room for ghosts behind them; scale: positions in them per
    // metre. Collective.
    template <class Real, class Work>
    void forEachPair(Real* records, int fields, double scale, Work&& work) {
        halo_.begin(records, owned(), fields, scale);
        work(PairList::interior), work(PairList::interiorAtWall);
        halo_.finish(records, owned(), fields);
        work(PairList::boundary), work(PairList::boundaryAtWall);
    }
    // The same when only `part` of the ghosts' records has changed since the last time, and that is no position.
    template <class Real, class Work>
    void forEachPair(Real* records, int fields, Halo::Part part, Work&& work) {
        halo_.begin(records, owned(), fields, part);
        work(PairList::interior), work(PairList::interiorAtWall);
        halo_.finish(records, owned(), fields, part);
        work(PairList::boundary), work(PairList::boundaryAtWall);
    }

    // f(i) for the owned particles that lay within `radius` of x, or more, when lists were built; x in the box. No
    // image of x is taken.
    template <class F>
    void forOwnedNear(const Vec3& x, double radius, F&& f) const {
        columns_.forNear(store_.zBuilt.data(), x, radius, f);
    }

    // The same for ghosts, by their numbers; x near the brick.
    template <class F>
    void forGhostsNear(const Vec3& x, double radius, F&& f) const {
        ghostColumns_.forNear(buildPosition_[2].data() + owned(), x, radius, f);
    }

  private:
    void wrap(std::size_t i);
    void buildFrom(const RealArray& x, const RealArray& y, const RealArray& z);
    Box box_;
    Periodicity periodicity_;
    Vec3 slide_ = Vec3::Zero();  // velocity of the next image across the sliding axis
    double support_, skin_, spacing_;
    Precision precision_;
    bool pairWithinBodies_ = false;
    ParticleStore store_;
    Decomposition decomposition_;
    Halo halo_;
    PairList list_;
    Columns columns_, ghostColumns_;
    long rebuilds_ = 0, builds_ = 0;
    RealArray buildRecords_;      // kept for its memory
    RealArray buildPosition_[3];  // of the last build, ghosts behind the owned
};

}  // namespace corpuscle::particles
