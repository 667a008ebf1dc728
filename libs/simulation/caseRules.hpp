// Rules that involve several files of a case.
#pragma once
#include "simulation/case.hpp"

namespace corpuscle::simulation {

// A cell or rigid body of system/mesh.yaml.
struct PlacedSurface {
    const SurfaceSettings& settings;
    std::string key, kind;  // "cells[0]", "cell"
};
std::vector<PlacedSurface> surfacesOf(const MeshSettings& mesh);

// Adds a problem for each rule that the case breaks; the problem names the file that most likely has to change.
void checkTogether(const Case& c, Problems& problems);

// Rules for settings that may be edited while the case runs (liveSettings.hpp): those that checkTogether leaves until
// the flow is known, and those of it that these settings can break.
void checkIntervals(const Case& c, Problems& problems);
void checkControl(const Case& c, Problems& problems);

// What a case may do but hardly means, one sentence each, which says what to do: entries of constant/membranes.yaml
// and constant/bodies.yaml that no cell or body uses, so that changes to them have no effect; steps, as written, that
// do not follow a drive.
std::vector<std::string> caseWarnings(const Case& c);

// What a case does otherwise than its settings say, though that does no harm: observers whose interval is shorter than
// the predicted step, which look once in each step only. One sentence each.
std::vector<std::string> caseNotes(const Case& c);

// Values that each lie within their range can combine to a quantity that overflows or underflows. Adds a problem for
// the first such quantity, once the flow is known.
void checkSizes(const Case& c, double shearModulus, Problems& problems);

}  // namespace corpuscle::simulation
