// Panels side by side, one per time, all with the same scale and colours; a scale bar in the first, colour bars at the
// right.
#pragma once
#include <Eigen/Geometry>
#include <filesystem>
#include <string>
#include <vector>

#include "frames.hpp"

namespace corpuscle {

struct View {
    std::string name;
    Vec3 right, up;  // unit vectors of the picture; the eye looks along up x right
    Vec3 slab;       // normal of the plane in which fluid is shown
    Vec3 ahead() const { return up.cross(right); }
};
const std::vector<View>& views();  // xz (the shear plane), xy, yz, iso

struct PictureOptions {
    View view;
    std::string field = "none";  // of the triangles or points: areaStrain, tension1, ...; none: plain
    int width = 1600;            // pixels
    int height = 0;              // 0: from what is shown
};

struct Panel {
    int x, y, width, height;  // pixels from the top left of the picture
};

struct Picture {
    int width = 0, height = 0;
    double metresPerPixel = 0;
    std::vector<Panel> panels;
};

// Draws the frames and writes the PNG. Throws Failure: usage for an unknown field (naming those there are), io for the
// file.
Picture drawPicture(const std::vector<Frame>& frames, const PictureOptions& options,
                    const std::filesystem::path& output);

}  // namespace corpuscle
