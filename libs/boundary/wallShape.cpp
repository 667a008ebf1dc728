#include "boundary/wallShape.hpp"

#include <fmt/format.h>

#include "core/units.hpp"

namespace corpuscle::boundary {

void checkWidth(const std::string& key, double width, int axis, const particles::Box& fluid, const Mark& mark,
                Problems& problems) {
    const double room = fluid.size()[axis];
    if (width <= room * (1 + 1e-9)) return;
    problems.add(mark, "walls." + key,
                 fmt::format("found walls {} wide along {}, but the box of system/mesh.yaml has {} there; make the box "
                             "at least as large, or the walls narrower",
                             formatQuantity(width, unit::metre), "xyz"[axis], formatQuantity(room, unit::metre)));
}

}  // namespace corpuscle::boundary
