#include "sph/operatorKernels.hpp"

namespace corpuscle::sph::CORPUSCLE_ISA_NAMESPACE {

PairKernels::Operators<float> operatorsFloat(KernelKind kernel, bool varyingViscosity) {
    return OperatorKernels<float, particles::Precision::mixed>::choose(kernel, varyingViscosity);
}

}  // namespace corpuscle::sph::CORPUSCLE_ISA_NAMESPACE
