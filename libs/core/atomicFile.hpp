// Atomic replacement of a file: whatever happens, either the old or the complete new content is there. The text is
// written under a temporary name in the same folder, flushed to disk and renamed. Permissions are kept; a symbolic link
// stays, and the file that it points to is replaced.
#pragma once
#include <filesystem>
#include <string>

namespace corpuscle {

// Creates missing directories. Failure(io) with the path and the system's reason (core/writeFailure.hpp). `room`: disk
// space [bytes] reserved for the file, whose length stays that of the text, so that overwriteFile() works on a full
// disk.
void writeFileAtomically(const std::filesystem::path& file, const std::string& text, long room = 0);

// The file for which this is a temporary name of writeFileAtomically, left by a program that was killed while it wrote;
// empty where it is none.
std::filesystem::path fileOfTemporary(const std::filesystem::path& temporary);

// Last resort on a full disk: overwrites the old text within the disk blocks that the file already has. Not atomic.
// Returns false where these blocks are too few.
bool overwriteFile(const std::filesystem::path& file, const std::string& text);

// The whole file. Failure(io) when it cannot be read.
std::string readFile(const std::filesystem::path& file);

}  // namespace corpuscle
