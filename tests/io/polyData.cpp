// .vtp files: every bit is read back as written, and every fault of a file is named.
#include "io/polyData.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <numeric>

#include "core/error.hpp"
#include "io/temporaryFolder.hpp"

namespace corpuscle::io {
namespace {

PolyData membrane() {
    PolyData data;
    data.points = {{0, 0, 0}, {1e-6, 0, 0}, {0, 1e-6, 0}, {0, 0, 1.0 / 3.0}};
    data.triangles = {{0, 1, 2}, {1, 2, 3}};
    data.point.scalars["stretch"] = {1, 1.05, M_PI, -0.0};
    data.point.vectors["force"] = {{1, 2, 3}, {4, 5, 6}, {7, 8, 9}, {1e-300, 0, -1e300}};
    data.point.integers["id"] = {0, -1, (std::int64_t{1} << 60) + 1, std::numeric_limits<std::int64_t>::min()};
    data.cell.scalars["areaStrain"] = {0.1, 0.2};
    data.cell.integers["broken"] = {0, 1};
    data.field["strain"] = 2.5;
    data.texts = {
        {"system/mesh.yaml:domain.size", "[1 um, 2 um, 3 um]"}, {"empty", ""}, {"odd", "\"<a & b>\"\n\u00b5"}};
    return data;
}

std::string cut(const std::filesystem::path& path, std::uintmax_t bytes) {
    std::filesystem::resize_file(path, bytes);
    return messageOf<Failure>([&] { readVtp(path); });
}

TEST(Vtp, MembraneComesBackToTheBit) {
    TemporaryFolder folder;
    const auto path = folder.path() / "rbc.vtp";
    const PolyData before = membrane();
    writeVtp(path, before);
    const PolyData after = readVtp(path);
    EXPECT_EQ(after.points, before.points);
    EXPECT_EQ(after.triangles, before.triangles);
    EXPECT_EQ(after.point.scalars, before.point.scalars);
    EXPECT_TRUE(std::signbit(after.point.scalar("stretch")[3]));
    EXPECT_EQ(after.point.vectors, before.point.vectors);
    EXPECT_EQ(after.point.integers, before.point.integers);
    EXPECT_EQ(after.cell.scalars, before.cell.scalars);
    EXPECT_EQ(after.cell.integers, before.cell.integers);
    EXPECT_EQ(after.field, before.field);
    EXPECT_EQ(after.texts, before.texts);
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1) << "a temporary file remains";
}

// Expat looks at an incomplete tag again when its length has doubled. VTK gives it "<AppendedData", what follows up to
// '>', and an end of 15 bytes (vtpWriter.hpp).
TEST(Vtp, ExpatSeesTheTagOfTheDataInTime) {
    TemporaryFolder folder;
    const auto path = folder.path() / "rbc.vtp";
    writeVtp(path, membrane());
    std::ifstream in(path, std::ios::binary);
    const std::string bytes((std::istreambuf_iterator<char>(in)), {}), tag = "<AppendedData";
    EXPECT_TRUE(bytes.starts_with("<!DOCTYPE VTKFile [<!ATTLIST AppendedData encoding CDATA \"raw\">]>\n<VTKFile "));
    const std::size_t begin = bytes.find(tag, bytes.find("</PolyData>")), attributes = begin + tag.size();
    ASSERT_NE(begin, std::string::npos);
    std::size_t seen = tag.size();
    if (const auto length = bytes.find('>', attributes) - begin; length >= 2 * seen) seen = length;
    EXPECT_GE(bytes.find('>', attributes) - begin + 15, 2 * seen);
    EXPECT_EQ(bytes[bytes.find_first_not_of(" \n", bytes.find('>', attributes) + 1)], '_');
}

TEST(Vtp, PointsAloneAndNothingAtAll) {
    TemporaryFolder folder;
    PolyData fluid;
    for (int i = 0; i < 100000; ++i) fluid.points.emplace_back(i, 0.5 * i, std::sqrt(i));
    fluid.point.integers["id"].resize(fluid.points.size());
    std::iota(fluid.point.integers["id"].begin(), fluid.point.integers["id"].end(), 0);
    writeVtp(folder.path() / "fluid.vtp", fluid);
    const PolyData after = readVtp(folder.path() / "fluid.vtp");
    EXPECT_EQ(after.points, fluid.points);
    EXPECT_EQ(after.point.integer("id"), fluid.point.integers["id"]);
    EXPECT_TRUE(after.triangles.empty());

    PolyData nothing;
    nothing.point.scalars["density"];
    nothing.point.vectors["velocity"];
    writeVtp(folder.path() / "nothing.vtp", nothing);
    const PolyData empty = readVtp(folder.path() / "nothing.vtp");
    EXPECT_TRUE(empty.points.empty());
    EXPECT_TRUE(empty.point.scalar("density").empty());
    EXPECT_TRUE(empty.point.vector("velocity").empty());
}

TEST(Vtp, LinesComeBackWithTheirArrays) {
    TemporaryFolder folder;
    PolyData rims;
    rims.points = {{0, 0, 0}, {1e-6, 0, 0}, {0, 1e-6, 0}, {0, 0, 1}, {0, 0, 2}};
    rims.lines = {{0, 1, 2, 0}, {3, 4}};
    rims.cell.integers["hole"] = {2, 1};
    writeVtp(folder.path() / "holes.vtp", rims);
    const PolyData after = readVtp(folder.path() / "holes.vtp");
    EXPECT_EQ(after.points, rims.points);
    EXPECT_EQ(after.lines, rims.lines);
    EXPECT_TRUE(after.triangles.empty());
    EXPECT_EQ(after.cell.integer("hole"), rims.cell.integer("hole"));
    rims.lines[1][1] = 5;
    EXPECT_THROW(writeVtp(folder.path() / "a.vtp", rims), std::invalid_argument);
    rims.lines[1][1] = 4;
    rims.triangles = {{0, 1, 2}};
    EXPECT_THROW(writeVtp(folder.path() / "a.vtp", rims), std::invalid_argument);
}

TEST(Vtp, SaysWhichArrayIsMissingOrOfTheWrongType) {
    TemporaryFolder folder;
    writeVtp(folder.path() / "rbc.vtp", membrane());
    const PolyData data = readVtp(folder.path() / "rbc.vtp");
    const std::string missing = messageOf<Failure>([&] { data.point.scalar("strech"); });
    EXPECT_NE(missing.find("rbc.vtp: point array 'strech'"), std::string::npos) << missing;
    EXPECT_NE(missing.find("force, id, stretch"), std::string::npos) << missing;
    EXPECT_NE(missing.find("Did you mean 'stretch'?"), std::string::npos) << missing;
    const std::string wrong = messageOf<Failure>([&] { data.point.scalar("id"); });
    EXPECT_NE(wrong.find("holds integers"), std::string::npos) << wrong;
}

TEST(Vtp, SaysThatAFileIsMissingOrCutOrForeign) {
    TemporaryFolder folder;
    const auto path = folder.path() / "rbc.vtp";
    EXPECT_NE(messageOf<Failure>([&] { readVtp(path); }).find("no such file"), std::string::npos);
    for (const double part : {0.0, 0.3, 0.9}) {
        writeVtp(path, membrane());
        const auto size = std::filesystem::file_size(path);
        const std::string message = cut(path, static_cast<std::uintmax_t>(part * static_cast<double>(size)));
        EXPECT_NE(message.find("cut off"), std::string::npos) << part << message;
    }
    std::ofstream(path) << "<?xml version=\"1.0\"?><VTKFile type=\"ImageData\"></VTKFile>";
    EXPECT_NE(messageOf<Failure>([&] { readVtp(path); }).find("no VTK XML PolyData"), std::string::npos);
}

TEST(Vtp, MissingBytesInTheMiddleAreSeen) {
    TemporaryFolder folder;
    const auto path = folder.path() / "rbc.vtp";
    writeVtp(path, membrane());
    std::ifstream in(path, std::ios::binary);
    std::string bytes((std::istreambuf_iterator<char>(in)), {});
    const auto data = bytes.find("<AppendedData");
    bytes.erase(data + 60, 150);
    std::ofstream(path, std::ios::binary) << bytes;
    const std::string message = messageOf<Failure>([&] { readVtp(path); });
    EXPECT_NE(message.find("rbc.vtp"), std::string::npos) << message;
}

TEST(Vtp, WrongLengthsAndIndicesAreRefused) {
    TemporaryFolder folder;
    PolyData data = membrane();
    data.point.scalars["stretch"].pop_back();
    EXPECT_THROW(writeVtp(folder.path() / "a.vtp", data), std::invalid_argument);
    data = membrane();
    data.triangles[1][2] = 4;
    EXPECT_THROW(writeVtp(folder.path() / "a.vtp", data), std::invalid_argument);
}

TEST(Vtp, UnwritablePlaceIsNamed) {
    const std::string message = messageOf<Failure>([] { writeVtp("/nonexistent/folder/a.vtp", membrane()); });
    EXPECT_NE(message.find("/nonexistent/folder/a.vtp"), std::string::npos) << message;
}

}  // namespace
}  // namespace corpuscle::io
