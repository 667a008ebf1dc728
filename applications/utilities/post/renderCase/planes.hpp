// The planes that the user asks for: of the fluid, of the cut and of the seeds of streamlines.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "camera.hpp"
#include "frames.hpp"
#include "particles/box.hpp"
#include "plane.hpp"
#include "streamlines.hpp"

namespace corpuscle {

// "y" or "y=2 um".
struct AskedPlane {
    std::string option, text;  // for messages: "-slice", "y=2 um"
    int axis = 1;
    std::optional<double> position;  // m
};
// Throws Failure(usage).
AskedPlane parsePlane(const std::string& option, const std::string& text);

struct AskedPlanes {
    bool fluid = false;  // a plane of fluid is shown
    int fluidAxis = 1;   // its axis, unless one is given
    std::optional<AskedPlane> slice, cut, seeds;
    int streamlines = 0;
};

struct Planes {
    std::optional<Plane> slice, cut;
    std::optional<Seeds> seeds;
};

// Slice and cut pass through the mean of all cells at all times unless a position is given; along one axis they have
// the same position. Seeds lie in a periodic face across x or, if a plane of fluid is shown, on the line in which this
// face meets it. Throws Failure(usage) for a plane outside the box.
Planes placePlanes(const AskedPlanes& asked, const std::vector<Frame>& frames,
                   const std::optional<particles::Box>& box);

}  // namespace corpuscle
