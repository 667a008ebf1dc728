// .vtp files of other programs in every encoding, and files that describe their own content wrongly.
#include "io/vtpFile.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstring>

#include "core/error.hpp"
#include "io/polyData.hpp"
#include "io/temporaryFolder.hpp"

namespace corpuscle::io {
namespace {

template <class T>
std::string bytesOf(const std::vector<T>& values, bool little) {
    std::string bytes;
    for (const T value : values) {
        char raw[sizeof value];
        std::memcpy(raw, &value, sizeof value);
        if (little != (std::endian::native == std::endian::little)) std::reverse(raw, raw + sizeof value);
        bytes.append(raw, sizeof value);
    }
    return bytes;
}

std::string base64(const std::string& bytes) {
    const char* alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        unsigned bits = 0;
        for (std::size_t k = 0; k < 3; ++k)
            bits = bits << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
        for (std::size_t k = 0; k < 4; ++k) text += i + k <= bytes.size() ? alphabet[bits >> (18 - 6 * k) & 63] : '=';
    }
    return text;
}

struct Form {
    bool little = true, wide = false, appended = false, raw = false, headerApart = false;
};

// Writes a file with four points and two triangles.
class Writer {
  public:
    explicit Writer(Form form) : form_(form) {}
    std::string file() {
        const std::string points = array("Float64", "NumberOfComponents=\"3\"",
                                         std::vector<double>{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1.0 / 3}),
                          connectivity =
                              array("Int32", "Name=\"connectivity\"", std::vector<std::int32_t>{0, 1, 2, 1, 2, 3}),
                          offsets = array("Int64", "Name=\"offsets\"", std::vector<std::int64_t>{3, 6});
        std::string text = fmt::format(
            R"(<VTKFile type="PolyData" version="1.0" byte_order="{}" header_type="{}"><PolyData>)"
            R"(<Piece NumberOfPoints="4" NumberOfPolys="2"><Points>{}</Points><Polys>{}{}</Polys></Piece></PolyData>)",
            form_.little ? "LittleEndian" : "BigEndian", form_.wide ? "UInt64" : "UInt32", points, connectivity,
            offsets);
        if (form_.appended)
            text += fmt::format(R"(<AppendedData encoding="{}"> _{}</AppendedData>)", form_.raw ? "raw" : "base64",
                                appended_);
        return text + "</VTKFile>";
    }

  private:
    template <class T>
    std::string array(const char* type, const char* more, const std::vector<T>& values) {
        const std::string data = bytesOf(values, form_.little);
        const std::string head =
            form_.wide ? bytesOf(std::vector<std::uint64_t>{data.size()}, form_.little)
                       : bytesOf(std::vector<std::uint32_t>{static_cast<std::uint32_t>(data.size())}, form_.little);
        const std::string encoded = form_.raw           ? head + data
                                    : form_.headerApart ? base64(head) + base64(data)
                                                        : base64(head + data);
        if (!form_.appended)
            return fmt::format("<DataArray type=\"{}\" {} format=\"binary\">\n {}\n</DataArray>", type, more, encoded);
        appended_ += encoded;
        return fmt::format("<DataArray type=\"{}\" {} format=\"appended\" offset=\"{}\"/>", type, more,
                           appended_.size() - encoded.size());
    }

    Form form_;
    std::string appended_;
};

TEST(VtpFile, EveryEncodingIsRead) {
    for (int n = 0; n < 32; ++n) {
        const Form form{(n & 1) != 0, (n & 2) != 0, (n & 4) != 0, (n & 4) != 0 && (n & 8) != 0, (n & 16) != 0};
        const VtpFile file = parseVtp(Writer(form).file(), "a.vtp");
        ASSERT_EQ(file.pieces.size(), 1u) << n;
        EXPECT_EQ(file.pieces[0].points.at(3), Vec3(0, 0, 1.0 / 3)) << n;
        EXPECT_EQ(file.pieces[0].polygons.cell(1), (std::vector<int>{1, 2, 3})) << n;
    }
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return text.replace(at, from.size(), to);
}

void expectFault(const std::string& bytes, const std::string& part) {
    const std::string text = messageOf<Failure>([&] { parseVtp(bytes, "a.vtp"); });
    EXPECT_NE(text.find(part), std::string::npos) << "expected: " << part << "\nfound: " << text;
    EXPECT_EQ(text.find("std::"), std::string::npos) << text;
}

TEST(VtpFile, WhatAFileSaysOfItselfIsCheckedAgainstItsBytes) {
    const std::string raw = Writer({.appended = true, .raw = true}).file();
    expectFault(replaced(raw, "NumberOfPoints=\"4\"", "NumberOfPoints=\"1000000000\""),
                "96 bytes are announced, 24000000000 are needed");
    expectFault(replaced(raw, "NumberOfPoints=\"4\"", "NumberOfPoints=\"-4\""),
                "NumberOfPoints=\"-4\" is not a number of things");
    expectFault(replaced(raw, "NumberOfPoints=\"4\"", "NumberOfPoints=\"99999999999999999999\""),
                "is not a number of things");
    expectFault(replaced(raw, "NumberOfPolys=\"2\"", "NumberOfPolys=\"3\""),
                "array 'offsets' (line 1): 16 bytes are announced, 24 are needed");
    expectFault(replaced(raw, "NumberOfPolys=\"2\"", "NumberOfStrips=\"2\""), "the element Strips is missing");
    expectFault(replaced(raw, "offset=\"0\"", "offset=\"100000\""), "its offset 100000 lies beyond");
    expectFault(replaced(raw, "offset=\"0\"", "offset=\"-1\""), "its offset is not a number");
    expectFault(replaced(raw, "offset=\"0\"", "offset=\"7\""), "bytes are announced");
    expectFault(replaced(raw, "type=\"Float64\"", "type=\"Float128\""), "its type 'Float128' is not known");
    expectFault(replaced(raw, "NumberOfComponents=\"3\"", "NumberOfComponents=\"2\""), "are needed");
    expectFault(replaced(raw, "UInt32", "UInt16"), "header_type 'UInt16' is not");
    expectFault(replaced(raw, "<VTKFile", "<VTKFile compressor=\"vtkLZ4DataCompressor\""), "the file is corrupt");
    expectFault(replaced(raw, "<VTKFile", "<VTKFile compressor=\"vtkFooCompressor\""),
                "unknown compressor 'vtkFooCompressor'");
    expectFault(replaced(raw, "</Piece>", "</Peace>"), "the element 'Piece' ends with '</Peace>'");
    std::string wild = raw;
    const std::string corners = bytesOf(std::vector<std::int32_t>{0, 1, 2, 1, 2, 3}, true);
    expectFault(replaced(wild, corners, bytesOf(std::vector<std::int32_t>{0, 1, 2, 1, 2, 1000000000}, true)),
                "cell 1 of Polys names point 1000000000 of 4");
    expectFault(replaced(wild, corners, bytesOf(std::vector<std::int32_t>{0, 1, -2, 1, 2, 3}, true)),
                "cell 0 of Polys names point -2 of 4");
    const std::string ends = bytesOf(std::vector<std::int64_t>{3, 6}, true);
    expectFault(replaced(wild, ends, bytesOf(std::vector<std::int64_t>{3, 1000000000000}, true)),
                "cell 1 of Polys has the offset 1000000000000, which is not between 3 and 6");
    expectFault(replaced(wild, ends, bytesOf(std::vector<std::int64_t>{3, 2}, true)), "not between 3 and 6");
    expectFault(replaced(wild, ends, bytesOf(std::vector<std::int64_t>{2, 5}, true)),
                "has 6 corners, its offsets name 5");
    expectFault(replaced(Writer({}).file(), "binary", "ascii"), "is not a number");
}

TEST(VtpFile, XmlThatIsNoneIsNamed) {
    for (const auto& [text, fault] : std::map<std::string, std::string>{
             {"", "no XML element"},
             {"solid", "no XML element"},
             {"<VTKFile type=\"PolyData\"", "name is missing"},
             {"<VTKFile type=\"PolyData>", "does not end"},
             {"<VTKFile type=PolyData></VTKFile>", "is not quoted"},
             {"<VTKFile type=\"PolyData\" type=\"PolyData\"></VTKFile>", "stands twice"},
             {"<VTKFile type=\"&boo;\"></VTKFile>", "unknown entity '&boo;'"},
             {"<!DOCTYPE a [<!ENTITY b \"c\">]><VTKFile/>", "a document type is not read"},
             {"<VTKFile type=\"PolyData\"></VTKFile>", "the element PolyData is missing"},
             {"<VTKFile type=\"PolyData\"><PolyData/></VTKFile>", "the element Piece is missing"},
             {"<VTKFile type=\"ImageData\"/>", "no VTK XML PolyData"}})
        expectFault(text, fault);
    std::string deep;
    for (int i = 0; i < 100000; ++i) deep += "<a>";
    expectFault(deep, "nested too deeply");
}

// The same for a file written by Corpuscle: whichever byte is changed, the result must be the same data or a message.
TEST(VtpFile, AChangedByteNeverEndsTheProgram) {
    TemporaryFolder folder;
    PolyData data;
    data.points = {{0, 0, 0}, {1e-6, 0, 0}, {0, 1e-6, 0}, {0, 0, 1.0 / 3.0}};
    data.triangles = {{0, 1, 2}, {1, 2, 3}};
    data.point.integers["id"] = {0, 1, 2, 3};
    data.texts["key"] = "value";
    const auto path = folder.path() / "a.vtp";
    writeVtp(path, data);
    const std::string bytes = readWholeVtkFile(path);
    int refused = 0;
    for (std::size_t i = 0; i < bytes.size(); ++i)
        for (const int flip : {1, 0x80, 0xFF}) {
            std::string changed = bytes;
            changed[i] = static_cast<char>(changed[i] ^ flip);
            const std::string text = messageOf<Failure>([&] { parseVtp(changed, "a.vtp"); });
            refused += !text.empty();
            ASSERT_EQ(text.find("std::"), std::string::npos) << i << text;
        }
    EXPECT_GT(refused, static_cast<int>(bytes.size()));
}

}  // namespace
}  // namespace corpuscle::io
