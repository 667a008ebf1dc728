// The contents of a panel: surfaces, the slice of fluid with its arrows, the box and its walls. Lengths inside VTK are
// in micrometres.
#pragma once
#include <vtkRenderer.h>

#include <optional>
#include <string>

#include "boundary/walls.hpp"
#include "camera.hpp"
#include "field.hpp"
#include "io/polyData.hpp"
#include "particles/box.hpp"
#include "slice.hpp"

namespace corpuscle {

// Lengths inside VTK are in micrometres, since its near planes and tolerances suit numbers of order one.
inline constexpr double perMetre = 1e6;

void addLights(vtkRenderer* renderer);

// The surface is coloured by the field, or plain if there is none; `mesh` draws the edges of the triangles.
void addSurface(vtkRenderer* renderer, const io::PolyData& surface, const std::string& name, const std::string& field,
                const Scale* scale, bool mesh);

void addSlice(vtkRenderer* renderer, const Slice& slice, const Scale& scale);

// Arrows of the velocity component in the plane, `lengthPerSpeed` times its magnitude long, on the viewer's side of the
// slice.
void addArrows(vtkRenderer* renderer, const Slice& slice, const Camera& camera, double spacing, double lengthPerSpeed);
double arrowSpacing(const Slice& slice);    // m
double largestSpeedIn(const Slice& slice);  // within the plane [m/s]

// The edges of the box, and a plate at each face that is not periodic. Plates between the eye and the contents of the
// box are transparent; what lies behind the contents is added to `back`.
// withPlates: without them only the edges are drawn.
void addBox(vtkRenderer* back, vtkRenderer* front, const particles::Box& box, const Camera& camera,
            double metresPerPixel, bool withPlates);
// Walls of any shape: the half that shows its inner side is solid, the half in front of the contents transparent.
void addWalls(vtkRenderer* back, vtkRenderer* front, const particles::Box& box, const boundary::Walls& walls);
double wallThickness(const particles::Box& box);

}  // namespace corpuscle
