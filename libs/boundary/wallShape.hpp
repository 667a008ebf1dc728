// Family of walls: the surfaces that bound the fluid, from `walls` in constant/flow.yaml. Their velocities are set by
// the flow (sph/flow.hpp).
#pragma once
#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "boundary/walls.hpp"
#include "core/registry.hpp"
#include "particles/box.hpp"

namespace corpuscle::boundary {

// The steady creeping flow along x that a force f per mass drives between walls, in a fluid of viscosity nu = mu/rho.
struct Hydraulics {
    double width = 0;    // over which the velocity changes: the gap of planes, the least radius of a tube [m]
    double fastest = 0;  // largest velocity nu/f [m^2]; an estimate where the flow has no closed form
    // Time in which the flow settles by a factor e, times nu [m^2]; an estimate for surfaces from files.
    double settling = 0;
    std::optional<double> conductance;  // flow rate nu/f [m^4]; empty where it has no closed form
};

class WallShape {
  public:
    static constexpr const char* familyName = "walls";
    static constexpr const char* usualModel = "planes";  // model of a table without `type`
    virtual ~WallShape() = default;

    // Reads what the walls need before they are placed; paths are relative to the case. Throws Failure.
    virtual void prepare(const std::filesystem::path& /*caseDirectory*/) const {}
    // What `prepare` changed in what it read, in whole sentences.
    virtual std::vector<std::string> remarks() const { return {}; }
    // Adds a problem for each key of `walls` that does not fit the box of the fluid.
    virtual void check(const particles::Box& /*fluid*/, const Mark& /*mark*/, Problems& /*problems*/) const {}

    // Whether the walls end the fluid along this axis (0, 1, 2), so that the box is not periodic along it.
    virtual bool isAcross(int axis) const = 0;
    // The normal axis of walls that are two parallel planes at the ends of the box; empty for other walls.
    virtual std::optional<int> planesAcross() const { return {}; }

    // Whether all cross-sections are the same, so that a developed flow is one along x alone.
    virtual bool isStraight() const { return true; }

    // The walls of a fluid in this box, at rest.
    virtual Walls place(const particles::Box& fluid) const = 0;
    // Volume of the fluid between the walls; volume of the layers behind them, of this depth along each axis [m^3].
    virtual double volume(const particles::Box& fluid) const = 0;
    virtual double volumeBehind(const particles::Box& fluid, const Vec3& depth) const = 0;
    virtual Hydraulics hydraulics(const particles::Box& fluid) const = 0;
};

// Adds a problem of the key `walls.KEY` if a tube along x that is `width` wide along this axis [m] does not fit.
void checkWidth(const std::string& key, double width, int axis, const particles::Box& fluid, const Mark& mark,
                Problems& problems);

}  // namespace corpuscle::boundary
