// HDF5 identifiers that close themselves and calls that throw.
#pragma once
#include <hdf5.h>

#include <cstdint>
#include <string>
#include <type_traits>
#include <utility>

#include "core/error.hpp"

namespace corpuscle::io {

// Returns HDF5's answer, or throws a Failure with what was being done and the innermost of HDF5's own reasons.
template <class Answer>
Answer checked(Answer answer, const std::string& what) {
    if (answer >= 0) return answer;
    std::string reason;
    auto innermost = [](unsigned, const H5E_error2_t* error, void* text) -> herr_t {
        if (error->desc) *static_cast<std::string*>(text) = error->desc;
        return 0;
    };
    H5Ewalk2(H5E_DEFAULT, H5E_WALK_DOWNWARD, innermost, &reason);
    throw Failure(ExitCode::io, what + (reason.empty() ? "" : " (HDF5: " + reason + ")"));
}

class Handle {
  public:
    using Close = herr_t (*)(hid_t);
    Handle() = default;
    Handle(hid_t id, Close close, const std::string& what) : id_(checked(id, what)), close_(close) {}
    Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
    Handle& operator=(Handle&& other) noexcept {
        std::swap(id_, other.id_);
        std::swap(close_, other.close_);
        return *this;
    }
    ~Handle() { close(); }
    herr_t close() { return id_ >= 0 ? close_(std::exchange(id_, -1)) : 0; }
    operator hid_t() const { return id_; }

  private:
    hid_t id_ = -1;
    Close close_ = nullptr;
};

// HDF5 prints its error stack unless told not to; the reasons go into the exceptions instead.
struct QuietHdf5 {
    QuietHdf5() { H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr); }
};

// Little-endian in the file, whatever the machine.
template <class T>
hid_t fileType() {
    return std::is_same_v<T, double> ? H5T_IEEE_F64LE : std::is_same_v<T, std::int64_t> ? H5T_STD_I64LE : H5T_STD_U64LE;
}
template <class T>
hid_t memoryType() {
    return std::is_same_v<T, double>         ? H5T_NATIVE_DOUBLE
           : std::is_same_v<T, std::int64_t> ? H5T_NATIVE_INT64
                                             : H5T_NATIVE_UINT64;
}

namespace checkpoint {
inline constexpr const char* dataGroup = "data";  // datasets, rows x components
inline constexpr const char* rowsGroup = "rows";  // number of rows of each rank, for every distributed dataset
inline constexpr const char* checksumName = "checksum";
inline constexpr const char* ranksName = "ranks";
inline constexpr const char* attributeGroup = "attributes";
inline constexpr const char* contentsName = "contents";  // checksum of the list of everything (io/contents.hpp)
}  // namespace checkpoint

}  // namespace corpuscle::io
