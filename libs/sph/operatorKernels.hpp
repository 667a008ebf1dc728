// Chooses the builds of the laws of operators.hpp for a kernel. One file per precision instantiates them.
#pragma once
#include "sph/gradientPair.hpp"
#include "sph/lucy.hpp"
#include "sph/pairBuild.hpp"
#include "sph/pairKernels.hpp"
#include "sph/quintic.hpp"
#include "sph/ratePair.hpp"
#include "sph/stressPair.hpp"
#include "sph/wendlandC2.hpp"

namespace corpuscle::sph::CORPUSCLE_ISA_NAMESPACE {

template <class Real, particles::Precision precision>
struct OperatorKernels {
    static PairKernels::Operators<Real> choose(KernelKind kernel, bool varyingViscosity) {
        switch (kernel) {
            case KernelKind::lucy:
                return of<Lucy>(varyingViscosity);
            case KernelKind::quintic:
                return of<Quintic>(varyingViscosity);
            default:
                return of<WendlandC2>(varyingViscosity);
        }
    }

  private:
    template <class Kernel>
    static PairKernels::Operators<Real> of(bool varyingViscosity) {
        return varyingViscosity ? of<Kernel, true>() : of<Kernel, false>();
    }
    template <class Kernel, bool varying>
    static PairKernels::Operators<Real> of() {
        return {build<MomentPair<Kernel>, MomentConstants>, rates<Kernel, varying, false>, rates<Kernel, varying, true>,
                build<StressPair<Kernel, !varying, false>, WallPlanes>,
                build<StressPair<Kernel, !varying, true>, WallPlanes>};
    }
    template <class Law, class Constants>
    static constexpr particles::PairKernel<Constants, Real> build = PairBuild<Law, Constants, Real, precision>::kernel;
    template <class Kernel, bool varying, bool atWall>
    static constexpr particles::PairKernel<WallPlanes, Real> rates =
        build<std::conditional_t<varying, GradientPair<Kernel, atWall>, RatePair<Kernel, atWall>>, WallPlanes>;
};

PairKernels::Operators<double> operatorsDouble(KernelKind kernel, bool varyingViscosity);
PairKernels::Operators<float> operatorsFloat(KernelKind kernel, bool varyingViscosity);

}  // namespace corpuscle::sph::CORPUSCLE_ISA_NAMESPACE
