// Number of particles i in a block of the neighbour list, which is the number of lanes of the loops over pairs. These
// are plain constants, so that files that are built once per instruction set (isa.hpp) can include them.
#pragma once

namespace corpuscle::particles {

enum class InstructionSet { baseline, avx2, avx512 };

// Of records and pair terms. full: double; mixed: float, with state and sums in double.
enum class Precision { full, mixed };

// As many numbers of the terms as a register holds, eight at most, in the baseline four: of a larger block, a smaller
// share of the pairs in its rows is within the support.
constexpr int blockLanes(InstructionSet set, Precision precision) {
    if (set == InstructionSet::baseline) return 4;
    return set == InstructionSet::avx2 && precision == Precision::full ? 4 : 8;
}

}  // namespace corpuscle::particles
