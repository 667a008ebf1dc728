// Sums a pair law over all particles of a rank; blocks that need no ghosts are processed during the halo exchange.
#pragma once
#include "particles/particleSystem.hpp"

namespace corpuscle::particles {

// Computes positions as records have them (pairLoop.hpp): relative to the middle of the box, in units of the support.
class RecordFrame {
  public:
    explicit RecordFrame(const ParticleSystem& system)
        : store_(system.store()), middle_(system.box().middle()), scale_(1 / system.support()) {}
    template <class Real>
    void position(std::size_t i, Real* record) const {
        record[0] = static_cast<Real>((store_.x[i] - middle_[0]) * scale_);
        record[1] = static_cast<Real>((store_.y[i] - middle_[1]) * scale_);
        record[2] = static_cast<Real>((store_.z[i] - middle_[2]) * scale_);
    }

  private:
    const ParticleStore& store_;
    Vec3 middle_;
    double scale_;
};

// Adds the pairs of the named blocks to `sums`.
template <class Constants, class Real>
void addPairs(const PairKernel<Constants, Real>& kernel, const Constants& constants, const PairList& list,
              const std::vector<int>& blocks, const AlignedVector<Real>& records, RealArray& sums) {
    kernel.run(constants, list.view(), blocks.data(), static_cast<int>(blocks.size()), records.data(), sums.data());
}

// Computes results[0 .. count) for the owned particles, where count is the law's number of sums. `records` holds
// `fields` doubles per particle: those of owned particles filled in, then room for those of ghosts. `sums` is working
// memory. atWall: the form of the law for blocks with wall particles in the block or its list. Collective.
template <class Constants, class Real>
void sumOverPairs(ParticleSystem& system, const PairKernel<Constants, Real>& kernel,
                  const PairKernel<Constants, Real>& atWall, const Constants& constants, AlignedVector<Real>& records,
                  int fields, RealArray& sums, double* const* results, int count = 4) {
    sums.assign(static_cast<std::size_t>(system.owned() + system.ghosts()) * static_cast<std::size_t>(count), 0.0);
    system.forEachPair(records.data(), fields, 1 / system.support(), [&](PairList::Group group) {
        addPairs(PairList::isAtWall(group) ? atWall : kernel, constants, system.list(), system.list().blocks(group),
                 records, sums);
    });
    system.halo().foldImages(sums.data(), system.owned(), count);
    kernel.finish(constants, system.owned(), records.data(), sums.data(), results);
}

}  // namespace corpuscle::particles
