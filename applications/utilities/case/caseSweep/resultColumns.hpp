// Checks `results` of a study before anything runs: whether the observers of its cases write these tables and columns.
//
// Known are the observers of system/observers.yaml, the names of cells and bodies in system/mesh.yaml, and the columns
// that each observer declares. What depends on the course of a run is accepted: every column that some scene has, and
// any name of a wall. Tables that no observer of the case writes are accepted where a program of the user's may write
// them.
#pragma once
#include "core/dictionary.hpp"
#include "study/studyCases.hpp"

namespace corpuscle {

// `study`: study.yaml, from which `settings` were read; `programs` are those that cases run. Adds a problem at the
// place of each table or column that a case would not have.
void checkResultColumns(const Node& study, const study::StudySettings& settings,
                        const std::filesystem::path& templateCase, const std::vector<study::StudyCase>& cases,
                        Problems& problems);

}  // namespace corpuscle
