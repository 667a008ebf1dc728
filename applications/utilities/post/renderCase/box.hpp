// The box of a case, as its last run had it (used.yaml) or, before any run, as system/mesh.yaml has it.
#pragma once
#include <optional>

#include "core/application.hpp"
#include "particles/box.hpp"

namespace corpuscle {

// Empty for a case without a box (membraneRelax), and, with a warning, where its dictionary cannot be read.
std::optional<particles::Box> readBox(Application& app, bool hasRun);

}  // namespace corpuscle
