// Chooses the builds of the pair laws of operators.hpp for a kernel and a kind of viscosity. One file per precision
// instantiates them.
#pragma once
#include "sph/gradientPair.hpp"
#include "sph/pairBuild.hpp"
#include "sph/pairKernels.hpp"
#include "sph/ratePair.hpp"
#include "sph/stressPair.hpp"

namespace corpuscle::sph::CORPUSCLE_ISA_NAMESPACE {

template <class Real, particles::Precision precision>
struct OperatorKernels {
    static PairKernels::Operators<Real> choose(KernelKind kernel, ViscosityKind viscosity) {
        return Kernels::visit(kernel, [&]<class Kernel>() { return of<Kernel>(viscosity); });
    }

  private:
    template <class Kernel>
    static PairKernels::Operators<Real> of(ViscosityKind viscosity) {
        switch (viscosity) {
            case ViscosityKind::sides:
                return of<Kernel, GradientPair<Kernel, false, false>, GradientPair<Kernel, false, true>, false>();
            case ViscosityKind::layers:
                return of<Kernel, GradientPair<Kernel, true, false>, GradientPair<Kernel, true, true>, false>();
            case ViscosityKind::uniform:
                return of<Kernel, RatePair<Kernel, false>, RatePair<Kernel, true>, true>();
        }
        throw std::logic_error("there is no such kind of viscosity");
    }
    template <class Kernel, class Rates, class RatesAtWall, bool symmetricStress>
    static PairKernels::Operators<Real> of() {
        return {build<MomentPair<Kernel>, MomentConstants>, build<Rates, NoSlip>, build<RatesAtWall, NoSlip>,
                build<StressPair<Kernel, symmetricStress, false>, NoSlip>,
                build<StressPair<Kernel, symmetricStress, true>, NoSlip>};
    }
    template <class Law, class Constants>
    static constexpr particles::PairKernel<Constants, Real> build = PairBuild<Law, Constants, Real, precision>::kernel;
};

PairKernels::Operators<double> operatorsDouble(KernelKind kernel, ViscosityKind viscosity);
PairKernels::Operators<float> operatorsFloat(KernelKind kernel, ViscosityKind viscosity);

}  // namespace corpuscle::sph::CORPUSCLE_ISA_NAMESPACE
