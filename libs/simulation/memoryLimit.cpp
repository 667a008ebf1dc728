#include "simulation/memoryLimit.hpp"

#include "core/machineMemory.hpp"
#include "simulation/size.hpp"

namespace corpuscle::simulation {

void requireMemory(const Communicator& communicator, const Case& input) {
    const std::string shortage = memoryShortage(communicator, estimateSize(input, communicator.size()).memory);
    if (shortage.empty()) return;
    Problems problems;
    problems.add(
        {"system/numerics.yaml", 0, 0}, "spacing",
        shortage + fmt::format(". {} particles are too many for it: take a larger spacing, a smaller domain.size in "
                               "system/mesh.yaml, more machines, or raise the limit",
                               countText(estimateParticles(input).all())));
    input.throwIfAny(problems);
}

}  // namespace corpuscle::simulation
