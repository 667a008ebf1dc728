// The bytes of one array of a VTK XML file: decoded, decompressed, in the file's byte order.
#pragma once
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

#include "core/error.hpp"

namespace corpuscle::io {

enum class VtpCompressor { none, zlib, lz4, lzma };

struct VtpEncoding {
    bool littleEndian = true;
    int headerBytes = 4;
    VtpCompressor compressor = VtpCompressor::none;
};

struct VtpFault : std::runtime_error {
    explicit VtpFault(const std::string& text) : std::runtime_error(printable(text)) {}
};

// `source` begins with the array's header and may hold more behind it. `expected`: the length that the array must have.
// Throws VtpFault; allocates no more memory than the bytes in `source` can expand to.
std::string vtpBytes(std::string_view source, bool base64, const VtpEncoding& encoding,
                     std::optional<std::uint64_t> expected);

}  // namespace corpuscle::io
