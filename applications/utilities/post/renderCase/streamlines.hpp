// Streamlines of the fluid of a case: seeds in a section of the box, lines through them as they appear in the box.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "boundary/walls.hpp"
#include "io/polyData.hpp"
#include "particles/box.hpp"
#include "plane.hpp"
#include "streamline.hpp"

namespace corpuscle {

struct Seeds {
    int count = 0;
    Plane section;                // across which they are spread evenly, wherever there is fluid
    std::optional<Plane> within;  // only along the line in which the section meets this plane
};

// Spreads `count` seeds over these places of equal share in a section: in rows along its first axis, so that each has
// the same share. Every seed is one of the places.
std::vector<Vec3> spread(std::vector<Vec3> places, const Plane& section, int count);

struct DrawnLine {
    // A part that does not cross a periodic face, inside the box.
    struct Piece {
        std::vector<Vec3> points;
        std::vector<double> values;  // of the field
    };
    Streamline course;
    std::vector<Piece> pieces;
};

// Lines in steps of a quarter of a spacing. They end at walls and at faces across which images slide, since the fluid
// beyond these moves with another velocity. `field` as for Interpolation. Throws Failure(usage) if the fluid has no
// velocity or there is none in the section.
std::vector<DrawnLine> streamlinesOf(const io::PolyData& fluid, const std::optional<particles::Box>& box,
                                     const boundary::Walls& walls, const Seeds& seeds, const std::string& field);

}  // namespace corpuscle
