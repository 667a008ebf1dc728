#include "sph/pairKernels.hpp"
#include "sph/lucy.hpp"
#include "sph/quintic.hpp"
#include "sph/wendlandC2.hpp"

namespace corpuscle::sph::CORPUSCLE_ISA_NAMESPACE {

namespace {

using particles::PairView;

template <class Law, class Constants, class Real>
struct Build {
    using Loop = particles::PairLoop<CORPUSCLE_ISA_TAG, Law, Real>;
    static void run(const Constants& c, const PairView& list, const int* blocks, int blockCount, const Real* records,
                    double* sums) {
        Loop::run(Law{c}, list, blocks, blockCount, records, sums);
    }
    static void finish(const Constants& c, int owned, const Real* records, const double* sums, double* const* results) {
        Loop::finish(Law{c}, owned, records, sums, results);
    }
    static constexpr particles::PairKernel<Constants, Real> kernel{&run, &finish};
};

template <class Real, class Kernel, bool varyingMass, bool varyingViscosity>
PairKernels::Fluid<Real> fluidOf(bool atWall) {
    return atWall ? Build<FluidPair<Kernel, varyingMass, varyingViscosity, true>, FluidConstants, Real>::kernel
                  : Build<FluidPair<Kernel, varyingMass, varyingViscosity, false>, FluidConstants, Real>::kernel;
}

template <class Real, class Kernel>
PairKernels::Fluid<Real> fluidOf(FluidVariant v, bool atWall) {
    if (v.varyingMass)
        return v.varyingViscosity ? fluidOf<Real, Kernel, true, true>(atWall)
                                  : fluidOf<Real, Kernel, true, false>(atWall);
    return v.varyingViscosity ? fluidOf<Real, Kernel, false, true>(atWall)
                              : fluidOf<Real, Kernel, false, false>(atWall);
}

template <class Real>
PairKernels::Fluid<Real> fluid(FluidVariant variant, bool atWall) {
    switch (variant.kernel) {
        case KernelKind::lucy:
            return fluidOf<Real, Lucy>(variant, atWall);
        case KernelKind::quintic:
            return fluidOf<Real, Quintic>(variant, atWall);
        default:
            return fluidOf<Real, WendlandC2>(variant, atWall);
    }
}

PairKernels::Disorder disorder(KernelKind kernel) {
    switch (kernel) {
        case KernelKind::lucy:
            return Build<DisorderPair<Lucy>, DisorderConstants, double>::kernel;
        case KernelKind::quintic:
            return Build<DisorderPair<Quintic>, DisorderConstants, double>::kernel;
        default:
            return Build<DisorderPair<WendlandC2>, DisorderConstants, double>::kernel;
    }
}

}  // namespace

extern const PairKernels kernels;
const PairKernels kernels{&fluid<double>, &fluid<float>, &disorder};

}  // namespace corpuscle::sph::CORPUSCLE_ISA_NAMESPACE
