// Checksum of the data in a .vtp file, not of its bytes: points, triangles or lines, arrays with their names, field
// data.
//
//     h := mix(h + S(name)),   h := mix(h + S(values)) + number of values      for each part, in this order:
//     "points", "triangles", "lines", "<point|cell> <scalar|vector|integer> NAME" (each sorted by name), "field NAME",
//         "text NAME"
//
// S is the checksum of io/checksum.hpp; for a name or a text it is taken over the bytes, for a line over its number of
// points and then these points. Data that VTK reads from a damaged file are therefore either exactly what was written,
// or the damage is detected, however the file is compressed.
#pragma once
#include <string>

#include "io/polyData.hpp"

namespace corpuscle::io {

inline constexpr const char* checksumText = "checksum";  // name of the text that holds it, itself left out

// 16 hexadecimal digits. The second form is for a file that has `field` as its field data.
std::string dataChecksum(const PolyData& data);
std::string dataChecksum(const PolyData& data, const std::map<std::string, double>& field);

}  // namespace corpuscle::io
