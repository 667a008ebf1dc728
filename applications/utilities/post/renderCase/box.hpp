// The box of a case: as the last run used it (used.yaml) or, before any run, from system/mesh.yaml. Before any run also
// the places where cells will start.
#pragma once
#include <optional>

#include "boundary/walls.hpp"
#include "core/application.hpp"
#include "frames.hpp"
#include "particles/box.hpp"

namespace corpuscle {

// Empty for a case without a box (membraneRelax); also empty, with a warning, if the dictionary cannot be read.
std::optional<particles::Box> readBox(Application& app, bool hasRun);

// The walls of constant/flow.yaml in this box, unless they are planes, which are drawn as faces of the box. None, with
// a warning, if they cannot be read.
boundary::Walls readWalls(Application& app, bool hasRun, const particles::Box& box);

// The places of the cells of system/mesh.yaml that have `places` or a `table`. If any of these is invalid, a warning is
// given and no places are returned.
PlacesByName readPlacesOfCells(Application& app);

}  // namespace corpuscle
