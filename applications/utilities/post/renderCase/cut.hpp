// A cutaway: what lies in front of a plane is removed from cells, bodies and walls, so that their inside is seen.
#pragma once
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <map>
#include <string>
#include <vector>

#include "camera.hpp"
#include "io/polyData.hpp"
#include "plane.hpp"
#include "slice.hpp"

namespace corpuscle {

struct Cut {
    Plane plane;
    bool removesUpper = false;  // what lies above the plane along its axis; otherwise what lies below
};
// Removes the half that faces the camera. Throws Failure(usage) if the plane is seen edge-on.
Cut cutFor(const Plane& plane, const Camera& camera);

// Of surfaces in the units of pictures (perMetre of actors.hpp).
vtkSmartPointer<vtkPolyData> remainder(vtkPolyData* surface, const Cut& cut);
vtkSmartPointer<vtkPolyData> rimOf(vtkPolyData* surface, const Plane& plane);  // lines in which the plane meets it

// For each point of the slice, the distance from these closed surfaces, negative inside [m].
std::vector<double> distancesFrom(const std::map<std::string, io::PolyData>& surfaces, const Slice& slice);

}  // namespace corpuscle
