// A text file that grows line by line: what is added reaches the system at once, whole or not at all.
#pragma once
#include <filesystem>
#include <string>
#include <utility>

namespace corpuscle {

class AppendedFile {
  public:
    AppendedFile() = default;  // none
    // Goes on behind what the file has. Failure(io) when it cannot be opened for writing.
    explicit AppendedFile(std::filesystem::path file);
    AppendedFile(AppendedFile&& other) noexcept
        : path_(std::move(other.path_)), descriptor_(std::exchange(other.descriptor_, -1)) {}
    AppendedFile& operator=(AppendedFile&& other) noexcept {
        std::swap(path_, other.path_);
        std::swap(descriptor_, other.descriptor_);
        return *this;
    }
    ~AppendedFile() { close(); }

    // Failure(io); the file then is as it was before.
    void add(const std::string& text);
    void close();
    bool isOpen() const { return descriptor_ >= 0; }

  private:
    std::filesystem::path path_;
    int descriptor_ = -1;
};

}  // namespace corpuscle
