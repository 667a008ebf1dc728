// Panels side by side, one for each time, with the same camera and colours; labels above; a scale bar, the axes and a
// velocity arrow below; colour bars at the right.
#pragma once
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "boundary/walls.hpp"
#include "camera.hpp"
#include "cut.hpp"
#include "field.hpp"
#include "frames.hpp"
#include "overlay.hpp"

namespace corpuscle {

struct PictureOptions {
    View view;
    std::string field = "none";            // of triangles or points: areaStrain, tension1, ...; none: plain surfaces
    std::optional<ValueRange> fieldRange;  // empty: the range over all frames
    std::string fluidField = "u";          // of the slice and of streamlines
    std::optional<ValueRange> fluidRange;
    bool arrows = false;
    bool frameCells = false;   // the view covers only the cells, not the box
    bool mesh = false;         // edges of the triangles
    bool labelTime = false;    // label with times even if there is a strain
    int width = 0;             // pixels; 0: depends on the number of panels
    int height = 0;            // pixels; 0: depends on what is shown
    std::optional<Plane> cut;  // what lies in front of it is removed
    std::optional<particles::Box> box;
    boundary::Walls walls;  // other than planes
};

// What is common to all panels and to all pictures of a series.
struct Plan {
    PictureOptions options;
    Camera camera;
    std::optional<Cut> cut;
    std::optional<Scale> field, fluid;
    double arrowSpacing = 0, largestSpeed = 0;  // m, m/s
    double largestTime = 0;                     // s; determines the unit of the labels
};
// Throws Failure(usage) for an unknown field, when the message names the existing fields, and for a cut that is seen
// edge-on.
Plan makePlan(const std::vector<Frame>& frames, const PictureOptions& options);

struct Panel {
    int x, y, width, height;  // pixels from the top left of the picture; without its label
};

struct Picture {
    int width = 0, height = 0;
    double metresPerPixel = 0;  // in perspective: at the focus of the camera
    std::vector<Panel> panels;
    std::vector<Place> places;  // of texts and bars; y from the bottom
};

// Draws the frames and writes the PNG file. Throws Failure: usage for a size that is too small, io for a file that
// cannot be written.
Picture drawPicture(const Plan& plan, std::span<const Frame> frames, const std::filesystem::path& output);

}  // namespace corpuscle
