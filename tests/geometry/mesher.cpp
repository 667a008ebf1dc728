#include "geometry/mesher.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <numbers>

#include "core/error.hpp"
#include "geometry/enclosedVolume.hpp"
#include "geometry/evansFung.hpp"
#include "geometry/fileShape.hpp"
#include "geometry/kuchelFackerell.hpp"
#include "geometry/spheroid.hpp"

using namespace corpuscle;
using namespace corpuscle::geometry;

namespace {

const KuchelFackerell redCell(8e-6, 2.12e-6, 1e-6);
constexpr double micro = 1e-6;

// Kuchel-Fackerell cell of 8, 2.12, 1 um: area 128.0304 um^2, volume 85.9883 fL (30-digit quadrature; grade: analytic).
TEST(Mesher, redCellAtFourEdgeLengths) {
    std::printf("edge um   nodes  area um^2   error     order  volume fL  error     order  angle  residual/d^4\n");
    double lastEdge = 1e-3, lastArea = 1, lastVolume = 1;
    for (const double edge : {1.0, 0.5, 0.25, 0.1}) {
        const TriangleMesh mesh = meshSurface(redCell, edge * micro);
        const MeshQuality q = meshQuality(mesh, &redCell);
        double residual = 0;
        for (const Vec3& x : mesh.nodes)
            residual = std::max(residual, std::abs(redCell.implicit(x)) / std::pow(redCell.d, 4));
        const double area = std::abs(q.area * 1e12 / 128.030428 - 1),
                     volume = std::abs(q.volume * 1e18 / 85.988326 - 1);
        const double ratio = std::log(lastEdge / q.edgeMean);
        const double areaOrder = std::log(lastArea / area) / ratio, volumeOrder = std::log(lastVolume / volume) / ratio;
        std::printf("%-8g %6d  %-10.4f  %.2e  %-5.2f  %-9.4f  %.2e  %-5.2f  %-5.1f  %.1e\n", edge, q.nodes,
                    q.area * 1e12, area, areaOrder, q.volume * 1e18, volume, volumeOrder, q.angleMin, residual);
        EXPECT_TRUE(q.closed);
        EXPECT_EQ(q.euler, 2);
        EXPECT_GT(q.angleMin, 30);
        EXPECT_NEAR(q.edgeMean / (edge * micro), 1, 0.1);
        EXPECT_LT(q.edgeMax, 1.75 * edge * micro);
        EXPECT_LT(residual, 1e-10);
        if (edge < 1) {
            // An edge of 1 um equals the radius of curvature of the rim; there the asymptotic order is not reached yet.
            const double tolerance = edge > 0.4 ? 0.7 : 0.2;
            EXPECT_NEAR(areaOrder, 2, tolerance);
            EXPECT_NEAR(volumeOrder, 2, tolerance);
        }
        lastEdge = q.edgeMean;
        lastArea = area;
        lastVolume = volume;
    }
    EXPECT_LT(lastArea, 5e-4);
    EXPECT_LT(lastVolume, 1e-3);
}

// The mesh encloses the volume of the shape; its area is compared too. Volumes and areas of the shapes come from
// quadrature or formulas, not from meshes.
TEST(EnclosedVolume, isThatOfTheShape) {
    const Sphere ball(3e-6);
    const Spheroid flat(4e-6, 1.2e-6);
    const struct {
        const char* name;
        const Shape& shape;
        double area, volume, edge;
    } cases[] = {{"red cell", redCell, 128.030428e-12, 85.988326e-18, 0.5e-6},
                 {"red cell", redCell, 128.030428e-12, 85.988326e-18, 0.25e-6},
                 {"ball", ball, 36e-12 * std::numbers::pi, 36e-18 * std::numbers::pi, 1e-6},
                 {"ball", ball, 36e-12 * std::numbers::pi, 36e-18 * std::numbers::pi, 0.5e-6},
                 {"flat spheroid", flat, flat.area(), 4.0 / 3 * std::numbers::pi * 16e-12 * 1.2e-6, 0.5e-6}};
    double lastArea = 0;
    const char* last = "";
    for (const auto& one : cases) {
        TriangleMesh mesh = meshSurface(one.shape, one.edge);
        const double areaBefore = mesh.area() / one.area - 1, volumeBefore = mesh.volume() / one.volume - 1;
        const std::vector<Vec3> nodes = mesh.nodes;
        encloseVolume(mesh, one.shape);
        const double area = mesh.area() / one.area - 1;
        double furthest = 0;
        for (std::size_t m = 0; m < nodes.size(); ++m) furthest = std::max(furthest, (mesh.nodes[m] - nodes[m]).norm());
        std::printf("%-14s edge %.2f um: volume %+.2e -> %+.1e, area %+.2e -> %+.2e, nodes moved by %.3f edges\n",
                    one.name, one.edge / micro, volumeBefore, mesh.volume() / one.volume - 1, areaBefore, area,
                    furthest / one.edge);
        EXPECT_NEAR(mesh.volume() / one.volume, 1, 1e-7) << one.name;  // the reference has no more digits
        EXPECT_NEAR(mesh.volume() / one.shape.volume(), 1, 1e-10) << one.name;
        EXPECT_LT(volumeBefore, -1e-3);
        EXPECT_LT(std::abs(area), 0.6 * std::abs(areaBefore)) << one.name;
        EXPECT_LT(furthest, 0.25 * one.edge);
        EXPECT_TRUE(checkClosedManifold(mesh).empty());
        EXPECT_TRUE(selfIntersections(mesh).empty());
        if (std::string(last) == one.name) {
            EXPECT_NEAR(std::log2(lastArea / area), 2, 0.4) << one.name;
        }
        lastArea = area, last = one.name;
    }
}

TEST(EnclosedVolume, thatNoMoveReachesIsRefused) {
    struct Larger : Sphere {
        using Sphere::Sphere;
        double volume() const override { return 1.5 * Sphere::volume(); }
    };
    const Larger shape(3e-6);
    TriangleMesh mesh = meshSurface(shape, 1e-6);
    try {
        encloseVolume(mesh, shape);
        FAIL();
    } catch (const Failure& failure) {
        EXPECT_EQ(failure.code(), ExitCode::invalidCase);
        EXPECT_NE(std::string(failure.what()).find("it lacks 36 % of it"), std::string::npos) << failure.what();
    }
}

TEST(EnclosedVolume, ofAMeshThatIsTheShapeChangesNothing) {
    TriangleMesh ball = meshSurface(Sphere(3e-6), 1e-6);
    const std::filesystem::path file = std::filesystem::temp_directory_path() / "corpuscleEnclosed.off";
    {
        std::ofstream out(file);
        out.precision(17);
        out << "OFF\n" << ball.nodes.size() << ' ' << ball.triangles.size() << " 0\n";
        for (const Vec3& x : ball.nodes) out << 1e6 * x[0] << ' ' << 1e6 * x[1] << ' ' << 1e6 * x[2] << '\n';
        for (const Index3& t : ball.triangles) out << "3 " << t[0] << ' ' << t[1] << ' ' << t[2] << '\n';
    }
    FileShape shape;
    shape.file = file.string();
    shape.prepare(".");
    std::filesystem::remove(file);
    TriangleMesh mesh = *shape.triangulation();
    const std::vector<Vec3> nodes = mesh.nodes;
    encloseVolume(mesh, shape);
    for (std::size_t m = 0; m < nodes.size(); ++m) EXPECT_LT((mesh.nodes[m] - nodes[m]).norm(), 1e-12);
}

TEST(Mesher, theTwoDimplesStayApart) {
    const TriangleMesh mesh = meshSurface(redCell, 1 * micro);
    for (const MeshEdge& e : mesh.edges()) {
        const Vec3 middle = (mesh.nodes[e.a] + mesh.nodes[e.b]) / 2;
        if (std::hypot(middle.x(), middle.y()) > 3 * micro) continue;
        EXPECT_GT(mesh.nodes[e.a].z() * mesh.nodes[e.b].z(), 0);
    }
}

TEST(Mesher, otherShapes) {
    const EvansFung fung;
    const Sphere sphere(3 * micro);
    const Spheroid oblate(4 * micro, 1.06 * micro), prolate(2 * micro, 5 * micro);
    for (const Shape* shape : {static_cast<const Shape*>(&fung), static_cast<const Shape*>(&sphere),
                               static_cast<const Shape*>(&oblate), static_cast<const Shape*>(&prolate)}) {
        const MeshQuality q = meshQuality(meshSurface(*shape, 0.4 * micro), shape);
        EXPECT_TRUE(q.closed);
        EXPECT_GT(q.angleMin, 30);
        EXPECT_NEAR(q.edgeMean / (0.4 * micro), 1, 0.1);
        EXPECT_LT(std::abs(q.areaError), 0.02);
        EXPECT_LT(std::abs(q.volumeError), 0.02);
        EXPECT_LT(q.residual, 1e-14);
    }
}

TEST(Mesher, sameInputSameMesh) {
    const TriangleMesh first = meshSurface(redCell, 0.4 * micro);
    const std::vector<std::vector<char>> otherAddresses(1000, std::vector<char>(333));
    const TriangleMesh second = meshSurface(redCell, 0.4 * micro);
    ASSERT_EQ(first.nodes.size(), second.nodes.size());
    EXPECT_EQ(first.triangles, second.triangles);
    for (std::size_t n = 0; n < first.nodes.size(); ++n) EXPECT_EQ(first.nodes[n], second.nodes[n]);
}

// Writers for a closed surface in micrometres, one for each format that can be read.
void writeLines(const TriangleMesh& mesh, std::ofstream& file) {
    for (const Vec3& x : mesh.nodes) file << x.transpose() * 1e6 << '\n';
    for (const Index3& t : mesh.triangles) file << "3 " << t[0] << ' ' << t[1] << ' ' << t[2] << '\n';
}
void writeOff(const TriangleMesh& mesh, std::ofstream& file) {
    file << "OFF\n" << mesh.nodes.size() << ' ' << mesh.triangles.size() << " 0\n";
    writeLines(mesh, file);
}
void writePly(const TriangleMesh& mesh, std::ofstream& file) {
    file << "ply\nformat ascii 1.0\nelement vertex " << mesh.nodes.size()
         << "\nproperty double x\nproperty double y\nproperty double z\nelement face " << mesh.triangles.size()
         << "\nproperty list uchar int vertex_indices\nend_header\n";
    writeLines(mesh, file);
}
void writeVtp(const TriangleMesh& mesh, std::ofstream& file) {
    file << R"(<VTKFile type="PolyData" version="0.1" byte_order="LittleEndian"><PolyData><Piece NumberOfPoints=")"
         << mesh.nodes.size() << R"(" NumberOfPolys=")" << mesh.triangles.size()
         << R"("><Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">)";
    for (const Vec3& x : mesh.nodes) file << '\n' << x.transpose() * 1e6;
    file << R"(</DataArray></Points><Polys><DataArray type="Int64" Name="connectivity" format="ascii">)";
    for (const Index3& t : mesh.triangles) file << '\n' << t[0] << ' ' << t[1] << ' ' << t[2];
    file << R"(</DataArray><DataArray type="Int64" Name="offsets" format="ascii">)";
    for (std::size_t t = 1; t <= mesh.triangles.size(); ++t) file << ' ' << 3 * t;
    file << "</DataArray></Polys></Piece></PolyData></VTKFile>\n";
}
void writeBinaryStl(const TriangleMesh& mesh, std::ofstream& file) {
    const auto put = [&](const auto& value) { file.write(reinterpret_cast<const char*>(&value), sizeof value); };
    file << std::string(80, ' ');
    put(static_cast<std::uint32_t>(mesh.triangles.size()));
    for (const Index3& t : mesh.triangles) {
        const auto putVector = [&](const Vec3& x) {
            for (int k = 0; k < 3; ++k) put(static_cast<float>(x[k]));
        };
        putVector(Vec3::Zero());  // no normal given
        for (const int node : t) putVector(mesh.nodes[static_cast<std::size_t>(node)] * 1e6);
        put(std::uint16_t{0});
    }
}

TEST(Mesher, remeshesAFileOfEveryFormat) {
    const TriangleMesh fine = meshSurface(redCell, 0.3 * micro);
    const std::map<std::string, void (*)(const TriangleMesh&, std::ofstream&)> writers{
        {"off", writeOff}, {"ply", writePly}, {"vtp", writeVtp}, {"stl", writeBinaryStl}};
    for (const auto& [ending, write] : writers) {
        const std::string path = testing::TempDir() + "corpuscleCell." + ending;
        std::ofstream file(path, std::ios::binary);
        file.precision(17);
        write(fine, file);
        file.close();
        FileShape shape;
        shape.file = path;
        shape.prepare("/");
        EXPECT_EQ(shape.triangulation()->nodes.size(), fine.nodes.size()) << ending;
        EXPECT_NEAR(shape.volume() / fine.volume(), 1, 1e-5) << ending;
        const TriangleMesh mesh = meshSurface(shape, 0.5 * micro);
        const MeshQuality q = meshQuality(mesh, &shape);
        EXPECT_TRUE(q.closed) << ending;
        EXPECT_GT(q.angleMin, 30) << ending;
        EXPECT_NEAR(q.edgeMean / (0.5 * micro), 1, 0.1) << ending;
        EXPECT_NEAR(q.volume * 1e18, 85.99, 2.5) << ending;
    }
}

TEST(Mesher, refusesAnEdgeThatDoesNotSuit) {
    EXPECT_THROW(meshSurface(redCell, 3 * micro), Failure);
    EXPECT_THROW(meshSurface(redCell, 0), Failure);
    // Less than half the radius, but as long as the distance between the dimples.
    try {
        meshSurface(redCell, 1.4 * micro);
        ADD_FAILURE() << "meshed at 1.4 um";
    } catch (const Failure& failure) {
        EXPECT_EQ(failure.code(), ExitCode::invalidCase);
        EXPECT_NE(std::string(failure.what()).find("edge = 1.4 um is too coarse"), std::string::npos) << failure.what();
    }
}

}  // namespace
