#include "sph/pairKernels.hpp"

#include "sph/fluidKernels.hpp"
#include "sph/operatorKernels.hpp"

namespace corpuscle::sph::CORPUSCLE_ISA_NAMESPACE {

namespace {

using particles::Precision;

template <class Kernel>
PairKernels::Disorder disorderOf(Precision precision) {
    using Law = DisorderPair<Kernel>;
    return precision == Precision::full ? PairBuild<Law, DisorderConstants, double, Precision::full>::kernel
                                        : PairBuild<Law, DisorderConstants, double, Precision::mixed>::kernel;
}

PairKernels::Disorder disorder(KernelKind kernel, Precision precision) {
    switch (kernel) {
        case KernelKind::lucy:
            return disorderOf<Lucy>(precision);
        case KernelKind::quintic:
            return disorderOf<Quintic>(precision);
        default:
            return disorderOf<WendlandC2>(precision);
    }
}

}  // namespace

extern const PairKernels kernels;
const PairKernels kernels{&fluidDouble, &fluidFloat, &disorder, &operatorsDouble, &operatorsFloat};

}  // namespace corpuscle::sph::CORPUSCLE_ISA_NAMESPACE
