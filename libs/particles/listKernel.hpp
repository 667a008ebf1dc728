// The inner loop of the list build, one build per instruction set: which candidates lie within reach of any of a block of particles.
#pragma once
#include "particles/isa.hpp"

namespace corpuscle::particles {

struct ListKernel {
    // Appends to `out` those of the candidates [begin, end) whose squared distance to any of the block's points at
    // blockX, blockY, blockZ is below reach2; candidates with skip[c] != 0 are left out when skip is given. Returns how many.
    int (*gather)(const double* blockX, const double* blockY, const double* blockZ, const double* x, const double* y,
                  const double* z, int begin, int end, double reach2, const unsigned char* skip, int* out);
};

const ListKernel& listKernel();

}  // namespace corpuscle::particles
