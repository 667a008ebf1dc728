// What stands in a panel: surfaces, the slice of fluid with its arrows, the box and its walls. Micrometres inside VTK.
#pragma once
#include <vtkRenderer.h>

#include <optional>
#include <string>

#include "camera.hpp"
#include "field.hpp"
#include "io/polyData.hpp"
#include "particles/box.hpp"
#include "slice.hpp"

namespace corpuscle {

// Micrometres inside VTK: its near planes and tolerances are made for numbers around one.
inline constexpr double perMetre = 1e6;

void addLights(vtkRenderer* renderer);

// Coloured by the field, or plain without one; `mesh` draws the edges of the triangles.
void addSurface(vtkRenderer* renderer, const io::PolyData& surface, const std::string& name, const std::string& field,
                const Scale* scale, bool mesh);

void addSlice(vtkRenderer* renderer, const Slice& slice, const Scale& scale);

// Arrows of the velocity within the plane, as long as `lengthPerSpeed` times it, on the eye's side of the slice.
void addArrows(vtkRenderer* renderer, const Slice& slice, const Camera& camera, double spacing, double lengthPerSpeed);
double arrowSpacing(const Slice& slice);    // m
double largestSpeedIn(const Slice& slice);  // within the plane [m/s]

// The edges of the box, and a plate at each face that is not periodic, seen through where it would hide what is inside.
// Those behind everything else go to `back`.
void addBox(vtkRenderer* back, vtkRenderer* front, const particles::Box& box, const Camera& camera,
            double metresPerPixel);
double wallThickness(const particles::Box& box);

}  // namespace corpuscle
