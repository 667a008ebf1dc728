// How many particles i a block of the neighbour list has: the lanes of the loops over pairs. Plain constants, for files
// that are built once per instruction set too (isa.hpp).
#pragma once

namespace corpuscle::particles {

enum class InstructionSet { baseline, avx2, avx512 };

// Of records and pair terms: double, or float with state and sums in double.
enum class Precision { full, mixed };

// One register of the terms' numbers, eight at most: a block of more particles has fewer pairs within the support in
// its rows.
constexpr int blockLanes(InstructionSet set, Precision precision) {
    if (set == InstructionSet::baseline) return 4;
    return set == InstructionSet::avx2 && precision == Precision::full ? 4 : 8;
}

}  // namespace corpuscle::particles
