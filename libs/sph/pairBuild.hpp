// The pair loop of a law, built for the instruction set of the file that includes this header: entries of the table in
// pairKernels.hpp.
#pragma once
#include "particles/pairLoop.hpp"

namespace corpuscle::sph::CORPUSCLE_ISA_NAMESPACE {

template <class Law, class Constants, class Real, particles::Precision precision>
struct PairBuild {
    using Isa = CORPUSCLE_ISA_TAG;
    using Loop = particles::PairLoop<Isa, Law, Real, particles::blockLanes(Isa::set, precision)>;
    static void run(const Constants& c, const particles::PairView& list, const int* blocks, int blockCount,
                    const Real* records, double* sums) {
        Loop::run(Law{c}, list, blocks, blockCount, records, sums);
    }
    static void finish(const Constants& c, int owned, const Real* records, const double* sums, double* const* results) {
        Loop::finish(Law{c}, owned, records, sums, results);
    }
    static constexpr auto finishOrNone() {  // null for laws without `finish`, of which only the sums are used
        using Pointer = decltype(particles::PairKernel<Constants, Real>::finish);
        if constexpr (requires { &Law::template finish<particles::Simd<Isa, double, 4>>; })
            return Pointer(&finish);
        else
            return Pointer(nullptr);
    }
    static constexpr particles::PairKernel<Constants, Real> kernel{&run, finishOrNone()};
};

}  // namespace corpuscle::sph::CORPUSCLE_ISA_NAMESPACE
