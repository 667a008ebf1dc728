// A text file that grows line by line. Each addition reaches the operating system at once, as a whole or not at all.
#pragma once
#include <filesystem>
#include <string>
#include <utility>

namespace corpuscle {

class AppendedFile {
  public:
    AppendedFile() = default;  // no file
    // Appends to the file, or creates it. Failure(io) when it cannot be opened for writing.
    explicit AppendedFile(std::filesystem::path file);
    AppendedFile(AppendedFile&& other) noexcept
        : path_(std::move(other.path_)), descriptor_(std::exchange(other.descriptor_, -1)) {}
    AppendedFile& operator=(AppendedFile&& other) noexcept {
        std::swap(path_, other.path_);
        std::swap(descriptor_, other.descriptor_);
        return *this;
    }
    ~AppendedFile() { close(); }

    // Failure(io) when the text cannot be written as a whole; the file is then as it was before.
    void add(const std::string& text);
    void close();
    bool isOpen() const { return descriptor_ >= 0; }

  private:
    std::filesystem::path path_;
    int descriptor_ = -1;
};

}  // namespace corpuscle
