// The box of a case, as its last run had it (used.yaml) or, before any run, as system/mesh.yaml has it; before any run
// also where its cells are to stand.
#pragma once
#include <optional>

#include "core/application.hpp"
#include "frames.hpp"
#include "particles/box.hpp"

namespace corpuscle {

// Empty for a case without a box (membraneRelax), and, with a warning, where its dictionary cannot be read.
std::optional<particles::Box> readBox(Application& app, bool hasRun);

// Of the cells of system/mesh.yaml that have `places` or a `table`. What is wrong there is a warning, and no places.
PlacesByName readPlacesOfCells(Application& app);

}  // namespace corpuscle
