// Chooses the build of FluidPair for a kernel and for what varies. One file per precision instantiates it: they are the
// longest to compile.
#pragma once
#include "sph/pairBuild.hpp"
#include "sph/pairKernels.hpp"

namespace corpuscle::sph::CORPUSCLE_ISA_NAMESPACE {

template <class Real, particles::Precision precision>
struct FluidKernels {
    static PairKernels::Fluid<Real> choose(FluidVariant variant, bool atWall) {
        return Kernels::visit(variant.kernel, [&]<class Kernel>() { return of<Kernel>(variant, atWall); });
    }

  private:
    template <class Kernel>
    static PairKernels::Fluid<Real> of(FluidVariant v, bool atWall) {
        if (v.bodies)
            return v.varyingViscosity ? of<Kernel, true, true, true>(atWall) : of<Kernel, true, false, true>(atWall);
        if (v.varyingMass)
            return v.varyingViscosity ? of<Kernel, true, true, false>(atWall) : of<Kernel, true, false, false>(atWall);
        return v.varyingViscosity ? of<Kernel, false, true, false>(atWall) : of<Kernel, false, false, false>(atWall);
    }
    template <class Kernel, bool varyingMass, bool varyingViscosity, bool bodies>
    static PairKernels::Fluid<Real> of(bool atWall) {
        return atWall ? build<FluidPair<Kernel, varyingMass, varyingViscosity, bodies, true>>
                      : build<FluidPair<Kernel, varyingMass, varyingViscosity, bodies, false>>;
    }
    template <class Law>
    static constexpr PairKernels::Fluid<Real> build = PairBuild<Law, FluidConstants, Real, precision>::kernel;
};

PairKernels::Fluid<double> fluidDouble(FluidVariant variant, bool atWall);
PairKernels::Fluid<float> fluidFloat(FluidVariant variant, bool atWall);

}  // namespace corpuscle::sph::CORPUSCLE_ISA_NAMESPACE
