// Panels side by side, one per time, seen by one eye and with the same colours; labels above, a scale bar, the axes and
// an arrow for the velocity below, colour bars at the right.
#pragma once
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "camera.hpp"
#include "field.hpp"
#include "frames.hpp"
#include "overlay.hpp"

namespace corpuscle {

struct PictureOptions {
    View view;
    std::string field = "none";            // of the triangles or points: areaStrain, tension1, ...; none: plain
    std::optional<ValueRange> fieldRange;  // none: that of all frames
    std::string fluidField = "u";          // of the slice
    std::optional<ValueRange> fluidRange;
    bool arrows = false;
    bool frameCells = false;  // as far as the cells reach, without the box
    bool mesh = false;        // edges of the triangles
    bool labelTime = false;   // times even where there is a strain
    int width = 0;            // pixels; 0: by the number of panels
    int height = 0;           // 0: from what is shown
    std::optional<particles::Box> box;
};

// What all panels, and all pictures of a series, have in common.
struct Plan {
    PictureOptions options;
    Camera camera;
    std::optional<Scale> field, fluid;
    double arrowSpacing = 0, largestSpeed = 0;  // m, m/s
    double largestTime = 0;                     // s; sets the unit of the labels
};
// Throws Failure(usage) for an unknown field (naming those there are).
Plan makePlan(const std::vector<Frame>& frames, const PictureOptions& options);

struct Panel {
    int x, y, width, height;  // pixels from the top left of the picture, without its label
};

struct Picture {
    int width = 0, height = 0;
    double metresPerPixel = 0;  // in perspective at the focus of the camera
    std::vector<Panel> panels;
    std::vector<Place> places;  // of words and bars; y from the bottom
};

// Draws the frames and writes the PNG. Throws Failure: usage for a size that is too small, io for the file.
Picture drawPicture(const Plan& plan, std::span<const Frame> frames, const std::filesystem::path& output);

}  // namespace corpuscle
