// Rules between the files of a case.
#pragma once
#include "simulation/case.hpp"

namespace corpuscle::simulation {

// A cell or rigid body of system/mesh.yaml.
struct PlacedSurface {
    const SurfaceSettings& settings;
    std::string key, kind;  // "cells[0]", "cell"
};
std::vector<PlacedSurface> surfacesOf(const MeshSettings& mesh);

// Adds a problem for each rule that the case breaks; each names the file that most likely has to change.
void checkTogether(const Case& c, Problems& problems);

}  // namespace corpuscle::simulation
