// The inner loop of the list build, one build per instruction set: which candidates lie within reach of any of a block of particles.
//
// It works in single precision on positions relative to the middle of the brick: the caller widens reach by the rounding error.
#pragma once
#include "particles/isa.hpp"

namespace corpuscle::particles {

struct ListKernel {
    static constexpr int padding = 16;  // entries that may be read behind x, y, z and written behind out

    // Appends offset + c to `out` for those candidates c in [begin, end) whose squared distance to any of the block's points
    // (x, y, z of blockLanes() of them, one after another) is below reach2. Returns how many.
    int (*gather)(const float* block, const float* x, const float* y, const float* z, int begin, int end, int offset,
                  float reach2, int* out);
};

const ListKernel& listKernel();

}  // namespace corpuscle::particles
