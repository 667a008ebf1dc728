#include "sph/pairKernels.hpp"

#include "particles/isa.hpp"

namespace corpuscle::sph {

namespace baseline {
extern const PairKernels kernels;
}
#ifdef CORPUSCLE_X86
namespace avx2 {
extern const PairKernels kernels;
}
namespace avx512 {
extern const PairKernels kernels;
}
#endif

const PairKernels& pairKernels() {
#ifdef CORPUSCLE_X86
    using particles::InstructionSet;
    if (particles::instructionSet() == InstructionSet::avx512) return avx512::kernels;
    if (particles::instructionSet() == InstructionSet::avx2) return avx2::kernels;
#endif
    return baseline::kernels;
}

}  // namespace corpuscle::sph
