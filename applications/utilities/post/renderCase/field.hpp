// An array of the results as it is shown: its numbers, title, unit and colours.
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

// How an array is named and coloured, whatever its numbers.
struct FieldStyle {
    // signedOrNot: about zero where numbers have both signs, else sequential from zero.
    enum class Colours { sequential, aboutZero, signedOrNot, kinds } colours = Colours::sequential;
    std::string title;
    Dimension dimension;                  // of the numbers, SI
    bool percent = false;                 // a ratio that is shown in per cent
    std::vector<std::string> names = {};  // of kinds 0, 1, ...; empty: "none", "1", "2", ...
};
FieldStyle styleOf(const std::string& field);

// One number for each triangle or point of a surface.
struct Values {
    std::vector<double> numbers;
    bool ofCells = false;
};
// Vectors by their magnitude, integers as numbers. Of kinds always one number for each triangle, the largest of its
// corners. Throws Failure(usage) naming the arrays that the surface has and the nearest name.
Values valuesOf(const io::PolyData& surface, const std::string& name, const std::string& field);

// A field with its range, ready to be drawn and explained by a bar.
struct Scale {
    FieldStyle style;
    ValueRange range;                         // SI
    double perUnit = 1;                       // the bar's numbers are SI divided by this
    std::string title;                        // with the unit: "tension T1, uN/m"
    vtkSmartPointer<vtkLookupTable> colours;  // by SI values
};
// The range found, or the one asked for.
Scale makeScale(const FieldStyle& style, ValueRange found, const std::optional<ValueRange>& asked);

// "-5,5", "0,20 uN/m": SI where no unit is given. Throws Failure(usage).
ValueRange parseRange(const std::string& option, const std::string& text);

}  // namespace corpuscle
