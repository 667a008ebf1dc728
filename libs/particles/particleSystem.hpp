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
    // support: support radius of the kernel H_s [m]; skin [m]; spacing: particle spacing [m] (columns are two wide);
    // precision: that of the pair laws that will run on the list.
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
    long builds() const { return builds_; }  // how often this object has built its lists
    std::size_t bytes() const;

    // Makes images across the faces of this axis slide at this velocity [m/s], which has no component along the axis;
    // their offset is 0 at first. To be called before the store has particles.
    void slideImages(int axis, const Vec3& velocity);
    // Moves the images by this time, backwards if negative; lists and ghosts keep the former offset until the next
    // rebuild.
    void moveImages(double seconds) {
        if (periodicity_.slides()) setOffset(periodicity_.offset() + seconds * slide_);
    }
    // The images as they were this time ago.
    Periodicity imagesAgo(double seconds) const {
        Periodicity images = periodicity_;
        if (images.slides() && seconds != 0)
            images.slide(images.slidingAxis(), images.offset() - seconds * slide_, slide_);
        return images;
    }
    // Sets the offset of the next image [m] (core/periodicity.hpp), reduced by whole periods to at most half a period.
    void setOffset(const Vec3& offset);
    // Replaces each particle of this rank by its image inside the box, with the velocity of that image.
    void wrapAll() {
        for (std::size_t i = 0; i < store_.size(); ++i) wrap(i);
    }

    // From the next build on, lists hold pairs of two particles of bodies too, as if they were fluid.
    void pairWithinBodies() { pairWithinBodies_ = true; }

    // Fills the store for the first time: cuts bricks, sends every particle to its owner, builds lists. Collective.
    void start();
    // Continues from a checkpoint on the same number of ranks, once the store holds this rank's particles in their
    // saved order. Lists are built from xBuilt, yBuilt, zBuilt, so that the run continues bit for bit. rebuilds: their
    // number up to the checkpoint, which determines when bricks are rebalanced.
    void resume(const std::vector<double>& bricks, long rebuilds);

    // Whether some particle of any rank has moved more than skin/2 since the last build. Collective.
    bool mustRebuild() const;
    // The same from the largest squared displacement of this rank's particles, which the caller has computed: NaN or
    // infinity if a position is not finite, so that the rebuild reports that particle.
    bool mustRebuild(double largestDisplacement2) const;
    double largestDisplacement2() const;
    // Wraps, migrates, sorts, plans the halo, builds the list; rebalances bricks when they are uneven. Collective.
    void rebuild();

    // Runs work(group) on the four groups of blocks: on those without ghosts while the halo exchange is under way.
    // `records` holds `fields` numbers per particle: those of owned particles filled in, then room for those of ghosts.
    // scale: as in Halo::begin. Collective.
    template <class Real, class Work>
    void forEachPair(Real* records, int fields, double scale, Work&& work) {
        halo_.begin(records, owned(), fields, scale);
        work(PairList::interior), work(PairList::interiorAtWall);
        halo_.finish(records, owned(), fields);
        work(PairList::boundary), work(PairList::boundaryAtWall);
    }
    // The same if only `part` of the ghosts' records, which excludes the position, has changed since the last call.
    template <class Real, class Work>
    void forEachPair(Real* records, int fields, Halo::Part part, Work&& work) {
        halo_.begin(records, owned(), fields, part);
        work(PairList::interior), work(PairList::interiorAtWall);
        halo_.finish(records, owned(), fields, part);
        work(PairList::boundary), work(PairList::boundaryAtWall);
    }

    // f(i) for all owned particles that lay within `radius` of x when lists were built, and for some further away; x is
    // in the box. Periodic images of x are not considered.
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
    RealArray buildRecords_;      // kept to reuse the memory
    RealArray buildPosition_[3];  // positions at the last build, owned particles before ghosts
};

}  // namespace corpuscle::particles
