#include "particles/listKernel.hpp"

namespace corpuscle::particles {

namespace baseline {
extern const ListKernel kernel;
}
#ifdef CORPUSCLE_X86
namespace avx2 {
extern const ListKernel kernel;
}
namespace avx512 {
extern const ListKernel kernel;
}
#endif

const ListKernel& listKernel() {
#ifdef CORPUSCLE_X86
    if (instructionSet() == InstructionSet::avx512) return avx512::kernel;
    if (instructionSet() == InstructionSet::avx2) return avx2::kernel;
#endif
    return baseline::kernel;
}

}  // namespace corpuscle::particles
