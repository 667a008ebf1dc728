// The contents of a panel: surfaces, the slice of fluid with its arrows, streamlines, the box and its walls. Lengths
// inside VTK are in micrometres.
#pragma once
#include <vtkPolyData.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include <optional>
#include <string>

#include "boundary/walls.hpp"
#include "camera.hpp"
#include "cut.hpp"
#include "field.hpp"
#include "io/polyData.hpp"
#include "particles/box.hpp"
#include "slice.hpp"
#include "streamlines.hpp"

namespace corpuscle {

// Lengths inside VTK are in micrometres, since its near planes and tolerances suit numbers of order one.
inline constexpr double perMetre = 1e6;

void addLights(vtkRenderer* renderer);

vtkSmartPointer<vtkPolyData> trianglesOf(const io::PolyData& surface);

// How a surface is drawn: coloured by a field, or plain if there is none; `mesh` draws the edges of the triangles. A
// cut surface has a rim of this radius [m].
struct SurfaceStyle {
    std::string field;
    const Scale* scale = nullptr;
    bool mesh = false;
    const Cut* cut = nullptr;
    double rim = 0;
};
void addSurface(vtkRenderer* renderer, const io::PolyData& surface, const std::string& name, const SurfaceStyle& style);

// distances: of its points from the cells, which leave holes in the slice; empty: it is whole.
void addSlice(vtkRenderer* renderer, const Slice& slice, const Scale& scale, const std::vector<double>& distances);

// Arrows of the velocity component in the plane, `lengthPerSpeed` times its magnitude long, on the viewer's side of the
// slice.
void addArrows(vtkRenderer* renderer, const Slice& slice, const Camera& camera, double spacing, double lengthPerSpeed);
double arrowSpacing(const Slice& slice);    // m
double largestSpeedIn(const Slice& slice);  // within the plane [m/s]

// Tubes of this radius [m], coloured by the scale, or plain and dark without one; a cone in the middle of each points
// downstream.
void addStreamlines(vtkRenderer* renderer, const std::vector<DrawnLine>& lines, const Scale* scale, double radius);

// The edges of the box, and a plate at each face that is not periodic. Plates between the eye and the contents of the
// box are transparent; what lies behind the contents is added to `back`.
// withPlates: without them only the edges are drawn.
void addBox(vtkRenderer* back, vtkRenderer* front, const particles::Box& box, const Camera& camera,
            double metresPerPixel, bool withPlates, const Cut* cut);
// Walls of any shape: the half that shows its inner side is solid, the half in front of the contents transparent.
void addWalls(vtkRenderer* back, vtkRenderer* front, const particles::Box& box, const boundary::Walls& walls,
              const Cut* cut, double rim);
double wallThickness(const particles::Box& box);

}  // namespace corpuscle
