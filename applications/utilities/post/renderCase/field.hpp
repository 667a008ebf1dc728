// An array of the results as shown in a picture: its numbers, title, unit and colours.
#pragma once
#include <vtkLookupTable.h>
#include <vtkSmartPointer.h>

#include <optional>
#include <string>
#include <vector>

#include "camera.hpp"
#include "colourMap.hpp"
#include "core/units.hpp"
#include "io/polyData.hpp"

namespace corpuscle {

// The name and colours of an array, independent of its numbers.
struct FieldStyle {
    // signedOrNot: diverging about zero if the numbers have both signs, otherwise sequential from zero.
    enum class Colours { sequential, aboutZero, signedOrNot, kinds } colours = Colours::sequential;
    std::string title;
    Dimension dimension;                  // of the numbers in SI units
    bool percent = false;                 // a ratio that is shown in per cent
    std::vector<std::string> names = {};  // names of kinds 0, 1, ...; empty: "none", "1", "2", ...
};
FieldStyle styleOf(const std::string& field);

// One number for each triangle or point of a surface.
struct Values {
    std::vector<double> numbers;
    bool ofCells = false;
};
// Vectors are replaced by their magnitude, integers by floating-point numbers. Kinds always have one number for each
// triangle, the largest of its corners. Throws Failure(usage) that names the arrays of the surface and the nearest
// name.
Values valuesOf(const io::PolyData& surface, const std::string& name, const std::string& field);

// A field with its range, ready to be drawn with its colour bar.
struct Scale {
    FieldStyle style;
    ValueRange range;                         // SI
    double perUnit = 1;                       // the numbers of the bar are SI values divided by this
    std::string title;                        // with the unit: "tension T1, uN/m"
    vtkSmartPointer<vtkLookupTable> colours;  // by SI values
};
// The range is the one asked for, otherwise the one found.
Scale makeScale(const FieldStyle& style, ValueRange found, const std::optional<ValueRange>& asked);

// Reads "-5,5" or "0,20 uN/m": the unit applies to both numbers; without a unit they are in SI. Throws Failure(usage).
ValueRange parseRange(const std::string& option, const std::string& text);

}  // namespace corpuscle
