// The box of a case: as the last run used it (used.yaml) or, before any run, from system/mesh.yaml. Before any run also
// the places where cells will start.
#pragma once
#include <optional>

#include "core/application.hpp"
#include "frames.hpp"
#include "particles/box.hpp"

namespace corpuscle {

// Empty for a case without a box (membraneRelax); also empty, with a warning, if the dictionary cannot be read.
std::optional<particles::Box> readBox(Application& app, bool hasRun);

// The places of the cells of system/mesh.yaml that have `places` or a `table`. If any of these is invalid, a warning is
// given and no places are returned.
PlacesByName readPlacesOfCells(Application& app);

}  // namespace corpuscle
