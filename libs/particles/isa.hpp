// Which build of the hot loops runs on this processor.
//
// A file of hot loops is compiled three times (cmake: corpuscle_isa_sources) with CORPUSCLE_ISA_NAMESPACE and
// CORPUSCLE_ISA_TAG set; it hides its functions in that namespace and hands out a table of pointers. Such a file
// includes nothing but simd.hpp, laws and plain data: a standard-library template instantiated with AVX-512 must not
// replace its baseline twin at link time.
#pragma once
#include <string>

#include "particles/lanes.hpp"

namespace corpuscle::particles {

// The best of what the processor offers; the environment variable CORPUSCLE_ISA (baseline, avx2, avx512) lowers it.
InstructionSet instructionSet();
std::string instructionSetName();

// Lanes of the builds that run here.
inline int blockLanes(Precision precision) { return blockLanes(instructionSet(), precision); }

}  // namespace corpuscle::particles
