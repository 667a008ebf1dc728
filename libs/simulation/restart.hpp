// What a checkpoint depends on beside its own numbers, and whether the case of today may continue from it.
//
// With every checkpoint go the settings of its run, as used.yaml has them, without those that are free (AtRestart,
// core/settings.hpp); values that the case derives from settings of several files; and the meshes of its cells and
// bodies as they stood in 0/, with their stress-free shapes. A restart compares all of it: a change of a fixed setting,
// of a derived value or of a mesh refuses it, all at once; a noted one gives a line. The laws of a cell are compared by
// cell, whatever their entry of constant/membranes.yaml is called.
//
// dataset of the checkpoint          | content
// origin/settings                    | YAML text: a table for each file, and `derived`; its characters eight to an
//                                    | integer
// origin/<name>/nodes, /stressFree   | coordinates of a cell or body in 0/ [m]; the latter only where they differ
// origin/<name>/triangles            | numbers of their nodes
#pragma once
#include <string>
#include <vector>

#include "core/settingsChange.hpp"
#include "coupling/scene.hpp"
#include "io/checkpointFile.hpp"
#include "simulation/case.hpp"

namespace corpuscle::simulation {

// The dictionaries of a case that a restart looks at, by their files.
std::vector<std::pair<std::string, FieldInfo>> restartDictionaries();

void writeOrigin(io::CheckpointWriter& file, const Case& input, const coupling::Scene& scene);

// Throws CaseError with every fixed setting that has changed, and Failure(io) where the file says nothing about its
// settings. Returns a line for each change that is noted. Collective.
std::vector<std::string> compareSettings(const std::filesystem::path& checkpoint, const Case& input, MPI_Comm comm);

// Throws CaseError where a mesh of the scene, as read from 0/, is not the one of the checkpoint.
void compareMeshes(io::CheckpointReader& file, const std::filesystem::path& checkpoint, const Case& input,
                   const coupling::Scene& scene);

}  // namespace corpuscle::simulation
