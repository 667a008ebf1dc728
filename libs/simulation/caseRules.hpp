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

// Entries of constant/membranes.yaml and constant/bodies.yaml that no cell and no body takes: what is changed there has
// no effect. A sentence each, with what to do.
std::vector<std::string> unusedEntries(const Case& c);

// Values that each lie in their range can have a product that does not: adds a problem for what cannot be computed with
// once the flow is known.
void checkSizes(const Case& c, double shearModulus, Problems& problems);

}  // namespace corpuscle::simulation
