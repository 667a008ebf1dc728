#include "sph/pairKernels.hpp"

#include "sph/fluidKernels.hpp"
#include "sph/operatorKernels.hpp"

namespace corpuscle::sph::CORPUSCLE_ISA_NAMESPACE {

namespace {

using particles::Precision;

// A law with double records, for lists made for either precision.
template <class Law, class Constants>
particles::PairKernel<Constants> build(Precision precision) {
    return precision == Precision::full ? PairBuild<Law, Constants, double, Precision::full>::kernel
                                        : PairBuild<Law, Constants, double, Precision::mixed>::kernel;
}

template <template <class> class Law, class Constants>
particles::PairKernel<Constants> choose(KernelKind kernel, Precision precision) {
    return Kernels::visit(kernel, [&]<class Kernel>() { return build<Law<Kernel>, Constants>(precision); });
}

}  // namespace

extern const PairKernels kernels;
const PairKernels kernels{&fluidDouble,
                          &fluidFloat,
                          &choose<DisorderPair, DisorderConstants>,
                          &choose<MeanPair, MeanConstants>,
                          &choose<DiffusionPair, DiffusionConstants>,
                          &operatorsDouble,
                          &operatorsFloat};

}  // namespace corpuscle::sph::CORPUSCLE_ISA_NAMESPACE
