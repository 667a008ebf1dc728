// A file that is either the old one or the whole new one, whatever happens in between: the text goes to a temporary
// name beside it, is flushed to disk, and takes the name by a rename.
#pragma once
#include <filesystem>
#include <string>

namespace corpuscle {

// Creates missing directories. Failure(io) with the path and the system's reason.
void writeFileAtomically(const std::filesystem::path& file, const std::string& text);

// The whole file. Failure(io) when it cannot be read.
std::string readFile(const std::filesystem::path& file);

}  // namespace corpuscle
