#include "sph/flow.hpp"

#include <cmath>

namespace corpuscle::sph {

bool equallyLong(const std::string& flow, const particles::Box& box, const std::string& axes, const Mark& mark,
                 Problems& problems) {
    const Vec3 size = box.size();
    const double first = size[axes[0] - 'x'];
    bool equal = true;
    std::vector<std::string> others, lengths;
    for (const char axis : axes) {
        const double length = size[axis - 'x'];
        equal = equal && std::abs(length - first) <= 1e-9 * first;
        lengths.push_back(formatQuantity(length, unit::metre));
        if (axis != axes[0]) others.emplace_back(1, axis);
    }
    if (!equal)
        problems.add(mark, "type",
                     flow + " needs a box as long along " + axes[0] + " as along " + joinWords(others, " and ") +
                         "; system/mesh.yaml has " + joinWords(lengths));
    return equal;
}

void FlowState::setDrive(const Choice<Drive>& choice) {
    if (!choice || (choice->isSteady() && choice->factor(0) == 1)) return;
    drive = choice.model;
    factor = drive->factor(0);
    speed *= drive->largest(), rate *= drive->largest();
    moveWalls(wallVelocities, factor, walls);
}

void FlowState::moveWalls(const std::vector<Vec3>& velocities, double factor, boundary::Walls& walls) {
    for (std::size_t k = 0; k < velocities.size(); ++k) walls.setVelocity(static_cast<int>(k), factor * velocities[k]);
}

void checkWalls(const boundary::WallShape& walls, bool planes, const Mark& mark, Problems& problems) {
    const std::optional<int> across = walls.planesAcross();
    if (across == 0)
        problems.add(mark, "walls.normal", "found x, but the flow goes along x; allowed are y, z");
    else if (walls.isAcross(0))
        problems.add(mark, "walls", "these walls end the fluid along x, but the flow goes along x");
    else if (planes && !across)
        problems.add(mark, "walls.type", "this flow needs two parallel planes; allowed is planes");
}

const Schema<InertiaSettings>& InertiaSettings::schema() {
    static const Schema<InertiaSettings> s =
        Schema<InertiaSettings>("inertia", "density set by a Reynolds number")
            .quantity("Re", &InertiaSettings::Re, unit::none, "rho gammadot a^2/mu; sets the density",
                      {.range = positive});
    return s;
}

}  // namespace corpuscle::sph
