#include "sph/fluidKernels.hpp"

namespace corpuscle::sph::CORPUSCLE_ISA_NAMESPACE {

PairKernels::Fluid<double> fluidDouble(FluidVariant variant, bool atWall) {
    return FluidKernels<double, particles::Precision::full>::choose(variant, atWall);
}

}  // namespace corpuscle::sph::CORPUSCLE_ISA_NAMESPACE
