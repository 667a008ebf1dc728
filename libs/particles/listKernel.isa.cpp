#include "particles/listKernel.hpp"
#include "particles/simd.hpp"

namespace corpuscle::particles::CORPUSCLE_ISA_NAMESPACE {

namespace {
using V = Simd<CORPUSCLE_ISA_TAG>;

int gather(const double* blockX, const double* blockY, const double* blockZ, const double* x, const double* y, const double* z,
           int begin, int end, double reach2, const unsigned char* skip, int* out) {
    const V bx = V::load(blockX), by = V::load(blockY), bz = V::load(blockZ);
    int count = 0;
    for (int c = begin; c < end; ++c) {
        const V dx = bx - V(x[c]), dy = by - V(y[c]), dz = bz - V(z[c]);
        const V r2 = dx * dx + dy * dy + dz * dz;
        out[count] = c;
        count += anyBelow(r2, reach2) && !(skip && skip[c]);
    }
    return count;
}
}  // namespace

extern const ListKernel kernel;
const ListKernel kernel{&gather};

}  // namespace corpuscle::particles::CORPUSCLE_ISA_NAMESPACE
