#include "sph/operatorKernels.hpp"

namespace corpuscle::sph::CORPUSCLE_ISA_NAMESPACE {

PairKernels::Operators<double> operatorsDouble(KernelKind kernel, bool varyingViscosity) {
    return OperatorKernels<double, particles::Precision::full>::choose(kernel, varyingViscosity);
}

}  // namespace corpuscle::sph::CORPUSCLE_ISA_NAMESPACE
