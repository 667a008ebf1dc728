#include "sph/lucy.hpp"
#include "sph/pairKernels.hpp"
#include "sph/quintic.hpp"
#include "sph/wendlandC2.hpp"

namespace corpuscle::sph::CORPUSCLE_ISA_NAMESPACE {

namespace {

using Tag = CORPUSCLE_ISA_TAG;

template <class Kernel, bool varyingMass, bool varyingViscosity, bool atWall>
void fluidLoop(const FluidConstants& constants, const particles::PairView& list, const int* blocks, int blockCount,
               const double* records, double* const* results) {
    particles::pairLoop<Tag>(FluidPair<Kernel, varyingMass, varyingViscosity, atWall>{constants}, list, blocks, blockCount, records,
                             results);
}

template <class Kernel>
void disorderLoop(const DisorderConstants& constants, const particles::PairView& list, const int* blocks, int blockCount,
                  const double* records, double* const* results) {
    particles::pairLoop<Tag>(DisorderPair<Kernel>{constants}, list, blocks, blockCount, records, results);
}

template <class Kernel>
PairKernels::Fluid fluidOf(FluidVariant v, bool atWall) {
    static constexpr PairKernels::Fluid table[2][2][2] = {
        {{fluidLoop<Kernel, false, false, false>, fluidLoop<Kernel, false, false, true>},
         {fluidLoop<Kernel, false, true, false>, fluidLoop<Kernel, false, true, true>}},
        {{fluidLoop<Kernel, true, false, false>, fluidLoop<Kernel, true, false, true>},
         {fluidLoop<Kernel, true, true, false>, fluidLoop<Kernel, true, true, true>}}};
    return table[v.varyingMass][v.varyingViscosity][atWall];
}

PairKernels::Fluid fluid(FluidVariant variant, bool atWall) {
    switch (variant.kernel) {
        case KernelKind::lucy: return fluidOf<Lucy>(variant, atWall);
        case KernelKind::quintic: return fluidOf<Quintic>(variant, atWall);
        default: return fluidOf<WendlandC2>(variant, atWall);
    }
}

PairKernels::Disorder disorder(KernelKind kernel) {
    switch (kernel) {
        case KernelKind::lucy: return disorderLoop<Lucy>;
        case KernelKind::quintic: return disorderLoop<Quintic>;
        default: return disorderLoop<WendlandC2>;
    }
}

}  // namespace

extern const PairKernels kernels;
const PairKernels kernels{&fluid, &disorder};

}  // namespace corpuscle::sph::CORPUSCLE_ISA_NAMESPACE
