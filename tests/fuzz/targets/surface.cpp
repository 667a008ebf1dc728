// Fuzz target, a surface file: the first byte chooses the format. What is read must be a valid surface, or its faults
// must be named by the checks.
#include "core/error.hpp"
#include "geometry/readSurface.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size == 0) return -1;
    constexpr const char* endings[] = {".stl", ".off", ".ply", ".vtp"};
    const std::string_view bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
    try {
        const auto surface = corpuscle::geometry::parseSurface(bytes, endings[data[0] % 4], "s");
        corpuscle::geometry::checkClosedManifold(surface.mesh);
    } catch (const corpuscle::Failure&) {
    }
    return 0;
}
