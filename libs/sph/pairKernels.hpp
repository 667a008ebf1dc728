// The table of this library's pair loops, one build per instruction set. The kernel and the quantities that vary are
// chosen here, once.
#pragma once
#include "particles/pairLoop.hpp"
#include "sph/diffusionPair.hpp"
#include "sph/disorderPair.hpp"
#include "sph/fluidPair.hpp"
#include "sph/kernels.hpp"
#include "sph/meanPair.hpp"
#include "sph/momentPair.hpp"

namespace corpuscle::sph {

// How viscosity varies in operators.hpp.
enum class ViscosityKind { uniform, sides, layers };

struct FluidVariant {
    KernelKind kernel = Kernels::kindOf<WendlandC2>();
    bool varyingMass = false, varyingViscosity = false;
    Boundaries boundaries = Boundaries::none;  // bodies only with varyingMass
    int gap() const { return 8 + (varyingMass ? 1 : 0) + (varyingViscosity ? 1 : 0); }
    int slope() const { return gap() + 1; }
    int fields() const { return gap() + fieldsOf(boundaries); }
};

struct PairKernels {
    template <class Real>
    using Fluid = particles::PairKernel<FluidConstants, Real>;  // results: ax, ay, az, drho/dt
    using Disorder = particles::PairKernel<DisorderConstants>;  // results: Cx, Cy, Cz, sigma
    Fluid<double> (*fluid)(FluidVariant, bool atWall);          // for lists of Precision::full
    Fluid<float> (*fluidFloat)(FluidVariant, bool atWall);      // of Precision::mixed
    Disorder (*disorder)(KernelKind, particles::Precision list);
    using Mean = particles::PairKernel<MeanConstants>;  // results: the mean, then three without meaning
    Mean (*mean)(KernelKind, particles::Precision list);
    using Diffusion = particles::PairKernel<DiffusionConstants>;  // results: the sums of diffusionPair.hpp
    Diffusion (*diffusion)(KernelKind, particles::Precision list);
    // The laws of operators.hpp.
    template <class Real>
    struct Operators {
        particles::PairKernel<MomentConstants, Real> moments;      // results: MomentPair::sums
        particles::PairKernel<NoSlip, Real> rates, ratesAtWall;    // sums only
        particles::PairKernel<NoSlip, Real> stress, stressAtWall;  // sums only
    };
    Operators<double> (*operators)(KernelKind, ViscosityKind);      // Precision::full
    Operators<float> (*operatorsFloat)(KernelKind, ViscosityKind);  // Precision::mixed
};

const PairKernels& pairKernels();

}  // namespace corpuscle::sph
