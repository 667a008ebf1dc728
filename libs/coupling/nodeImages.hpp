// Where a node is seen from the particles of a rank: all of its periodic images near the rank's brick.
#pragma once
#include "particles/particleSystem.hpp"

namespace corpuscle::coupling {

// f(image) for all images of x within `reach` of the rank's brick.
template <class F>
void forImages(const particles::ParticleSystem& system, const Vec3& x, double reach, F&& f) {
    const Periodicity& periodicity = system.periodicity();
    const particles::Brick& brick = system.decomposition().own();
    const Vec3 inside = periodicity.wrap(x);
    int images[3];
    const auto most = [&](int k) { return periodicity.slides() && k != periodicity.slidingAxis() ? 2 : 1; };
    for (int k = 0; k < 3; ++k) images[k] = periodicity.isAlong(k) ? most(k) : 0;
    for (int a = -images[0]; a <= images[0]; ++a)
        for (int b = -images[1]; b <= images[1]; ++b)
            for (int c = -images[2]; c <= images[2]; ++c) {
                const Vec3 image = inside + periodicity.image({a, b, c}).shift;
                if (particles::distanceSquared(image, brick.low, brick.high) < reach * reach) f(image);
            }
}

}  // namespace corpuscle::coupling
