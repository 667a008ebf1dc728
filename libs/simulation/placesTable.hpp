// Places of many cells of one type from a file: `table` of an entry of `cells` in system/mesh.yaml.
//
// file | content
// .csv | a line with the names of the columns, then one line for each cell. x, y and z have a unit as suffix: x_um,
//      | y_um, z_um (or _m, _mm, _nm); axis_x, axis_y, axis_z: direction of the symmetry axis, z if they are missing;
//      | scale: size relative to that of the shape, 1 if it is missing. Lines that begin with # are ignored
// .vtp | points [m], optionally with the point arrays `axis` (vectors) and `scale`
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "geometry/place.hpp"

namespace corpuscle::simulation {

// Reads the places of a file. Adds a problem for each error, with its line and column in the file. mark, key: of the
// setting that names the file, for problems of the file as a whole.
std::vector<geometry::Place> readPlaces(const std::filesystem::path& caseDirectory, const std::string& file,
                                        const Mark& mark, const std::string& key, Problems& problems);

// Writes a file in the format of its ending, .csv or .vtp; reading it gives the same places to eleven digits.
void writePlaces(const std::filesystem::path& path, const std::vector<geometry::Place>& places);

// "16 places, checksum 8c1f0a2b9d3e4f50"; places that agree to ten digits give the same text.
std::string describePlaces(const std::vector<geometry::Place>& places);

}  // namespace corpuscle::simulation
