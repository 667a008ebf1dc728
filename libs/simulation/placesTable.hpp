// Places of many cells of one type from a file: `table` of an entry of `cells` in system/mesh.yaml.
//
// file | content
// .csv | a line with the names of the columns, then one line for each cell. x, y and z with a unit behind: x_um, y_um,
//      | z_um (or _m, _mm, _nm); axis_x, axis_y, axis_z: direction of the symmetry axis, z where they are missing;
//      | scale: size in sizes of the shape, 1 where it is missing. Lines that begin with # are passed over
// .vtp | points [m], with the point arrays `axis` (vectors) and `scale` where wanted
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "geometry/place.hpp"

namespace corpuscle::simulation {

// Adds a problem, with its line and column in the file, for each thing that is wrong. mark, key: of the setting that
// names the file, for problems of the whole of it.
std::vector<geometry::Place> readPlaces(const std::filesystem::path& caseDirectory, const std::string& file,
                                        const Mark& mark, const std::string& key, Problems& problems);

// Writes them to the file, by its ending .csv or .vtp; what is read from it are the same places to eleven digits.
void writePlaces(const std::filesystem::path& path, const std::vector<geometry::Place>& places);

// "16 places, checksum 8c1f0a2b9d3e4f50": the same for places that are equal to ten digits.
std::string describePlaces(const std::vector<geometry::Place>& places);

}  // namespace corpuscle::simulation
