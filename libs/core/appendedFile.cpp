#include "core/appendedFile.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>

#include "core/writeFailure.hpp"

namespace corpuscle {

AppendedFile::AppendedFile(std::filesystem::path file)
    : path_(std::move(file)), descriptor_(::open(path_.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666)) {
    if (descriptor_ < 0) throw writeFailure(path_, errno);
}

void AppendedFile::add(const std::string& text) {
    const off_t before = ::lseek(descriptor_, 0, SEEK_END);
    for (std::size_t written = 0; written < text.size();) {
        const ssize_t part = ::write(descriptor_, text.data() + written, text.size() - written);
        if (part > 0) written += static_cast<std::size_t>(part);
        if (part > 0 || (part < 0 && errno == EINTR)) continue;
        const int reason = part < 0 ? errno : EIO;
        // A table must not end in half a row, so the part written is cut off. This needs no space and works on a full
        // disk.
        if (before >= 0 && written > 0) [[maybe_unused]]
            const int cut = ::ftruncate(descriptor_, before);
        throw writeFailure(path_, reason);
    }
}

void AppendedFile::close() {
    if (descriptor_ >= 0) ::close(std::exchange(descriptor_, -1));
}

}  // namespace corpuscle
