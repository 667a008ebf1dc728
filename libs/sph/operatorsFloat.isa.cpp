#include "sph/operatorKernels.hpp"

namespace corpuscle::sph::CORPUSCLE_ISA_NAMESPACE {

PairKernels::Operators<float> operatorsFloat(KernelKind kernel, ViscosityKind viscosity) {
    return OperatorKernels<float, particles::Precision::mixed>::choose(kernel, viscosity);
}

}  // namespace corpuscle::sph::CORPUSCLE_ISA_NAMESPACE
