// The inner loop of the list build, one build per instruction set: finds the candidates that lie within reach of at
// least one particle of a block.
//
// The loop computes in single precision, with positions relative to the middle of the brick; the caller widens the
// reach by the rounding error. Near candidates lie within the support at present, far ones only within the skin.
#pragma once
#include "particles/isa.hpp"

namespace corpuscle::particles {

struct ListKernel {
    // particles that share their candidates: two blocks of four particles or one of eight
    static constexpr int points = 8;
    static constexpr int padding = 16;  // entries that may be read past the end of x, y, z and written past that of out

    // For each candidate c in [begin, end), writes offset + c to *out[2h] if the squared distance to any point of block
    // h is below near2, else to *out[2h + 1] if it is below reach2, and advances that pointer. point: x of all eight
    // points, then y, then z.
    using Gather = void (*)(const float* point, const float* x, const float* y, const float* z, int begin, int end,
                            int offset, float near2, float reach2, int* out[]);
    Gather twoBlocks, oneBlock;
};

const ListKernel& listKernel();

}  // namespace corpuscle::particles
