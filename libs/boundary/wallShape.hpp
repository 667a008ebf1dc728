// Family of walls: the surfaces that bound the fluid, from `walls` in constant/flow.yaml. Their velocities are set by
// the flow (sph/flow.hpp).
#pragma once
#include <array>
#include <optional>

#include "boundary/walls.hpp"
#include "core/registry.hpp"
#include "particles/box.hpp"

namespace corpuscle::boundary {

class WallShape {
  public:
    static constexpr const char* familyName = "walls";
    static constexpr const char* usualModel = "planes";  // model of a table without `type`
    virtual ~WallShape() = default;

    // Whether the walls end the fluid along this axis (0, 1, 2), so that the box is not periodic along it.
    virtual bool isAcross(int axis) const = 0;
    // The normal axis of walls that are two parallel planes at the ends of the box; empty for other walls.
    virtual std::optional<int> planesAcross() const { return {}; }

    // The walls of a fluid in this box, at rest.
    virtual Walls place(const particles::Box& fluid) const = 0;
    // Volume of the fluid between the walls; volume of the layers behind them, of this depth along each axis [m^3].
    virtual double volume(const particles::Box& fluid) const = 0;
    virtual double volumeBehind(const particles::Box& fluid, const Vec3& depth) const = 0;
};

}  // namespace corpuscle::boundary
