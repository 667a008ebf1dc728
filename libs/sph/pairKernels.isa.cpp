#include "sph/pairKernels.hpp"

#include "sph/fluidKernels.hpp"
#include "sph/operatorKernels.hpp"

namespace corpuscle::sph::CORPUSCLE_ISA_NAMESPACE {

namespace {

using particles::Precision;

// Of double records, by lists of either precision.
template <class Law, class Constants>
particles::PairKernel<Constants> build(Precision precision) {
    return precision == Precision::full ? PairBuild<Law, Constants, double, Precision::full>::kernel
                                        : PairBuild<Law, Constants, double, Precision::mixed>::kernel;
}

template <template <class> class Law, class Constants>
particles::PairKernel<Constants> choose(KernelKind kernel, Precision precision) {
    switch (kernel) {
        case KernelKind::lucy:
            return build<Law<Lucy>, Constants>(precision);
        case KernelKind::quintic:
            return build<Law<Quintic>, Constants>(precision);
        default:
            return build<Law<WendlandC2>, Constants>(precision);
    }
}

}  // namespace

extern const PairKernels kernels;
const PairKernels kernels{
    &fluidDouble,     &fluidFloat,    &choose<DisorderPair, DisorderConstants>, &choose<MeanPair, MeanConstants>,
    &operatorsDouble, &operatorsFloat};

}  // namespace corpuscle::sph::CORPUSCLE_ISA_NAMESPACE
