// Family of walls: which surfaces bound the fluid, from `walls` in constant/flow.yaml. What they do to the flow, moving
// or at rest, is up to the flow (sph/flow.hpp).
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
    static constexpr const char* usualModel = "planes";  // of a table that does not say `type`
    virtual ~WallShape() = default;

    // Whether they end the fluid along this axis (0, 1, 2), so that the box is not periodic along it.
    virtual bool isAcross(int axis) const = 0;
    // The axis that they are normal to, where they are two parallel planes at the ends of the box.
    virtual std::optional<int> planesAcross() const { return {}; }

    // The walls of a fluid in this box, at rest.
    virtual Walls place(const particles::Box& fluid) const = 0;
    // Of the fluid between them, and of the layers behind them, as deep as this along each axis [m^3].
    virtual double volume(const particles::Box& fluid) const = 0;
    virtual double volumeBehind(const particles::Box& fluid, const Vec3& depth) const = 0;
};

}  // namespace corpuscle::boundary
