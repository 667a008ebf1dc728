// Which build of the hot loops runs on this processor.
//
// A file of hot loops is compiled once for each of three instruction sets (cmake: corpuscle_isa_sources), with
// CORPUSCLE_ISA_NAMESPACE and CORPUSCLE_ISA_TAG set. Its functions lie in that namespace, and it exports a table of
// pointers to them. Such a file includes nothing but simd.hpp, laws and plain data: the linker must not replace the
// baseline version of a standard-library template by one that was instantiated with AVX-512.
#pragma once
#include <string>

#include "particles/lanes.hpp"

namespace corpuscle::particles {

// The best that the processor supports; the environment variable CORPUSCLE_ISA (baseline, avx2, avx512) lowers it.
InstructionSet instructionSet();
std::string instructionSetName();

// Particles per block in the builds chosen for this processor.
inline int blockLanes(Precision precision) { return blockLanes(instructionSet(), precision); }

}  // namespace corpuscle::particles
