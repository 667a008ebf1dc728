#include "sph/fluidKernels.hpp"

namespace corpuscle::sph::CORPUSCLE_ISA_NAMESPACE {

PairKernels::Fluid<float> fluidFloat(FluidVariant variant, bool atWall) {
    return FluidKernels<float, particles::Precision::mixed>::choose(variant, atWall);
}

}  // namespace corpuscle::sph::CORPUSCLE_ISA_NAMESPACE
