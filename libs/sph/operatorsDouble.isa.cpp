#include "sph/operatorKernels.hpp"

namespace corpuscle::sph::CORPUSCLE_ISA_NAMESPACE {

PairKernels::Operators<double> operatorsDouble(KernelKind kernel, ViscosityKind viscosity) {
    return OperatorKernels<double, particles::Precision::full>::choose(kernel, viscosity);
}

}  // namespace corpuscle::sph::CORPUSCLE_ISA_NAMESPACE
