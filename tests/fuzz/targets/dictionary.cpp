// Fuzz target, a dictionary: the first byte chooses the settings that are read from it.
#include "core/dictionary.hpp"
#include "core/error.hpp"
#include "simulation/case.hpp"

namespace {

using namespace corpuscle;

template <class T>
void readAs(const Node& node, Problems& problems) {
    const T settings = read<T>(node, problems);
    if (problems.empty()) write(settings);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size == 0) return -1;
    const std::string text(reinterpret_cast<const char*>(data) + 1, size - 1);
    Problems problems;
    try {
        const Node node = parseDictionary(text, "a.yaml", problems);
        problems.throwIfAny();
        switch (data[0] % 8) {
            case 0:
                readAs<simulation::ControlSettings>(node, problems);
                break;
            case 1:
                readAs<simulation::NumericsSettings>(node, problems);
                break;
            case 2:
                readAs<simulation::MeshSettings>(node, problems);
                break;
            case 3:
                readAs<simulation::FluidSettings>(node, problems);
                break;
            case 4:
                readAs<simulation::MembranesSettings>(node, problems);
                break;
            case 5:
                readAs<bodies::BodiesSettings>(node, problems);
                break;
            case 6:
                readAs<observers::ObserversSettings>(node, problems);
                break;
            default:
                readChoice<sph::Flow>(node, problems);
        }
        problems.throwIfAny();
    } catch (const Failure&) {
    }
    return 0;
}
