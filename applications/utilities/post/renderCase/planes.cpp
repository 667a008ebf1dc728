#include "planes.hpp"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "core/error.hpp"
#include "core/units.hpp"

namespace corpuscle {
namespace {

double meanOfCells(const std::vector<Frame>& frames, const std::optional<particles::Box>& box, int axis) {
    double sum = 0, count = 0;
    for (const Frame& frame : frames) {
        for (const auto& item : frame.surfaces) {
            for (const Vec3& x : item.second.points) sum += x[axis];
            count += static_cast<double>(item.second.points.size());
        }
    }
    const double middle = box ? box->middle()[axis] : 0;
    const double mean = count > 0 ? sum / count : middle;
    // The mean of a mesh's points deviates slightly from the middle of the mesh.
    return box && std::abs(mean - middle) < 0.02 * box->size()[axis] ? middle : mean;
}

// What planes of this option have to meet, in words, and how far it reaches; empty if this is not known.
std::optional<std::pair<std::string, ValueRange>> extentFor(const AskedPlane& asked, const std::vector<Frame>& frames,
                                                            const std::optional<particles::Box>& box) {
    if (box) return {{"the box reaches", {box->low[asked.axis], box->high[asked.axis]}}};
    if (asked.option != "-cut") return std::nullopt;
    ValueRange cells;
    for (const Frame& frame : frames)
        for (const auto& item : frame.surfaces)
            for (const Vec3& x : item.second.points) cells.add(x[asked.axis]);
    return {{"the cells reach", cells}};
}

Plane place(const AskedPlane& asked, double position, const std::vector<Frame>& frames,
            const std::optional<particles::Box>& box) {
    const auto extent = extentFor(asked, frames, box);
    if (extent && !(position >= extent->second.low && position <= extent->second.high))
        throw Failure(ExitCode::usage, fmt::format("{} {}: {} from {} to {}.", asked.option, asked.text, extent->first,
                                                   formatQuantity(extent->second.low, unit::metre),
                                                   formatQuantity(extent->second.high, unit::metre)));
    return {asked.axis, position};
}

Seeds placeSeeds(const AskedPlanes& asked, const std::optional<Plane>& slice, const std::vector<Frame>& frames,
                 const std::optional<particles::Box>& box) {
    const AskedPlane section = asked.seeds.value_or(AskedPlane{"-streamlines", "", 0, {}});
    const bool inSlice = slice && slice->axis == section.axis;
    double position = inSlice ? slice->position : 0;
    if (box && !inSlice) {
        const bool open = box->periodic[static_cast<std::size_t>(section.axis)];
        position = open ? box->low[section.axis] : box->middle()[section.axis];
    }
    Seeds seeds{asked.streamlines, place(section, section.position.value_or(position), frames, box), std::nullopt};
    if (slice && !inSlice) seeds.within = slice;
    return seeds;
}

}  // namespace

AskedPlane parsePlane(const std::string& option, const std::string& text) {
    const std::size_t equals = text.find('=');
    const std::string axis = text.substr(0, equals);
    const auto fail = [&](const std::string& reason) {
        throw Failure(ExitCode::usage, fmt::format("{} {}: {}; an axis, or an axis and a position with a unit, is "
                                                   "expected (like y or 'y=2 um').",
                                                   option, text, reason));
    };
    if (axis != "x" && axis != "y" && axis != "z") fail(fmt::format("'{}' is none of x, y, z", axis));
    AskedPlane plane{option, text, axis[0] - 'x', std::nullopt};
    if (equals == std::string::npos) return plane;
    try {
        const Quantity quantity = parseQuantity(text.substr(equals + 1));
        const bool length = quantity.hasUnit && !quantity.inSpacings && quantity.dimension == unit::metre;
        if (!length && quantity.value != 0) fail(fmt::format("'{}' is no length", text.substr(equals + 1)));
        plane.position = quantity.value;
    } catch (const std::invalid_argument& error) {
        fail(error.what());
    }
    return plane;
}

Planes placePlanes(const AskedPlanes& asked, const std::vector<Frame>& frames,
                   const std::optional<particles::Box>& box) {
    std::optional<AskedPlane> slice = asked.slice, cut = asked.cut;
    if (!slice && asked.fluid) slice = AskedPlane{"-fluid", "", cut ? cut->axis : asked.fluidAxis, {}};
    if (slice && cut && slice->axis == cut->axis) {
        if (!cut->position) cut->position = slice->position;
        if (!slice->position) slice->position = cut->position;
    }
    const auto placed = [&](const std::optional<AskedPlane>& plane) -> std::optional<Plane> {
        if (!plane) return std::nullopt;
        const double position = plane->position ? *plane->position : meanOfCells(frames, box, plane->axis);
        return place(*plane, position, frames, box);
    };
    Planes planes{placed(slice), placed(cut), std::nullopt};
    if (asked.streamlines > 0) planes.seeds = placeSeeds(asked, planes.slice, frames, box);
    return planes;
}

}  // namespace corpuscle
