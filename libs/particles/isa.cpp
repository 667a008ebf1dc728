#include "particles/isa.hpp"

#include <algorithm>
#include <cstdlib>

#include "core/error.hpp"

namespace corpuscle::particles {

namespace {
InstructionSet ofProcessor() {
#ifdef CORPUSCLE_X86
    __builtin_cpu_init();
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl"))
        return InstructionSet::avx512;
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return InstructionSet::avx2;
#endif
    return InstructionSet::baseline;
}

InstructionSet wanted() {
    const char* text = std::getenv("CORPUSCLE_ISA");
    if (!text || !*text) return InstructionSet::avx512;
    const std::string word = text;
    if (word == "baseline") return InstructionSet::baseline;
    if (word == "avx2") return InstructionSet::avx2;
    if (word == "avx512") return InstructionSet::avx512;
    throw Failure(ExitCode::usage, "environment variable CORPUSCLE_ISA: found '" + word +
                                       "', allowed are baseline, avx2, avx512." +
                                       didYouMean(word, {"baseline", "avx2", "avx512"}));
}
}  // namespace

InstructionSet instructionSet() {
    static const InstructionSet chosen = std::min(ofProcessor(), wanted());
    return chosen;
}

std::string instructionSetName() {
    switch (instructionSet()) {
        case InstructionSet::avx512:
            return "avx512";
        case InstructionSet::avx2:
            return "avx2";
        default:
            return "baseline";
    }
}

}  // namespace corpuscle::particles
