// A file that is either the old one or the whole new one, whatever happens in between: the text goes to a temporary
// name beside it, is flushed to disk, and takes the name by a rename. Permissions stay, and a link goes on naming its
// file.
#pragma once
#include <filesystem>
#include <string>

namespace corpuscle {

// Creates missing directories. Failure(io) with the path and the system's reason (core/writeFailure.hpp). `room`: bytes
// that the disk keeps for the file, whose length stays that of the text, so that overwriteFile() works on a full disk.
void writeFileAtomically(const std::filesystem::path& file, const std::string& text, long room = 0);

// The last resort on a full disk: puts the text in the place of the old one, in the blocks that the file has. Not
// atomic. False where there are too few.
bool overwriteFile(const std::filesystem::path& file, const std::string& text);

// The whole file. Failure(io) when it cannot be read.
std::string readFile(const std::filesystem::path& file);

}  // namespace corpuscle
