#include "packing/alignedOrientation.hpp"

namespace corpuscle::packing {

const Schema<AlignedOrientation>& AlignedOrientation::schema() {
    static const Schema<AlignedOrientation> s =
        Schema<AlignedOrientation>("aligned", "all axes along one direction")
            .vector("axis", &AlignedOrientation::axis, unit::none, "direction of the symmetry axes",
                    {.fallback = "[0, 0, 1]"})
            .check([](const AlignedOrientation& aligned, const Node& node, Problems& problems) {
                if (const Node* axis = node.find("axis"); axis && aligned.axis.norm() == 0)
                    problems.add(axis->mark, axis->path,
                                 "found the zero vector; a direction is needed, such as [0, 0, 1]");
            });
    return s;
}

CORPUSCLE_REGISTER(Orientation, AlignedOrientation, "aligned", "all axes along one direction, which they keep");

}  // namespace corpuscle::packing
