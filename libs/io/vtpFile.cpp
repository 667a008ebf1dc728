#include "io/vtpFile.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <fstream>
#include <limits>
#include <optional>

#include "core/error.hpp"
#include "io/textNumber.hpp"
#include "io/vtpBytes.hpp"
#include "io/xml.hpp"

namespace corpuscle::io {
namespace {

enum class Number { int8, uint8, int16, uint16, int32, uint32, int64, uint64, float32, float64, text };

std::size_t widthOf(Number type) {
    switch (type) {
        case Number::int8:
        case Number::uint8:
        case Number::text:
            return 1;
        case Number::int16:
        case Number::uint16:
            return 2;
        case Number::int32:
        case Number::uint32:
        case Number::float32:
            return 4;
        default:
            return 8;
    }
}

VtpArray::Kind kindOf(Number type) {
    return type == Number::text                                 ? VtpArray::Kind::text
           : type == Number::float32 || type == Number::float64 ? VtpArray::Kind::real
                                                                : VtpArray::Kind::integer;
}

// Copies numbers from the byte order of the file to that of the machine.
template <class T, class Target>
void copyNumbers(const std::string& bytes, bool littleEndian, std::vector<Target>& target) {
    const std::size_t n = bytes.size() / sizeof(T);
    target.resize(n);
    const bool swap = littleEndian != (std::endian::native == std::endian::little);
    for (std::size_t i = 0; i < n; ++i) {
        char raw[sizeof(T)];
        std::memcpy(raw, bytes.data() + i * sizeof(T), sizeof(T));
        if (swap) std::reverse(raw, raw + sizeof(T));
        T value;
        std::memcpy(&value, raw, sizeof(T));
        target[i] = static_cast<Target>(value);  // NOLINT(bugprone-signed-char-misuse): Int8 is a number here
    }
}

bool isBlank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

// The next word of `text` after `at`; empty at the end.
std::string_view nextWord(std::string_view text, std::size_t& at) {
    while (at < text.size() && isBlank(text[at])) ++at;
    const std::size_t begin = at;
    while (at < text.size() && !isBlank(text[at])) ++at;
    return text.substr(begin, at - begin);
}

class VtpReader {
  public:
    VtpReader(const XmlElement& root, std::size_t bytes) : root_(root), bytes_(bytes) {
        const std::string order = valueOr(root, "byte_order", "LittleEndian"),
                          header = valueOr(root, "header_type", "UInt32"), compressor = valueOr(root, "compressor", "");
        encoding_.littleEndian = order == "LittleEndian";
        if (!encoding_.littleEndian && order != "BigEndian")
            throw VtpFault(fmt::format("byte_order '{}' is not LittleEndian or BigEndian", order));
        encoding_.headerBytes = header == "UInt64" ? 8 : 4;
        if (header != "UInt64" && header != "UInt32")
            throw VtpFault(fmt::format("header_type '{}' is not UInt32 or UInt64", header));
        if (compressor == "vtkZLibDataCompressor")
            encoding_.compressor = VtpCompressor::zlib;
        else if (compressor == "vtkLZ4DataCompressor")
            encoding_.compressor = VtpCompressor::lz4;
        else if (compressor == "vtkLZMADataCompressor")
            encoding_.compressor = VtpCompressor::lzma;
        else if (!compressor.empty())
            throw VtpFault(fmt::format("unknown compressor '{}'", compressor));
        if (const XmlElement* data = root.child("AppendedData")) {
            appended_ = data->text;
            const std::string how = valueOr(*data, "encoding", "base64");
            if (how != "raw" && how != "base64")
                throw VtpFault(fmt::format("appended data of encoding '{}' are not read", how));
            appendedIsBase64_ = how == "base64";
        }
    }

    VtpFile read() {
        VtpFile file;
        const XmlElement* all = root_.child("PolyData");
        if (!all) throw VtpFault("the element PolyData is missing");
        if (const XmlElement* field = all->child("FieldData")) readFields(*field, file.field);
        for (const XmlElement& e : all->children)
            if (e.name == "Piece") file.pieces.push_back(readPiece(e));
        if (file.pieces.empty()) throw VtpFault("the element Piece is missing");
        return file;
    }

  private:
    static std::string valueOr(const XmlElement& e, const std::string& name, const std::string& otherwise) {
        const std::string* value = e.attribute(name);
        return value ? *value : otherwise;
    }

    // A number of points, cells, tuples or components.
    std::size_t countOf(const XmlElement& e, const std::string& name, std::size_t otherwise) const {
        const std::string* value = e.attribute(name);
        if (!value) return otherwise;
        const auto count = textToInteger<std::int64_t>(*value);
        if (!count || *count < 0 || *count > std::numeric_limits<int>::max())
            throw VtpFault(fmt::format("{}=\"{}\" is not a number of things that a file can hold", name, *value));
        return static_cast<std::size_t>(*count);
    }

    static Number typeOf(const XmlElement& e) {
        const std::string* type = e.attribute("type");
        if (!type) throw VtpFault("its type is missing");
        const std::pair<const char*, Number> known[] = {
            {"Int8", Number::int8},       {"UInt8", Number::uint8},   {"Int16", Number::int16},
            {"UInt16", Number::uint16},   {"Int32", Number::int32},   {"UInt32", Number::uint32},
            {"Int64", Number::int64},     {"UInt64", Number::uint64}, {"Float32", Number::float32},
            {"Float64", Number::float64}, {"String", Number::text}};
        for (const auto& [name, number] : known)
            if (*type == name) return number;
        throw VtpFault(fmt::format("its type '{}' is not known", *type));
    }

    // The bytes of an array, wherever the file holds them; `values`: how many numbers it must have.
    std::string bytesOf(const XmlElement& e, Number type, std::optional<std::size_t> values) const {
        const std::optional<std::uint64_t> expected =
            values ? std::optional<std::uint64_t>(*values * widthOf(type)) : std::nullopt;
        const std::string format = valueOr(e, "format", "");
        if (format == "binary") {
            const std::size_t begin = e.text.find_first_not_of(" \t\r\n");
            return vtpBytes(begin == std::string_view::npos ? std::string_view() : e.text.substr(begin), true,
                            encoding_, expected);
        }
        if (format != "appended")
            throw VtpFault(fmt::format("its format '{}' is not ascii, binary or appended", format));
        const auto offset = textToInteger<std::uint64_t>(valueOr(e, "offset", ""));
        if (!offset) throw VtpFault("its offset is not a number");
        if (*offset >= appended_.size())
            throw VtpFault(
                fmt::format("its offset {} lies beyond the {} bytes of appended data", *offset, appended_.size()));
        return vtpBytes(appended_.substr(*offset), appendedIsBase64_, encoding_, expected);
    }

    template <class T, class Parse>
    static void readWords(std::string_view text, std::optional<std::size_t> values, std::vector<T>& target,
                          Parse&& parse) {
        const auto shortOf = [&](std::size_t found) {
            return VtpFault(fmt::format("{} numbers are there, {} are needed", found, *values));
        };
        if (values && *values > text.size() / 2 + 1) throw shortOf(std::min(*values, text.size() / 2 + 1));
        if (values) target.reserve(*values);
        std::size_t at = 0;
        for (std::string_view word = nextWord(text, at); !word.empty(); word = nextWord(text, at)) {
            const auto value = parse(word);
            if (!value)
                throw VtpFault(fmt::format("'{}' is not {}", word.substr(0, 40),
                                           std::is_same_v<T, double> ? "a number" : "a whole number"));
            target.push_back(static_cast<T>(*value));
        }
        if (values && target.size() != *values) throw shortOf(target.size());
    }

    static std::optional<std::int64_t> wholeNumber(std::string_view word) {
        if (const auto value = textToInteger<std::int64_t>(word)) return value;
        const auto large = textToInteger<std::uint64_t>(word);
        return large ? std::optional<std::int64_t>(static_cast<std::int64_t>(*large)) : std::nullopt;
    }

    static void splitTexts(const std::string& bytes, std::vector<std::string>& texts) {
        for (std::size_t begin = 0; begin < bytes.size();) {
            const std::size_t end = std::min(bytes.find('\0', begin), bytes.size());
            texts.push_back(bytes.substr(begin, end - begin));
            begin = end + 1;
        }
    }

    VtpArray readArray(const XmlElement& e, std::optional<std::size_t> tuples) const {
        VtpArray array;
        array.name = valueOr(e, "Name", "");
        try {
            const Number type = typeOf(e);
            array.kind = kindOf(type);
            array.components = static_cast<int>(countOf(e, "NumberOfComponents", 1));
            if (array.components < 1 || array.components > 1000)
                throw VtpFault(fmt::format("it has {} components", array.components));
            if (!tuples && e.attribute("NumberOfTuples") && type != Number::text)
                tuples = countOf(e, "NumberOfTuples", 0);
            const std::optional<std::size_t> values =
                tuples && type != Number::text
                    ? std::optional<std::size_t>(*tuples * static_cast<std::size_t>(array.components))
                    : std::nullopt;
            if (valueOr(e, "format", "ascii") == "ascii")
                readAscii(e.text, type, values, array);
            else
                readBinary(bytesOf(e, type, values), type, array);
        } catch (const VtpFault& fault) {
            throw VtpFault(fmt::format("array '{}' (line {}): {}", array.name, e.line, fault.what()));
        }
        return array;
    }

    static void readAscii(std::string_view text, Number type, std::optional<std::size_t> values, VtpArray& array) {
        if (array.kind == VtpArray::Kind::real) {
            readWords(text, values, array.reals, textToDouble);
            if (type == Number::float32)
                for (double& x : array.reals) x = static_cast<double>(static_cast<float>(x));
        } else if (array.kind == VtpArray::Kind::integer) {
            readWords(text, values, array.integers, wholeNumber);
        } else {
            std::vector<int> codes;
            readWords(text, {}, codes, [](std::string_view word) { return textToInteger<int>(word); });
            splitTexts({codes.begin(), codes.end()}, array.texts);
        }
    }

    void readBinary(const std::string& bytes, Number type, VtpArray& array) const {
        if (bytes.size() % widthOf(type) != 0)
            throw VtpFault(fmt::format("its {} bytes are no whole number of values", bytes.size()));
        const bool little = encoding_.littleEndian;
        switch (type) {
            case Number::int8:
                return copyNumbers<std::int8_t>(bytes, little, array.integers);
            case Number::uint8:
                return copyNumbers<std::uint8_t>(bytes, little, array.integers);
            case Number::int16:
                return copyNumbers<std::int16_t>(bytes, little, array.integers);
            case Number::uint16:
                return copyNumbers<std::uint16_t>(bytes, little, array.integers);
            case Number::int32:
                return copyNumbers<std::int32_t>(bytes, little, array.integers);
            case Number::uint32:
                return copyNumbers<std::uint32_t>(bytes, little, array.integers);
            case Number::int64:
                return copyNumbers<std::int64_t>(bytes, little, array.integers);
            case Number::uint64:
                return copyNumbers<std::uint64_t>(bytes, little, array.integers);
            case Number::float32:
                return copyNumbers<float>(bytes, little, array.reals);
            case Number::float64:
                return copyNumbers<double>(bytes, little, array.reals);
            case Number::text:
                return splitTexts(bytes, array.texts);
        }
    }

    static bool isLaterStep(const XmlElement& e) {
        const std::string step = valueOr(e, "TimeStep", "0");
        return step != "0" && !step.starts_with("0 ");
    }

    void readFields(const XmlElement& field, std::vector<VtpArray>& target) const {
        for (const XmlElement& e : field.children)
            if ((e.name == "DataArray" || e.name == "Array") && !isLaterStep(e)) target.push_back(readArray(e, {}));
    }

    void readAttributes(const XmlElement& piece, const char* name, std::size_t tuples,
                        std::vector<VtpArray>& target) const {
        const XmlElement* list = piece.child(name);
        if (!list) return;
        for (const XmlElement& e : list->children)
            if ((e.name == "DataArray" || e.name == "Array") && !isLaterStep(e)) {
                VtpArray array = readArray(e, tuples);
                const auto same = [&](const VtpArray& other) { return other.name == array.name; };
                if (std::any_of(target.begin(), target.end(), same))
                    throw VtpFault(fmt::format("array '{}' (line {}) stands twice", array.name, e.line));
                target.push_back(std::move(array));
            }
    }

    VtpCells readCells(const XmlElement& piece, const char* name, const char* number, std::size_t points) const {
        VtpCells cells;
        const std::size_t count = countOf(piece, number, 0);
        const XmlElement* list = piece.child(name);
        if (count == 0) return cells;
        if (!list) throw VtpFault(fmt::format("{} are announced, but the element {} is missing", number, name));
        bool hasCorners = false, hasEnds = false;
        for (const XmlElement& e : list->children) {
            const std::string array = valueOr(e, "Name", "");
            const bool ends = array == "offsets";
            if (e.name != "DataArray" || (!ends && array != "connectivity") || isLaterStep(e)) continue;
            VtpArray values = readArray(e, ends ? std::optional<std::size_t>(count) : std::nullopt);
            if (values.kind != VtpArray::Kind::integer)
                throw VtpFault(fmt::format("array '{}' of {} holds no whole numbers", array, name));
            (ends ? cells.ends : cells.corners) = std::move(values.integers);
            (ends ? hasEnds : hasCorners) = true;
        }
        if (!hasCorners || !hasEnds)
            throw VtpFault(fmt::format("{} has no array '{}'", name, hasCorners ? "offsets" : "connectivity"));
        checkCells(cells, name, points);
        return cells;
    }

    static void checkCells(const VtpCells& cells, const char* name, std::size_t points) {
        std::int64_t before = 0;
        const auto corners = static_cast<std::int64_t>(cells.corners.size());
        for (std::size_t i = 0; i < cells.count(); ++i) {
            if (cells.ends[i] < before || cells.ends[i] > corners)
                throw VtpFault(fmt::format("cell {} of {} has the offset {}, which is not between {} and {}", i, name,
                                           cells.ends[i], before, corners));
            before = cells.ends[i];
        }
        if (before != corners)
            throw VtpFault(fmt::format("{} has {} corners, its offsets name {}", name, corners, before));
        for (std::size_t i = 0, k = 0; i < cells.count(); ++i)
            for (; static_cast<std::int64_t>(k) < cells.ends[i]; ++k)
                if (cells.corners[k] < 0 || cells.corners[k] >= static_cast<std::int64_t>(points))
                    throw VtpFault(
                        fmt::format("cell {} of {} names point {} of {}", i, name, cells.corners[k], points));
    }

    VtpPiece readPiece(const XmlElement& e) const {
        VtpPiece piece;
        const std::size_t count = countOf(e, "NumberOfPoints", 0);
        if (const XmlElement* points = e.child("Points")) {
            const XmlElement* array = points->child("DataArray");
            if (array) readPoints(readArray(*array, count), count, piece);
        }
        if (piece.points.size() != count)
            throw VtpFault(
                fmt::format("{} points are announced, but the element Points is missing (the file has {} "
                            "bytes)",
                            count, bytes_));
        piece.vertices = readCells(e, "Verts", "NumberOfVerts", count);
        piece.lines = readCells(e, "Lines", "NumberOfLines", count);
        piece.strips = readCells(e, "Strips", "NumberOfStrips", count);
        piece.polygons = readCells(e, "Polys", "NumberOfPolys", count);
        readAttributes(e, "PointData", count, piece.point);
        readAttributes(e, "CellData", piece.cellCount(), piece.cell);
        return piece;
    }

    static void readPoints(const VtpArray& array, std::size_t count, VtpPiece& piece) {
        if (array.components != 3 || array.kind == VtpArray::Kind::text)
            throw VtpFault(fmt::format("points have {} coordinates instead of 3", array.components));
        piece.points.reserve(count);
        for (std::size_t i = 0; i < count; ++i)
            if (array.kind == VtpArray::Kind::real)
                piece.points.emplace_back(array.reals[3 * i], array.reals[3 * i + 1], array.reals[3 * i + 2]);
            else
                piece.points.emplace_back(static_cast<double>(array.integers[3 * i]),
                                          static_cast<double>(array.integers[3 * i + 1]),
                                          static_cast<double>(array.integers[3 * i + 2]));
    }

    const XmlElement& root_;
    std::size_t bytes_;
    VtpEncoding encoding_;
    std::string_view appended_;
    bool appendedIsBase64_ = false;
};

}  // namespace

std::string readWholeVtkFile(const std::filesystem::path& path) {
    std::error_code error;
    if (!std::filesystem::is_regular_file(path, error))
        throw Failure(ExitCode::io, fmt::format("{}: there is no such file.", path.string()));
    std::ifstream file(path, std::ios::binary);
    std::string bytes;
    const auto size = std::filesystem::file_size(path, error);
    if (file && !error) bytes.resize(size);
    if (!file || error || !file.read(bytes.data(), static_cast<std::streamsize>(size)))
        throw Failure(ExitCode::io, fmt::format("{}: the file cannot be read; check its permissions.", path.string()));
    // The closing tag shows that the file is complete.
    if (bytes.find("</VTKFile>", bytes.size() < 64 ? 0 : bytes.size() - 64) == std::string::npos)
        throw Failure(ExitCode::io, fmt::format("{}: the file is cut off or no VTK XML file ({} bytes, without its "
                                                "closing </VTKFile>); write it again.",
                                                path.string(), size));
    return bytes;
}

VtpFile parseVtp(std::string_view bytes, const std::string& name) {
    try {
        const XmlElement root = parseXml(bytes);
        const std::string* type = root.attribute("type");
        if (root.name != "VTKFile" || !type || *type != "PolyData")
            throw Failure(ExitCode::io, fmt::format("{}: the file is no VTK XML PolyData (.vtp).", name));
        return VtpReader(root, bytes.size()).read();
    } catch (const XmlFault& fault) {
        throw Failure(ExitCode::io, fmt::format("{}: the file is corrupt or no VTK XML file: {}.", name, fault.what()));
    } catch (const VtpFault& fault) {
        throw Failure(ExitCode::io, fmt::format("{}: the file is corrupt: {}.", name, fault.what()));
    }
}

VtpFile readVtpFile(const std::filesystem::path& path) { return parseVtp(readWholeVtkFile(path), path.string()); }

}  // namespace corpuscle::io
