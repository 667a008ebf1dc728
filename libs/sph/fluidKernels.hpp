// Chooses the build of FluidPair for a kernel, for varying or uniform mass and viscosity, and for the boundaries. Each
// precision is instantiated in a file of its own, as these take the longest to compile.
#pragma once
#include <stdexcept>

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
        switch (v.boundaries) {
            case Boundaries::none:
                return of<Kernel, Boundaries::none>(v, atWall);
            case Boundaries::walls:
                return of<Kernel, Boundaries::walls>(v, atWall);
            case Boundaries::bodies:
                return v.varyingViscosity ? of<Kernel, true, true, Boundaries::bodies>(atWall)
                                          : of<Kernel, true, false, Boundaries::bodies>(atWall);
        }
        throw std::logic_error("there are no such boundaries");
    }
    template <class Kernel, Boundaries boundaries>
    static PairKernels::Fluid<Real> of(FluidVariant v, bool atWall) {
        if (v.varyingMass)
            return v.varyingViscosity ? of<Kernel, true, true, boundaries>(atWall)
                                      : of<Kernel, true, false, boundaries>(atWall);
        return v.varyingViscosity ? of<Kernel, false, true, boundaries>(atWall)
                                  : of<Kernel, false, false, boundaries>(atWall);
    }
    template <class Kernel, bool varyingMass, bool varyingViscosity, Boundaries boundaries>
    static PairKernels::Fluid<Real> of(bool atWall) {
        constexpr bool canBeAtWall = boundaries != Boundaries::none;
        return atWall ? build<FluidPair<Kernel, varyingMass, varyingViscosity, boundaries, canBeAtWall>>
                      : build<FluidPair<Kernel, varyingMass, varyingViscosity, boundaries, false>>;
    }
    template <class Law>
    static constexpr PairKernels::Fluid<Real> build = PairBuild<Law, FluidConstants, Real, precision>::kernel;
};

PairKernels::Fluid<double> fluidDouble(FluidVariant variant, bool atWall);
PairKernels::Fluid<float> fluidFloat(FluidVariant variant, bool atWall);

}  // namespace corpuscle::sph::CORPUSCLE_ISA_NAMESPACE
