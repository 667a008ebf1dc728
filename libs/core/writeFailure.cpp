#include "core/writeFailure.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <climits>
#include <csignal>
#include <cstring>

#include "core/machineMemory.hpp"

namespace corpuscle {
namespace {

namespace fs = std::filesystem;

// The folder of a file or, where that does not exist, the nearest one above it that does.
fs::path existingFolder(const fs::path& file) {
    std::error_code error;
    fs::path folder = fs::absolute(file, error).parent_path();
    while (!fs::exists(folder, error) && folder.has_relative_path()) folder = folder.parent_path();
    return folder;
}

std::string freeSpace(const fs::path& file) {
    struct statvfs disk {};
    if (statvfs(existingFolder(file).c_str(), &disk) != 0) return "";
    const std::string bytes = formatBytes(static_cast<double>(disk.f_bavail) * static_cast<double>(disk.f_frsize));
    return fmt::format("; {} and {} file{} are free on its disk", bytes, disk.f_favail, disk.f_favail == 1 ? "" : "s");
}

std::string sizeLimit() {
    rlimit limit{};
    if (getrlimit(RLIMIT_FSIZE, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return "of its disk";
    return fmt::format("of {} (ulimit -f)", formatBytes(static_cast<double>(limit.rlim_cur)));
}

std::string cure(const fs::path& file, int reason) {
    switch (reason) {
        case ENOSPC:
            return freeSpace(file) + ": make room, or write less often ('write' and 'keep' in system/control.yaml)";
        case EDQUOT:
            return ": make room within the quota, or ask for a larger one";
        case EFBIG:
            return fmt::format("; the limit {} is reached: raise it ('ulimit -f unlimited')", sizeLimit());
        case EACCES:
        case EPERM:
            return fmt::format(": check the owner and the permissions of {}", existingFolder(file).string());
        case EROFS:
            return ": copy the case to a disk that can be written";
        case ENOTDIR:
        case EEXIST:
            return ": a file stands where a folder is needed; move it away";
        case EISDIR:
            return ": a folder stands where a file is needed; move it away";
        case ENAMETOOLONG: {
            const long name = pathconf(existingFolder(file).c_str(), _PC_NAME_MAX);
            return fmt::format(
                " ({} characters, its last part {}); {} and {} are the most: shorten the name, or move the case up, or "
                "run "
                "in its folder without -case",
                file.string().size(), file.filename().string().size(), PATH_MAX - 1, name > 0 ? name : NAME_MAX);
        }
        case 0:
            return "for a reason that the system does not give; check permissions and free space";
        default:
            return "";
    }
}

}  // namespace

Failure writeFailure(const fs::path& file, int reason) {
    return {ExitCode::io,
            fmt::format("cannot write {}{}{}", file.string(),
                        reason == 0 ? " " : ": " + std::string(std::strerror(reason)), cure(file, reason))};
}

int tryWriting(const fs::path& file, std::uintmax_t extent) {
    std::error_code error;
    const bool existed = fs::exists(file, error);
    const int descriptor = ::open(file.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0666);
    if (descriptor < 0) return errno;
    // More bytes than can remain free in the last disk block of the file.
    static const std::array<char, 1 << 16> zeros{};
    const off_t length = ::lseek(descriptor, 0, SEEK_END);
    std::size_t written = 0;
    int reason = 0;
    if (static_cast<std::uintmax_t>(length) < extent) ::lseek(descriptor, static_cast<off_t>(extent), SEEK_SET);
    while (written < zeros.size() && reason == 0) {
        const ssize_t part = ::write(descriptor, zeros.data(), zeros.size() - written);
        if (part < 0 && errno != EINTR) reason = errno;
        if (part > 0) written += static_cast<std::size_t>(part);
    }
    if (reason == 0 && ::fsync(descriptor) != 0 && errno != EINVAL) reason = errno;
    if (::ftruncate(descriptor, length) != 0 && reason == 0) reason = errno;
    ::close(descriptor);
    if (!existed) fs::remove(file, error);
    return reason;
}

void prepareOutput() {
    for (int descriptor = 0; descriptor <= 2; ++descriptor)
        if (::fcntl(descriptor, F_GETFD) < 0 && errno == EBADF) [[maybe_unused]]
            const int replaced = ::open("/dev/null", O_RDWR);
    std::signal(SIGXFSZ, SIG_IGN);
    std::signal(SIGPIPE, SIG_IGN);
}

}  // namespace corpuscle
