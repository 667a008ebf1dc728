// Fuzz target, a .vtp file.
#include "core/error.hpp"
#include "io/vtpFile.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    try {
        corpuscle::io::parseVtp({reinterpret_cast<const char*>(data), size}, "a.vtp");
    } catch (const corpuscle::Failure&) {
    }
    return 0;
}
