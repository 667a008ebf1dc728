// The table of pair loops of this library, one build per instruction set: kernel and what varies are chosen here, once.
#pragma once
#include "particles/pairLoop.hpp"
#include "sph/disorderPair.hpp"
#include "sph/fluidPair.hpp"

namespace corpuscle::sph {

enum class KernelKind { lucy, wendlandC2, quintic };

struct FluidVariant {
    KernelKind kernel = KernelKind::wendlandC2;
    bool varyingMass = false, varyingViscosity = false;
    int fields() const { return 8 + (varyingMass ? 1 : 0) + (varyingViscosity ? 1 : 0); }
};

struct PairKernels {
    // results: ax, ay, az, drho/dt
    using Fluid = void (*)(const FluidConstants&, const particles::PairView&, const int* blocks, int blockCount,
                           const double* records, double* const* results);
    // results: Cx, Cy, Cz, sigma
    using Disorder = void (*)(const DisorderConstants&, const particles::PairView&, const int* blocks, int blockCount,
                              const double* records, double* const* results);
    Fluid (*fluid)(FluidVariant, bool atWall);
    Disorder (*disorder)(KernelKind);
};

const PairKernels& pairKernels();

}  // namespace corpuscle::sph
