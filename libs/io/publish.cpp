#include "io/publish.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>

#include "core/writeFailure.hpp"

namespace corpuscle::io {
namespace {

void syncToDisk(const std::filesystem::path& path) {
    const int file = ::open(path.c_str(), O_RDONLY);
    const bool done = file >= 0 && ::fsync(file) == 0;
    const int reason = errno;
    if (file >= 0) ::close(file);
    if (!done) throw writeFailure(path, reason);
}

}  // namespace

std::filesystem::path temporaryName(const std::filesystem::path& path) {
    return path.parent_path() / ("." + path.filename().string() + ".part");
}

bool isTemporaryName(const std::filesystem::path& path) {
    return path.filename().string().starts_with(".") && path.extension() == ".part";
}

void publish(const std::filesystem::path& temporary, const std::filesystem::path& path, Sync sync) {
    if (sync == Sync::disk) syncToDisk(temporary);
    std::error_code error;
    std::filesystem::rename(temporary, path, error);
    if (error) throw writeFailure(path, error.value());
    if (sync == Sync::disk) syncToDisk(path.has_parent_path() ? path.parent_path() : ".");
}

Failure notWritten(const std::filesystem::path& path, const std::filesystem::path& temporary, const std::string& said,
                   std::uintmax_t extent) {
    const int reason = tryWriting(temporary, extent);
    std::error_code ignored;
    std::filesystem::remove(temporary, ignored);
    if (reason != 0 || said.empty()) return writeFailure(path, reason);
    return {ExitCode::io, fmt::format("cannot write {}: {}; check permissions and free space", path.string(), said)};
}

void makeFolder(const std::filesystem::path& folder) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error) throw writeFailure(folder, error.value());
}

}  // namespace corpuscle::io
