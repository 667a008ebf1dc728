// A pair law over all particles of a rank, the halo under way behind the blocks that need no ghosts.
#pragma once
#include "particles/particleSystem.hpp"

namespace corpuscle::particles {

// Position in a record of pairLoop.hpp.
template <class Real>
void recordPosition(const ParticleSystem& system, std::size_t i, Real* record) {
    const ParticleStore& s = system.store();
    const Vec3 middle = system.box().middle();
    const double scale = 1 / system.support();
    record[0] = static_cast<Real>((s.x[i] - middle[0]) * scale);
    record[1] = static_cast<Real>((s.y[i] - middle[1]) * scale);
    record[2] = static_cast<Real>((s.z[i] - middle[2]) * scale);
}

// results[0..3] of the owned particles. `records` holds `fields` doubles per particle, those of owned ones filled, with room for
// ghosts behind them; `sums` is memory to work in. atWall: the form of the law for blocks that meet a wall. Collective.
template <class Constants, class Real>
void sumOverPairs(ParticleSystem& system, const PairKernel<Constants, Real>& kernel,
                  const PairKernel<Constants, Real>& atWall, const Constants& constants, AlignedVector<Real>& records,
                  int fields, RealArray& sums, double* const* results) {
    sums.assign(static_cast<std::size_t>(system.owned()) * pairSums, 0.0);
    system.forEachPair(records.data(), fields, 1 / system.support(), [&](PairList::Group group) {
        const std::vector<int>& blocks = system.list().blocks(group);
        const bool wall = group == PairList::interiorAtWall || group == PairList::boundaryAtWall;
        (wall ? atWall : kernel)
            .run(constants, system.list().view(), blocks.data(), static_cast<int>(blocks.size()), records.data(),
                 sums.data());
    });
    kernel.finish(constants, system.owned(), records.data(), sums.data(), results);
}

}  // namespace corpuscle::particles
