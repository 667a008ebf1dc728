// Contents of a case directory: settings written by users, and output written by programs.
//
// Programs write the initial state (0/), results/, postProcessing/, checkpoints/, log.*, run.json, used.yaml and
// .schema/; a study also writes sweep.json in each of its cases, and tutorials that run several cases write runs/.
// Everything else belongs to the user and is never removed.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace corpuscle {

bool isCase(const std::filesystem::path& folder);  // has system/control.yaml or system/relax.yaml

// Throws Failure when the folder is not a case; the message lists the cases in it.
void requireCase(const std::filesystem::path& folder);

// Whether a path in a case was written by programs (this includes the folder of a study's cases) or is hidden.
bool isOutput(const std::filesystem::path& path);

struct CopiedCase {
    std::vector<std::string> copied, left;  // names in the case, without hidden ones
};

// Copies a case without its output and without `excluded`, a name in `from` (empty: none). `to` must not exist, or must
// be an empty directory; it may lie in `from` only below `excluded`. Throws Failure.
CopiedCase copyCase(const std::filesystem::path& from, const std::filesystem::path& to,
                    const std::string& excluded = {});

// Sorted paths of all files, other than dictionaries, that a copy takes along and that a run may depend on. Left out
// are pages (.md), pictures (.png), a study's dictionary, scripts without extension at the top level, and copies left
// by editors.
std::vector<std::string> dataFilesOf(const std::filesystem::path& caseDir, const std::string& excluded = {});

// Paths of all dictionaries: "system/control.yaml", "constant/cells/x.yaml", ..., sorted.
std::vector<std::string> dictionariesOf(const std::filesystem::path& caseDir);

}  // namespace corpuscle
