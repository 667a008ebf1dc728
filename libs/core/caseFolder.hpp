// What a case directory consists of: settings that people write, and what programs make of them.
//
// Written by programs: the start (0/), results/, postProcessing/, checkpoints/, log.*, run.json, used.yaml, .schema/;
// by a study in each of its cases also sweep.json; by tutorials that run several cases runs/. Everything else is the
// user's and is never removed.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace corpuscle {

bool isCase(const std::filesystem::path& folder);  // has system/control.yaml or system/relax.yaml

// Throws Failure where it is none, with the cases that lie in it.
void requireCase(const std::filesystem::path& folder);

// Whether programs have written this (a path in a case), the cases of a study among it, or it is hidden.
bool isOutput(const std::filesystem::path& path);

struct CopiedCase {
    std::vector<std::string> copied, left;  // names in the case; hidden ones are not told
};

// Copies a case without its output. `to` must not exist, or be an empty directory; it must not lie in `from`, but below
// `excluded`, a name in `from` that is left out too (empty: none). Throws Failure.
CopiedCase copyCase(const std::filesystem::path& from, const std::filesystem::path& to,
                    const std::string& excluded = {});

// Paths of all other files that a copy takes along and that a run may depend on, sorted: not pages (.md), pictures
// (.png), a study's dictionary, scripts without ending at the top, and copies that editors leave.
std::vector<std::string> dataFilesOf(const std::filesystem::path& caseDir, const std::string& excluded = {});

// Paths of all dictionaries: "system/control.yaml", "constant/cells/x.yaml", ..., sorted.
std::vector<std::string> dictionariesOf(const std::filesystem::path& caseDir);

}  // namespace corpuscle
