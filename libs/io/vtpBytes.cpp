#include "io/vtpBytes.hpp"

#include <fmt/format.h>
#include <vtkLZ4DataCompressor.h>
#include <vtkLZMADataCompressor.h>
#include <vtkNew.h>
#include <vtkZLibDataCompressor.h>

#include <algorithm>
#include <array>
#include <vector>

#include "io/vtkMessages.hpp"

namespace corpuscle::io {
namespace {

constexpr std::array<int, 256> base64Values() {
    std::array<int, 256> values{};
    values.fill(-1);
    const std::string_view alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (std::size_t i = 0; i < alphabet.size(); ++i)
        values[static_cast<unsigned char>(alphabet[i])] = static_cast<int>(i);
    return values;
}

// Reads bytes one after the other, from raw bytes or from base64. A header may be encoded separately, so padding can
// occur within the base64 text.
class ByteSource {
  public:
    ByteSource(std::string_view source, bool base64) : source_(source), base64_(base64) {}

    // Upper bound of the bytes still to come.
    std::uint64_t left() const {
        return base64_ ? held_.size() + (source_.size() - at_) / 4 * 3 : source_.size() - at_;
    }

    std::string take(std::uint64_t count) {
        if (count > left())
            throw VtpFault(fmt::format("{} bytes are announced, but the file has only {} more", count, left()));
        if (!base64_) {
            at_ += count;
            return std::string(source_.substr(at_ - count, count));
        }
        while (held_.size() < count) group();
        std::string bytes = held_.substr(0, count);
        held_.erase(0, count);
        return bytes;
    }

  private:
    void group() {
        static constexpr std::array<int, 256> values = base64Values();
        unsigned bits = 0;
        int padding = 0;
        for (int n = 0; n < 4; ++at_) {
            if (at_ >= source_.size()) throw VtpFault("the base64 text ends too early");
            const char c = source_[at_];
            if (c == ' ' || c == '\n' || c == '\r' || c == '\t') continue;
            const int value = values[static_cast<unsigned char>(c)];
            if (c == '=' && n >= 2)
                ++padding;
            else if (value < 0 || padding > 0)
                throw VtpFault(c == '<' ? "the base64 text ends too early"
                                        : "a character that is not of base64 stands in the data");
            bits = bits << 6 | static_cast<unsigned>(std::max(value, 0));
            ++n;
        }
        for (int k = 0; k < 3 - padding; ++k) held_.push_back(static_cast<char>(bits >> (16 - 8 * k) & 0xFF));
    }

    std::string_view source_;
    bool base64_;
    std::size_t at_ = 0;
    std::string held_;  // decoded and not yet taken
};

std::uint64_t headerNumber(const std::string& bytes, std::size_t index, const VtpEncoding& encoding) {
    std::uint64_t value = 0;
    const auto n = static_cast<std::size_t>(encoding.headerBytes);
    for (std::size_t k = 0; k < n; ++k) {
        const std::size_t place = encoding.littleEndian ? n - 1 - k : k;
        value = value << 8 | static_cast<unsigned char>(bytes[index * n + place]);
    }
    return value;
}

// The most bytes that one compressed byte can expand to.
std::uint64_t largestRatio(VtpCompressor compressor) {
    return compressor == VtpCompressor::lz4 ? 256 : compressor == VtpCompressor::zlib ? 1100 : 20000;
}

class Decompressor {
  public:
    explicit Decompressor(VtpCompressor kind) {
        if (kind == VtpCompressor::zlib)
            compressor_ = vtkSmartPointer<vtkZLibDataCompressor>::New();
        else if (kind == VtpCompressor::lz4)
            compressor_ = vtkSmartPointer<vtkLZ4DataCompressor>::New();
        else
            compressor_ = vtkSmartPointer<vtkLZMADataCompressor>::New();
    }
    void append(const std::string& block, std::uint64_t size, std::string& bytes) {
        const std::size_t before = bytes.size();
        bytes.resize(before + size);
        const auto done = compressor_->Uncompress(reinterpret_cast<const unsigned char*>(block.data()), block.size(),
                                                  reinterpret_cast<unsigned char*>(bytes.data()) + before, size);
        if (done != size || messages_.any()) throw VtpFault("a compressed block is damaged");
    }

  private:
    VtkMessages messages_;
    vtkSmartPointer<vtkDataCompressor> compressor_;
};

void requireLength(std::uint64_t found, std::optional<std::uint64_t> expected) {
    if (expected && found != *expected)
        throw VtpFault(fmt::format("{} bytes are announced, {} are needed", found, *expected));
}

}  // namespace

std::string vtpBytes(std::string_view data, bool base64, const VtpEncoding& encoding,
                     std::optional<std::uint64_t> expected) {
    ByteSource source(data, base64);
    const auto width = static_cast<std::uint64_t>(encoding.headerBytes);
    if (encoding.compressor == VtpCompressor::none) {
        const std::uint64_t size = headerNumber(source.take(width), 0, encoding);
        requireLength(size, expected);
        return source.take(size);
    }
    const std::string head = source.take(3 * width);
    const std::uint64_t blocks = headerNumber(head, 0, encoding), full = headerNumber(head, 1, encoding),
                        last = headerNumber(head, 2, encoding);
    if (blocks == 0) {
        requireLength(0, expected);
        return {};
    }
    const std::uint64_t ratio = largestRatio(encoding.compressor);
    if (blocks > source.left() / width || last > full)
        throw VtpFault(fmt::format("{} blocks of {} bytes are announced, but the file has only {} bytes more", blocks,
                                   full, source.left()));
    const std::string list = source.take(blocks * width);
    std::uint64_t compressed = 0, total = 0;
    std::vector<std::pair<std::uint64_t, std::uint64_t>> sizes;  // compressed, plain
    for (std::size_t b = 0; b < blocks; ++b) {
        const std::uint64_t size = headerNumber(list, b, encoding), plain = b + 1 == blocks && last > 0 ? last : full;
        if (size > source.left() || plain > size * ratio + 64)
            throw VtpFault(
                fmt::format("a block of {} compressed and {} plain bytes is announced, but the file has only "
                            "{} bytes more",
                            size, plain, source.left()));
        compressed += size, total += plain;
        if (compressed > source.left())
            throw VtpFault(
                fmt::format("{} bytes are announced, but the file has only {} more", compressed, source.left()));
        sizes.emplace_back(size, plain);
    }
    requireLength(total, expected);
    std::string bytes;
    bytes.reserve(total);
    Decompressor decompressor(encoding.compressor);
    for (const auto& [size, plain] : sizes) decompressor.append(source.take(size), plain, bytes);
    return bytes;
}

}  // namespace corpuscle::io
