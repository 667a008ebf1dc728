#include "core/atomicFile.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <memory>
#include <sstream>

#include "core/error.hpp"

namespace corpuscle {
namespace {

[[noreturn]] void fail(const char* action, const std::filesystem::path& file, int reason) {
    throw Failure(ExitCode::io, fmt::format("cannot {} {}: {}", action, file.string(), std::strerror(reason)));
}

}  // namespace

void writeFileAtomically(const std::filesystem::path& file, const std::string& text) {
    if (file.has_parent_path()) {
        std::error_code error;
        std::filesystem::create_directories(file.parent_path(), error);
        if (error) fail("make the directory of", file, error.value());
    }
    std::filesystem::path temporary = file;
    temporary += fmt::format(".{}.tmp", getpid());
    std::FILE* stream = std::fopen(temporary.c_str(), "wb");
    if (!stream) fail("write", file, errno);
    bool written = std::fwrite(text.data(), 1, text.size(), stream) == text.size();
    written = written && std::fflush(stream) == 0 && fsync(fileno(stream)) == 0;
    int reason = errno;
    if (std::fclose(stream) != 0 && written) {
        written = false;
        reason = errno;
    }
    if (written && std::rename(temporary.c_str(), file.c_str()) == 0) return;
    if (written) reason = errno;
    std::remove(temporary.c_str());
    fail("write", file, reason);
}

std::string readFile(const std::filesystem::path& file) {
    errno = 0;
    std::ifstream stream(file, std::ios::binary);
    std::ostringstream text;
    if (!stream || std::filesystem::is_directory(file)) fail("read", file, errno ? errno : EISDIR);
    if (stream.peek() != std::ifstream::traits_type::eof()) text << stream.rdbuf();
    if (stream.bad()) fail("read", file, errno ? errno : EIO);
    return text.str();
}

}  // namespace corpuscle
