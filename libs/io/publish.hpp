// Files that are complete or do not exist: they are written under a hidden temporary name in the same folder, then
// renamed. For text files see core/atomicFile.hpp.
#pragma once
#include <cstdint>
#include <filesystem>
#include <string>

#include "core/error.hpp"

namespace corpuscle::io {

// "dir/name" -> "dir/.name.part"
std::filesystem::path temporaryName(const std::filesystem::path& path);
bool isTemporaryName(const std::filesystem::path& path);

enum class Sync {
    none,  // survives a killed program
    disk   // survives a loss of power as well: fsync of the file and of its directory
};

// Renames `temporary` to `path`, replacing what was there. Throws Failure(ExitCode::io).
void publish(const std::filesystem::path& temporary, const std::filesystem::path& path, Sync sync);

// Why a library could not write `path`, found by writing to `temporary`, which is then removed (core/writeFailure.hpp).
// `said`: what the library gave as its reason, shown where the system has none;
// `extent`: how long the file was to be [B].
Failure notWritten(const std::filesystem::path& path, const std::filesystem::path& temporary,
                   const std::string& said = "", std::uintmax_t extent = 0);

// Makes the folder with its parents. Throws Failure(ExitCode::io).
void makeFolder(const std::filesystem::path& folder);

}  // namespace corpuscle::io
