#include "core/atomicFile.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <memory>
#include <sstream>
#include <utility>

#include "core/error.hpp"
#include "core/writeFailure.hpp"

namespace corpuscle {

void writeFileAtomically(const std::filesystem::path& file, const std::string& text, long room) {
    std::error_code none;
    if (std::filesystem::is_symlink(file, none)) {  // the link is kept, and its target is written
        const std::filesystem::path target = std::filesystem::weakly_canonical(file, none);
        if (!none && target != file) return writeFileAtomically(target, text, room);
    }
    if (file.has_parent_path()) {
        std::error_code error;
        std::filesystem::create_directories(file.parent_path(), error);
        if (error) throw writeFailure(file, error.value());
    }
    std::filesystem::path temporary = file;
    temporary += fmt::format(".{}.tmp", getpid());
    std::FILE* stream = std::fopen(temporary.c_str(), "wb");
    if (!stream) throw writeFailure(file, errno);
    struct stat before {};
    if (stat(file.c_str(), &before) == 0 && S_ISREG(before.st_mode))  // its permissions are kept; where that is
        [[maybe_unused]]                                              // impossible, it is written all the same
        const int changed = fchmod(fileno(stream), before.st_mode & 07777);
    bool written = std::fwrite(text.data(), 1, text.size(), stream) == text.size();
    written = written && std::fflush(stream) == 0 && fsync(fileno(stream)) == 0;
    int reason = errno;
    // Where the system cannot reserve space, the file is written without a reserve.
    if (written && room > 0) [[maybe_unused]]
        const int reserved = fallocate(fileno(stream), FALLOC_FL_KEEP_SIZE, 0, room);
    if (std::fclose(stream) != 0 && written) {
        written = false;
        reason = errno;
    }
    if (written && std::rename(temporary.c_str(), file.c_str()) == 0) return;
    if (written) reason = errno;
    std::remove(temporary.c_str());
    throw writeFailure(file, reason);
}

std::filesystem::path fileOfTemporary(const std::filesystem::path& temporary) {
    const std::filesystem::path withProcess = temporary.parent_path() / temporary.stem();
    const std::string process = withProcess.extension().string();
    const bool isNumber = process.size() > 1 && process.find_first_not_of("0123456789", 1) == std::string::npos;
    if (temporary.extension() != ".tmp" || !isNumber) return {};
    return withProcess.parent_path() / withProcess.stem();
}

bool overwriteFile(const std::filesystem::path& file, const std::string& text) {
    const int descriptor = ::open(file.c_str(), O_WRONLY | O_CLOEXEC);
    if (descriptor < 0) return false;
    struct stat status {};
    constexpr blkcnt_t blockSize = 512;
    bool done = ::fstat(descriptor, &status) == 0 && std::cmp_less_equal(text.size(), status.st_blocks * blockSize);
    done = done && ::pwrite(descriptor, text.data(), text.size(), 0) == static_cast<ssize_t>(text.size());
    done = done && ::ftruncate(descriptor, static_cast<off_t>(text.size())) == 0;
    ::close(descriptor);
    return done;
}

std::string readFile(const std::filesystem::path& file) {
    errno = 0;
    std::ifstream stream(file, std::ios::binary);
    std::ostringstream text;
    const auto fail = [&](int reason) {
        throw Failure(ExitCode::io, fmt::format("cannot read {}: {}", file.string(), std::strerror(reason)));
    };
    if (!stream || std::filesystem::is_directory(file)) fail(errno ? errno : EISDIR);
    if (stream.peek() != std::ifstream::traits_type::eof()) text << stream.rdbuf();
    if (stream.bad()) fail(errno ? errno : EIO);
    return text.str();
}

}  // namespace corpuscle
