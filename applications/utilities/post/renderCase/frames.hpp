// What a picture shows: the surfaces of a case, and perhaps its fluid, at some times.
#pragma once
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "io/polyData.hpp"

namespace corpuscle {

struct Frame {
    double time = 0;                               // s
    std::optional<double> strain;                  // gammadot t, where the results know it
    std::optional<double> stage;                   // of a protocol, the same
    std::map<std::string, io::PolyData> surfaces;  // by membrane; triangles marked `broken` are left out
    std::optional<io::PolyData> fluid;
};

struct FrameChoice {
    std::string membrane;       // empty: all there are
    std::vector<double> times;  // strains (seconds where the results know no strain); empty: `count` equally spaced
    int count = 4;
    bool fluid = false;
};

// Reads results/<membrane>.pvd, or 0/<membrane>.vtp before any run. Throws Failure: usage for times outside the results
// or an unknown membrane, io for unreadable files.
std::vector<Frame> readFrames(const std::filesystem::path& caseDir, const FrameChoice& choice);

}  // namespace corpuscle
