// Checksum of what a .vtp file says, not of its bytes: points, triangles or lines, arrays with their names, field data.
//
//     h := mix(h + S(name)),   h := mix(h + S(values)) + number of values      for each part, in this order:
//     "points", "triangles", "lines", "<point|cell> <scalar|vector|integer> NAME" (each sorted by name), "field NAME",
//         "text NAME"
//
// S is the checksum of io/checksum.hpp: of a name and a text over its bytes, of a line its length and then its points.
// What VTK makes of a damaged file is therefore either exactly what was written or found out, however the file is
// compressed.
#pragma once
#include <string>

#include "io/polyData.hpp"

namespace corpuscle::io {

inline constexpr const char* checksumText = "checksum";  // the name among the texts, itself left out

// 16 hexadecimal digits. The second form is that of a file with other numbers in its field data.
std::string dataChecksum(const PolyData& data);
std::string dataChecksum(const PolyData& data, const std::map<std::string, double>& field);

}  // namespace corpuscle::io
