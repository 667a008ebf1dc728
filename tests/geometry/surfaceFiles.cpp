// Surfaces from files of other programs: each valid dialect is read; for each invalid one the message states what is
// wrong.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <bit>
#include <cstring>
#include <fstream>

#include "core/error.hpp"
#include "geometry/fileShape.hpp"
#include "geometry/mesher.hpp"
#include "geometry/readSurface.hpp"
#include "geometry/spheroid.hpp"
#include "geometry/surfaceAlgorithms.hpp"

namespace corpuscle::geometry {
namespace {

// A sphere of radius 4: 42 nodes, 80 triangles.
const TriangleMesh& ball() {
    static const TriangleMesh mesh = starSurface([](const Vec3& x) { return x.norm() - 4; }, Vec3::Constant(4), 1);
    return mesh;
}

std::string replaced(std::string text, const std::string& from, const std::string& to, bool all = true) {
    for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size())) {
        text.replace(at, from.size(), to);
        if (!all) break;
    }
    return text;
}

std::string asciiStl(const TriangleMesh& mesh, const std::string& name = "cell", double noise = 0) {
    std::string text = "solid " + name + "\n";
    int n = 0;
    for (const Index3& t : mesh.triangles) {
        text += " facet normal 0 0 0\n  outer loop\n";
        for (const int i : t) {
            const Vec3 x = mesh.nodes[i] + noise * Vec3(n % 3 - 1, n % 5 - 2, n % 7 - 3);
            text += fmt::format("   vertex {:.17g} {:.17g} {:.17g}\n", x.x(), x.y(), x.z());
            ++n;
        }
        text += "  endloop\n endfacet\n";
    }
    return text + "endsolid " + name + "\n";
}

template <class T>
void put(std::string& bytes, T value, bool little = true) {
    char raw[sizeof value];
    std::memcpy(raw, &value, sizeof value);
    if (little != (std::endian::native == std::endian::little)) std::reverse(raw, raw + sizeof value);
    bytes.append(raw, sizeof value);
}

std::string binaryStl(const TriangleMesh& mesh, std::string header = "", int countOff = 0) {
    header.resize(80, ' ');
    put(header, static_cast<std::uint32_t>(static_cast<int>(mesh.triangles.size()) + countOff));
    for (const Index3& t : mesh.triangles) {
        for (int k = 0; k < 3; ++k) put(header, 0.f);
        for (const int i : t)
            for (int k = 0; k < 3; ++k) put(header, static_cast<float>(mesh.nodes[i][k]));
        put(header, std::uint16_t{0x801F});
    }
    return header;
}

std::string off(const TriangleMesh& mesh, const std::string& head = "OFF", const std::string& extra = "",
                int base = 0) {
    std::string text = fmt::format("{}\n# made by hand\n\n{} {} 0\n", head, mesh.nodes.size(), mesh.triangles.size());
    for (const Vec3& x : mesh.nodes) text += fmt::format("{:.9g}\t{:.9g} {:.9g}{}\n", x.x(), x.y(), x.z(), extra);
    for (const Index3& t : mesh.triangles)
        text += fmt::format("3 {} {} {}  # a face\n", t[0] + base, t[1] + base, t[2] + base);
    return text;
}

std::string ply(const TriangleMesh& mesh, const std::string& format, bool extras = true) {
    std::string text = "ply\nformat " + format + " 1.0\ncomment by hand\n";
    if (extras) text += "element camera 2\nproperty float fov\nproperty list uchar short pixels\n";
    text += fmt::format("element vertex {}\n", mesh.nodes.size());
    if (extras) text += "property uchar red\n";
    text += "property float x\nproperty double y\nproperty float z\n";
    if (extras) text += "property float nx\n";
    text += fmt::format("element face {}\nproperty list uchar int vertex_indices\n", mesh.triangles.size());
    if (extras) text += "property list uchar float texcoord\n";
    text += "end_header\n";
    const bool ascii = format == "ascii", little = format != "binary_big_endian";
    const auto number = [&](auto value) {
        if (ascii)
            text += fmt::format("{} ", static_cast<double>(value));
        else
            put(text, value, little);
    };
    const auto end = [&] {
        if (ascii) text += "\n";
    };
    for (int c = 0; c < 2 && extras; ++c) {
        number(0.5f), number(std::uint8_t{2}), number(std::int16_t{-3}), number(std::int16_t{7});
        end();
    }
    for (const Vec3& x : mesh.nodes) {
        if (extras) number(std::uint8_t{200});
        number(static_cast<float>(x.x())), number(x.y()), number(static_cast<float>(x.z()));
        if (extras) number(0.25f);
        end();
    }
    for (const Index3& t : mesh.triangles) {
        number(std::uint8_t{3});
        for (const int i : t) number(static_cast<std::int32_t>(i));
        if (extras) number(std::uint8_t{1}), number(0.5f);
        end();
    }
    return text;
}

std::string vtp(const TriangleMesh& mesh, const std::string& cells = "", const std::string& counts = "") {
    std::string text = fmt::format(
        R"(<?xml version="1.0"?><VTKFile type="PolyData" version="0.1" byte_order="LittleEndian"><PolyData>
<Piece NumberOfPoints="{}" {}><Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">)",
        mesh.nodes.size(), counts.empty() ? fmt::format(R"(NumberOfPolys="{}")", mesh.triangles.size()) : counts);
    for (const Vec3& x : mesh.nodes) text += fmt::format("{:.17g} {:.17g} {:.17g}\n", x.x(), x.y(), x.z());
    text += "</DataArray></Points>";
    if (cells.empty()) {
        text += R"(<Polys><DataArray type="Int64" Name="connectivity" format="ascii">)";
        for (const Index3& t : mesh.triangles) text += fmt::format("{} {} {}\n", t[0], t[1], t[2]);
        text += R"(</DataArray><DataArray type="Int64" Name="offsets" format="ascii">)";
        for (std::size_t t = 1; t <= mesh.triangles.size(); ++t) text += fmt::format(" {}", 3 * t);
        text += "</DataArray></Polys>";
    }
    return text + cells + "</Piece></PolyData></VTKFile>\n";
}

void expectBall(const std::string& bytes, const std::string& ending, const std::string& what,
                const std::string& remark = "") {
    try {
        const SurfaceFromFile surface = parseSurface(bytes, ending, "s" + ending);
        EXPECT_EQ(surface.mesh.nodes.size(), ball().nodes.size()) << what;
        EXPECT_EQ(surface.mesh.triangles.size(), ball().triangles.size()) << what;
        EXPECT_NEAR(surface.mesh.volume() / ball().volume(), 1, 1e-6) << what;
        EXPECT_EQ(checkClosedManifold(surface.mesh), std::vector<std::string>()) << what;
        std::string all;
        for (const std::string& text : surface.remarks) all += text + "\n";
        if (remark.empty())
            EXPECT_EQ(all, "") << what;
        else
            EXPECT_NE(all.find(remark), std::string::npos) << what << ": " << all;
    } catch (const Failure& failure) {
        ADD_FAILURE() << what << ": " << failure.what();
    }
}

void expectFault(const std::string& bytes, const std::string& ending, const std::string& message) {
    try {
        parseSurface(bytes, ending, "s" + ending);
        ADD_FAILURE() << "accepted, instead of: " << message;
    } catch (const Failure& failure) {
        EXPECT_EQ(failure.code(), ExitCode::invalidCase);
        EXPECT_NE(std::string(failure.what()).find(message), std::string::npos)
            << "expected: " << message << "\nfound: " << failure.what();
    }
}

TEST(SurfaceFile, StlDialectsAreRead) {
    const std::string plain = asciiStl(ball());
    expectBall(plain, ".stl", "plain");
    expectBall(replaced(plain, "solid cell", "solid\tcell"), ".stl", "tab");
    expectBall("\xEF\xBB\xBF" + plain, ".stl", "byte-order mark");
    expectBall(asciiStl(ball(), "my solid cell"), ".stl", "solid in the name");
    expectBall(asciiStl(ball(), ""), ".stl", "no name");
    expectBall(asciiStl(ball(), "facet of an endsolid thing"), ".stl", "keywords in the name");
    expectBall(replaced(plain, "\n", "\r\n"), ".stl", "CRLF");
    expectBall(replaced(plain, "\n", "\r"), ".stl", "CR");
    expectBall(replaced(plain, "\n", " "), ".stl", "one line");
    expectBall("\n\n  " + plain + "\n\n", ".stl", "blank lines");
    std::string upper = plain;
    for (char& c : upper) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    expectBall(upper, ".stl", "upper case");
    expectBall(replaced(plain, "normal 0 0 0", "normal nan -nan(ind) nan"), ".stl", "normals that are NaN");
    expectBall(binaryStl(ball()), ".stl", "binary");
    expectBall(binaryStl(ball(), "solid cell\nfacet normal"), ".stl", "binary that begins with solid");
    expectBall(asciiStl(ball(), "c", 1e-14), ".stl", "rounding noise",
               "points that differ by rounding were merged into 42");
    expectBall(asciiStl(ball(), "c", 5e-7), ".stl", "noise of float",
               "points that differ by rounding were merged into 42");
}

TEST(SurfaceFile, StlFaultsAreNamed) {
    const std::string plain = asciiStl(ball());
    expectFault(replaced(plain, ".", ","), ".stl", "has a comma: write decimals with a point");
    expectFault(plain.substr(0, plain.size() / 2), ".stl", "whole triangles and without 'endsolid': it is cut off");
    expectFault(plain.substr(0, plain.size() - 15), ".stl", "after 80 whole triangles");
    expectFault(replaced(plain, "endloop", "vertex 1 2 3\n  endloop", false), ".stl",
                "'vertex' stands where 'endloop' is expected");
    expectFault(replaced(plain, "   vertex", "   vertx", false), ".stl", "line 4: 'vertx' stands where 'vertex'");
    expectFault(replaced(plain, "   vertex", "   vertex nan", false), ".stl", "line 4: 'nan' is not a finite number");
    expectFault(binaryStl(ball(), "", 1), ".stl",
                "announces 81 triangles, which take 4134 bytes, and the file has 4084");
    expectFault(binaryStl(ball(), "", -1), ".stl", "announces 79 triangles");
    expectFault(binaryStl(ball()).substr(0, 2000), ".stl", "cut off");
    expectFault("", ".stl", "the file is empty");
    expectFault("solid nothing\nendsolid nothing\n", ".stl", "no triangles");
    expectFault(off(ball()), ".stl", "first bytes are those of a .off file: rename it");
    expectFault(std::string("\xFF\xFEs\0o\0l\0i\0d\0", 12) + std::string(200, '\0'), ".stl", "UTF-16");
}

TEST(SurfaceFile, OffDialectsAreRead) {
    expectBall(off(ball()), ".off", "plain with comments");
    expectBall(off(ball(), "off"), ".off", "lower case");
    expectBall(off(ball(), "COFF", " 255 0 0 255"), ".off", "COFF");
    expectBall(off(ball(), "COFF", " 0.5 0 0"), ".off", "COFF of three");
    expectBall(off(ball(), "NOFF", " 0 0 1"), ".off", "NOFF");
    expectBall(off(ball(), "CNOFF", " 0 0 1 255 0 0 255"), ".off", "CNOFF");
    expectBall(replaced(off(ball()), "  # a face", " 0.7 0.1 0.1"), ".off", "colours of faces");
    expectBall(replaced(off(ball()), "\n", "\r\n"), ".off", "CRLF");
    expectBall(replaced(off(ball()), "OFF\n# made by hand\n\n", "OFF "), ".off", "counts in the first line");
}

TEST(SurfaceFile, OffFaultsAreNamed) {
    expectFault(off(ball(), "OFF", "", 1), ".off", "count the 42 points from 1 to 42; OFF counts from 0");
    expectFault(off(ball(), "OFF", "", 1000000000), ".off", "names point 1000000");
    expectFault(off(ball(), "OFF", "", -5), ".off", "names point -");
    expectFault(off(ball(), "4OFF", " 1"), ".off", "'4OFF' is not read");
    expectFault(off(ball(), "OFF BINARY"), ".off", "binary OFF is not read");
    expectFault(replaced(off(ball()), "42 80 0", "1000000000 80 0"), ".off", "1000000000 points are announced");
    expectFault(replaced(off(ball()), "42 80 0", "42 79 0"), ".off", "there is more behind");
    expectFault(replaced(off(ball()), "42 80 0", "42 81 0"), ".off", "after 80 of 81 faces: it is cut off");
    expectFault(off(ball(), "OFF", " 3"), ".off", "4 numbers stand where a point of 3 is expected");
    expectFault(replaced(off(ball()), "\n3 ", "\n2 ", false), ".off", "a face of 2 corners");
    expectFault(replaced(off(ball()), "42 80 0", "42 80 0\n1e400 0 0", false), ".off",
                "'1e400' is not a finite number");
}

TEST(SurfaceFile, PlyDialectsAreRead) {
    for (const char* format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
        expectBall(ply(ball(), format), ".ply", std::string(format) + " with extra properties");
        expectBall(ply(ball(), format, false), ".ply", format);
    }
    const std::string little = ply(ball(), "binary_little_endian");
    const std::size_t end = little.find("end_header\n") + 11;
    expectBall(replaced(little.substr(0, end), "\n", "\r\n") + little.substr(end), ".ply", "binary with CRLF header");
    expectBall(replaced(ply(ball(), "ascii"), "vertex_indices", "vertex_index"), ".ply", "vertex_index");
    expectBall(replaced(ply(ball(), "ascii"), "property float x", "property float32 x"), ".ply", "float32");
}

TEST(SurfaceFile, PlyFaultsAreNamed) {
    const std::string ascii = ply(ball(), "ascii", false), binary = ply(ball(), "binary_little_endian", false);
    expectFault(replaced(binary, "vertex 42", "vertex 1000000000"), ".ply",
                "1000000000 of the element vertex are announced");
    expectFault(replaced(binary, "face 80", "face 81"), ".ply", "face 80: the file ends here: it is cut off");
    expectFault(replaced(binary, "face 80", "face 79"), ".ply", "there is more behind the elements");
    expectFault(binary.substr(0, binary.size() - 100), ".ply", "cut off");
    expectFault(replaced(ascii, "property double y\n", ""), ".ply", "the element vertex has no property y");
    expectFault(replaced(ascii, "property double y", "property quad y"), ".ply", "'quad' is no type of a property");
    expectFault(replaced(ascii, "format ascii", "format binary_middle_endian"), ".ply", "is not ascii");
    expectFault(replaced(ascii, "\n3 ", "\n3 1000000000 ", false), ".ply", "the line has 5 numbers");
    std::string wild = binary;
    wild.replace(wild.size() - 4, 4, std::string("\x00\xCA\x9A\x3B", 4));
    expectFault(wild, ".ply", "face 79 names point 1000000000, and there are 42");
    expectFault(
        "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\nend_header\n1 "
        "2 3\n",
        ".ply", "no triangles");
}

TEST(SurfaceFile, VtpDialectsAreRead) {
    expectBall(vtp(ball()), ".vtp", "polygons");
    // Each triangle as its own strip where no neighbour is left, otherwise pairs in one strip: (a b c), (b d c) is the
    // strip a b c d.
    std::string strips = R"(<Strips><DataArray type="Int32" Name="connectivity" format="ascii">)", ends;
    int total = 0, count = 0;
    std::vector<bool> used(ball().triangles.size(), false);
    for (std::size_t t = 0; t < used.size(); ++t) {
        if (used[t]) continue;
        used[t] = true;
        const auto& [a, b, c] = ball().triangles[t];
        strips += fmt::format(" {} {} {}", a, b, c);
        total += 3, ++count;
        for (std::size_t u = t + 1; u < used.size(); ++u) {
            if (used[u]) continue;
            int other = -1;
            for (int s = 0; s < 3; ++s)
                if (ball().triangles[u][s] == c && ball().triangles[u][(s + 1) % 3] == b)
                    other = ball().triangles[u][(s + 2) % 3];
            if (other < 0) continue;
            used[u] = true;
            strips += fmt::format(" {}", other);
            ++total;
            break;
        }
        ends += fmt::format(" {}", total);
    }
    strips += R"(</DataArray><DataArray type="Int32" Name="offsets" format="ascii">)" + ends + "</DataArray></Strips>";
    expectBall(vtp(ball(), strips, fmt::format(R"(NumberOfStrips="{}")", count)), ".vtp", "strips");
    EXPECT_LT(count, 60);
    std::string two = vtp(ball());
    const std::size_t begin = two.find("<Piece"), end = two.find("</PolyData>");
    const std::string piece = two.substr(begin, end - begin);
    two.insert(end, replaced(piece, "\"80\"", "\"0\"", false));
    expectBall(two, ".vtp", "a piece of points");
}

TEST(SurfaceFile, PolygonsAreCut) {
    const std::string cube =
        "OFF\n8 6 12\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n"
        "4 0 3 2 1\n4 4 5 6 7\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n";
    const SurfaceFromFile surface = parseSurface(cube, ".off", "cube.off");
    EXPECT_EQ(surface.mesh.triangles.size(), 12u);
    EXPECT_NEAR(surface.mesh.volume(), 1, 1e-14);
    // A prism over an L: its top and bottom are not convex, and a fan around their first corner would extend outside.
    const std::string prism =
        "OFF\n12 8 0\n2 0 0\n2 1 0\n1 1 0\n1 2 0\n0 2 0\n0 0 0\n2 0 1\n2 1 1\n1 1 1\n1 2 1\n0 2 1\n0 0 1\n"
        "6 5 4 3 2 1 0\n6 6 7 8 9 10 11\n4 0 1 7 6\n4 1 2 8 7\n4 2 3 9 8\n4 3 4 10 9\n4 4 5 11 10\n4 5 0 6 11\n";
    const SurfaceFromFile l = parseSurface(prism, ".off", "l.off");
    EXPECT_NEAR(l.mesh.volume(), 3, 1e-14);
    EXPECT_NEAR(l.mesh.area(), 2 * 3 + 8, 1e-13);
    EXPECT_TRUE(checkClosedManifold(l.mesh).empty());
}

TEST(SurfaceFile, InvertedFacetsAreTurnedAndNamed) {
    TriangleMesh mesh = ball();
    for (const int t : {3, 17, 44}) std::swap(mesh.triangles[t][1], mesh.triangles[t][2]);
    expectBall(off(mesh), ".off", "three", "3 of 80 triangles pointed inwards and were turned");
    expectBall(asciiStl(mesh), ".stl", "three", "3 of 80 triangles");
    mesh = ball();
    mesh.flip();
    expectBall(vtp(mesh), ".vtp", "all", "all 80 triangles pointed inwards and were turned");
    for (const int t : {3, 17}) std::swap(mesh.triangles[t][1], mesh.triangles[t][2]);
    expectBall(ply(mesh, "ascii"), ".ply", "all but two", "78 of 80 triangles");
}

TEST(SurfaceFile, LeftoversAreLeftOutAndNamed) {
    TriangleMesh mesh = ball();
    mesh.nodes.emplace_back(1, 2, 3);
    mesh.triangles.push_back({0, 0, 1});
    expectBall(off(mesh), ".off", "leftovers", "1 triangle with two corners at one place was left out");
    expectBall(off(mesh), ".off", "leftovers", "1 point that belongs to no triangle was left out");
}

// Surfaces that can be read but are not valid cells: the message states the number of faults, the place of the first
// and, for a wrong size, the key.
std::string faultOf(const std::string& bytes, const std::string& ending, double scale = 1e-6) {
    const std::string name = "corpuscleFault" + ending;
    std::ofstream(testing::TempDir() + name, std::ios::binary) << bytes;
    FileShape shape;
    shape.file = name;
    shape.scale = scale;
    try {
        shape.prepare(testing::TempDir());
    } catch (const Failure& failure) {
        EXPECT_EQ(failure.code(), ExitCode::invalidCase);
        return failure.what();
    }
    return "accepted";
}
void expectIn(const std::string& text, const std::string& part) {
    EXPECT_NE(text.find(part), std::string::npos) << "expected: " << part << "\nfound: " << text;
}

TEST(SurfaceFile, SizesThatNoCellHasNameTheKeyAndTheUnit) {
    TriangleMesh mesh = ball();
    const double um = mesh.nodes.front().norm();
    ASSERT_NEAR(um, 4, 1e-9);
    expectIn(faultOf(off(mesh), ".off"), "accepted");
    mesh.scale(1e-3);  // written in mm
    expectIn(faultOf(off(mesh), ".off"), "8 nm long with 'scale: 1 um'");
    expectIn(faultOf(off(mesh), ".off"), "with 'scale: 1 mm' it would be 8 um long");
    expectIn(faultOf(off(mesh), ".off", 1e-3), "accepted");
    mesh.scale(1e-3);  // in m
    expectIn(faultOf(off(mesh), ".off"), "with 'scale: 1 m' it would be 8 um long");
    mesh.scale(1e10);  // far too long in um
    expectIn(faultOf(off(mesh), ".off"), "with 'scale: 1 nm' it would be 80 um long");
    expectIn(faultOf(off(ball()), ".off", 1), "8 m long with 'scale: 1 m'");
    expectIn(faultOf(off(ball()), ".off", 1), "with 'scale: 1 um' it would be 8 um long");
    mesh = ball();
    mesh.scale(1e300);
    expectIn(faultOf(off(mesh), ".off"), "cannot be meant");
    mesh = ball();
    mesh.scale(0);
    expectIn(faultOf(off(mesh), ".off"), "all its points lie in one place");
}

TEST(SurfaceFile, SurfacesThatAreNotOneClosedOneAreNamed) {
    TriangleMesh mesh = ball();
    mesh.triangles.pop_back();
    expectIn(faultOf(off(mesh), ".off"),
             "3 open edges with a triangle on one side only: the surface has a hole (first: ");
    mesh = ball();
    const int first = static_cast<int>(mesh.nodes.size());
    for (const Vec3& x : ball().nodes) mesh.nodes.push_back(x + Vec3(10, 0, 0));
    for (const auto& [i, j, k] : ball().triangles) mesh.triangles.push_back({i + first, j + first, k + first});
    expectIn(faultOf(off(mesh), ".off"), "2 separate surfaces");
    mesh = ball();
    mesh.nodes.emplace_back(0, 0, 9);
    const auto& [i, j, k] = ball().triangles.front();
    mesh.triangles.push_back({i, j, 42});
    mesh.triangles.push_back({j, k, 42});
    mesh.triangles.push_back({k, i, 42});
    expectIn(faultOf(off(mesh), ".off"), "3 non-manifold edges with more than two triangles (first: between nodes");
    mesh = ball();
    mesh.nodes.front() *= -1.5;
    expectIn(faultOf(off(mesh), ".off"), "pairs of triangles that cut each other (first: triangles");
    mesh = ball();
    mesh.triangles.push_back(mesh.triangles.front());
    expectIn(faultOf(off(mesh), ".off"), "non-manifold");
}

// Topologically closed, but with every node at an unrelated place: nearly all triangles cut each other.
TEST(SurfaceFile, ACrumpledSurfaceIsNamedInTime) {
    TriangleMesh mesh = starSurface([](const Vec3& x) { return x.norm() - 4; }, Vec3::Constant(4), 5);
    for (std::size_t i = 0; i < mesh.nodes.size(); ++i)
        mesh.nodes[i] =
            Vec3(std::sin(1.0 + 3.0 * double(i)), std::sin(2.0 + 5.0 * double(i)), std::sin(7.0 * double(i)));
    expectIn(faultOf(off(mesh), ".off"), "10000 pairs of triangles, or more, that cut each other (first: triangles");
}

TEST(SurfaceFile, EdgesThatWouldTakeForEverAreRefused) {
    const Sphere sphere(4e-6);
    const std::string why = tooManyTriangles(sphere, 1e-9);
    expectIn(
        why,
        "edge = 0.001 um would make 4.6e+08 triangles, at most 2e+06 are meshed: take an edge of 0.016 um or more");
    EXPECT_EQ(tooManyTriangles(sphere, 0.016e-6), "");
    EXPECT_THROW(meshSurface(sphere, 1e-9), Failure);
}

}  // namespace
}  // namespace corpuscle::geometry
