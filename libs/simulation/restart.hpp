// What the state in a checkpoint depends on, and whether the present case may continue from it.
//
// Every checkpoint contains the settings of its run, as in used.yaml but without those declared `free` (AtRestart,
// core/settings.hpp); values that the case derives from settings of several files; and the meshes of its cells and
// bodies as they were in 0/, with their stress-free shapes. A restart compares all of this. Changes of fixed settings
// or derived values, and of meshes, are errors and are reported together; each change of a noted one gives a line in
// the log. Membrane laws are compared cell by cell, whatever the name of their entry in constant/membranes.yaml.
//
// dataset of the checkpoint          | content
// origin/settings                    | YAML text: a table for each file, and `derived`; eight characters to an integer
// origin/<name>/nodes, /stressFree   | node coordinates of a cell or body in 0/ [m]; stressFree only if it differs
// origin/<name>/triangles            | node numbers of its triangles
#pragma once
#include <string>
#include <vector>

#include "core/settingsChange.hpp"
#include "coupling/scene.hpp"
#include "io/checkpointFile.hpp"
#include "simulation/case.hpp"

namespace corpuscle::simulation {

// The dictionaries of a case that a restart compares, by file.
std::vector<std::pair<std::string, FieldInfo>> restartDictionaries();

void writeOrigin(io::CheckpointWriter& file, const Case& input, const coupling::Scene& scene);

// Throws CaseError with every fixed setting that has changed, and Failure(io) if the checkpoint contains no settings.
// Returns a line for each change of a noted setting. Collective.
std::vector<std::string> compareSettings(const std::filesystem::path& checkpoint, const Case& input, MPI_Comm comm);

// Throws CaseError if a mesh of the scene, as read from 0/, differs from that of the checkpoint.
void compareMeshes(io::CheckpointReader& file, const std::filesystem::path& checkpoint, const Case& input,
                   const coupling::Scene& scene);

}  // namespace corpuscle::simulation
