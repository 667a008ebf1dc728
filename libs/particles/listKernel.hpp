// The inner loop of the list build, one build per instruction set: which candidates lie within reach of any of a block
// of particles.
//
// It works in single precision on positions relative to the middle of the brick: the caller widens reach by the
// rounding error. Near candidates lie within the support now, far ones only within the skin.
#pragma once
#include "particles/isa.hpp"

namespace corpuscle::particles {

struct ListKernel {
    static constexpr int points = 8;    // that share their candidates: two blocks of four particles or one of eight
    static constexpr int padding = 16;  // entries that may be read behind x, y, z and written behind out

    // Of the candidates c in [begin, end) writes offset + c at out[2h] if the squared distance to any point of block h
    // is below near2, else at out[2h + 1] if it is below reach2, and moves that pointer on. point: x of all eight, then
    // y, then z.
    using Gather = void (*)(const float* point, const float* x, const float* y, const float* z, int begin, int end,
                            int offset, float near2, float reach2, int* out[]);
    Gather twoBlocks, oneBlock;
};

const ListKernel& listKernel();

}  // namespace corpuscle::particles
