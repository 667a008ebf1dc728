// The picture tool, run as a user runs it, on spheres whose projected area is known.
#include <gtest/gtest.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "io/polyData.hpp"
#include "io/temporaryFolder.hpp"

namespace corpuscle::io {
namespace {

constexpr double radius = 4e-6;

// Longitudes and latitudes; triangles outwards. Those around the point nearest to the eye of the xz view are broken
// when asked.
PolyData sphere(const Vec3& centre, double strain, bool ruptured) {
    constexpr int n = 48, m = 96;
    PolyData data;
    for (int i = 0; i <= n; ++i) {
        for (int j = 0; j < m; ++j) {
            const double theta = M_PI * i / n, phi = 2 * M_PI * j / m;
            data.points.push_back(centre + radius * Vec3(std::sin(theta) * std::cos(phi),
                                                         std::sin(theta) * std::sin(phi), std::cos(theta)));
        }
    }
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < m; ++j) {
            const int a = i * m + j, b = i * m + (j + 1) % m;
            if (i > 0) data.triangles.push_back({a, a + m, b});
            if (i < n - 1) data.triangles.push_back({b, a + m, b + m});
        }
    }
    for (const auto& t : data.triangles) {
        const Vec3 middle = (data.points[t[0]] + data.points[t[1]] + data.points[t[2]]) / 3 - centre;
        data.cell.scalars["areaStrain"].push_back(0.05 * middle[2] / radius);
        data.cell.scalars["tension1"].push_back(1e-5 * (1 + middle[0] / radius));
        data.cell.integers["broken"].push_back(ruptured && middle[1] < -0.8 * radius);
    }
    data.field["strain"] = strain;
    return data;
}

PolyData shearedFluid() {
    PolyData data;
    constexpr double dx = 0.5e-6;
    for (double x = -7.75e-6; x < 8e-6; x += dx) {
        for (double y = -1.75e-6; y < 2e-6; y += dx) {
            for (double z = -5.75e-6; z < 6e-6; z += dx) {
                data.points.emplace_back(x, y, z);
                data.point.vectors["velocity"].emplace_back(100 * z, 0, 0);
                data.point.scalars["spacing"].push_back(dx);
            }
        }
    }
    return data;
}

// Eleven times from 0 to 1 s, strains from 0 to 5, a membrane that ruptures at strain 3.
void writeCase(const std::filesystem::path& caseDir) {
    std::filesystem::create_directories(caseDir / "results" / "rbc");
    std::ofstream index(caseDir / "results" / "rbc.pvd");
    index << "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\">\n<Collection>\n";
    for (int i = 0; i <= 10; ++i) {
        const std::string file = "rbc/rbc_" + std::to_string(i) + ".vtp";
        writeVtp(caseDir / "results" / file, sphere(Vec3(1e-6 * i, 0, 0), 0.5 * i, i >= 6));
        index << "<DataSet timestep=\"" << 0.1 * i << "\" file=\"" << file << "\"/>\n";
    }
    index << "</Collection>\n</VTKFile>\n";
    std::filesystem::create_directories(caseDir / "0");
    writeVtp(caseDir / "0" / "fluid.vtp", shearedFluid());
}

struct Outcome {
    int exitCode;
    std::string text;
};
Outcome renderCase(const std::filesystem::path& caseDir, const std::string& options) {
    const auto log = caseDir / "log";
    const std::string command = "OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 " RENDER_CASE " -case " +
                                caseDir.string() + " " + options + " > " + log.string() + " 2>&1";
    const int status = std::system(command.c_str());
    std::ifstream file(log);
    std::stringstream text;
    text << file.rdbuf();
    return {WEXITSTATUS(status), text.str()};
}

// What the pixels of a panel are; rows count from the top.
struct Pixels {
    vtkNew<vtkPNGReader> reader;
    explicit Pixels(const std::filesystem::path& path) {
        reader->SetFileName(path.c_str());
        reader->Update();
    }
    int width() { return reader->GetOutput()->GetDimensions()[0]; }
    int height() { return reader->GetOutput()->GetDimensions()[1]; }
    const unsigned char* at(int x, int y) {
        return static_cast<unsigned char*>(reader->GetOutput()->GetScalarPointer(x, height() - 1 - y, 0));
    }
    template <class Is>
    int count(const nlohmann::json& panel, Is&& is) {
        int number = 0;
        const int x0 = panel["x"], y0 = panel["y"], w = panel["width"], h = panel["height"];
        for (int y = y0; y < y0 + h; ++y) {
            for (int x = x0; x < x0 + w; ++x) number += is(at(x, y));
        }
        return number;
    }
};
bool isReddish(const unsigned char* c) { return c[0] > c[1] + 15; }
bool isBright(const unsigned char* c) { return c[0] > 150 && c[0] > c[1] + 60; }
bool isWhite(const unsigned char* c) { return c[0] == 255 && c[1] == 255 && c[2] == 255; }

class RenderCase : public ::testing::Test {
  protected:
    static void SetUpTestSuite() {
        folder_ = std::make_unique<TemporaryFolder>();
        writeCase(folder_->path());
    }
    static void TearDownTestSuite() { folder_.reset(); }
    static const std::filesystem::path& caseDir() { return folder_->path(); }
    static nlohmann::json draw(const std::string& options) {
        const Outcome run = renderCase(caseDir(), "-json -quiet " + options);
        EXPECT_EQ(run.exitCode, 0) << run.text;
        return run.exitCode == 0 ? nlohmann::json::parse(run.text) : nlohmann::json();
    }
    static std::unique_ptr<TemporaryFolder> folder_;
};
std::unique_ptr<TemporaryFolder> RenderCase::folder_;

TEST_F(RenderCase, FourTimesWithTheProjectedAreaOfTheSphere) {
    const auto report = draw("");
    ASSERT_EQ(report["panels"].size(), 4u);
    EXPECT_EQ(report["panels"][0]["strain"], 0.0);
    EXPECT_EQ(report["panels"][1]["strain"], 1.5);
    EXPECT_EQ(report["panels"][3]["strain"], 5.0);
    Pixels pixels(caseDir() / "postProcessing" / "renderCase.png");
    EXPECT_EQ(pixels.width(), 1600);
    EXPECT_EQ(pixels.height(), report["height"]);
    const double scale = report["metresPerPixel"];
    const double projected = M_PI * radius * radius / (scale * scale);
    for (const auto& panel : report["panels"]) {
        EXPECT_NEAR(pixels.count(panel, isReddish) / projected, 1, 0.02);
        const double words = static_cast<int>(panel["width"]) * static_cast<int>(panel["height"]) -
                             pixels.count(panel, isWhite) - projected;
        EXPECT_LT(std::abs(words) / projected, 0.06) << "the rest is white but for label and scale bar";
    }
    EXPECT_TRUE(isWhite(pixels.at(2, 2)));
}

TEST_F(RenderCase, ARuptureShowsAsAHole) {
    const auto report = draw("-times 2.5,3 -size 900x500 -output " + (caseDir() / "hole.png").string());
    Pixels pixels(caseDir() / "hole.png");
    EXPECT_EQ(pixels.width(), 900);
    EXPECT_EQ(pixels.height(), 500);
    const double scale = report["metresPerPixel"];
    const double hole = M_PI * radius * radius * (1 - 0.8 * 0.8) / (scale * scale);
    const int whole = pixels.count(report["panels"][0], isBright), open = pixels.count(report["panels"][1], isBright);
    EXPECT_NEAR((whole - open) / hole, 0.9, 0.2) << "edges, a tenth or two of the surface, are never bright";
}

TEST_F(RenderCase, FieldsViewsAndFluid) {
    for (const std::string options : {"-field areaStrain -times 0,5", "-field tension1 -view iso -times 5",
                                      "-fluid -times 0,5", "-fluid -field areaStrain -view xz -times 0"}) {
        const auto report = draw(options + " -size 600 -output " + (caseDir() / "any.png").string());
        Pixels pixels(caseDir() / "any.png");
        EXPECT_EQ(pixels.width(), 600) << options;
        const int coloured = pixels.count(report["panels"][0], [](const unsigned char* c) { return !isWhite(c); });
        const double scale = report["metresPerPixel"];
        EXPECT_GT(coloured, M_PI * radius * radius / (scale * scale)) << options;
    }
}

TEST_F(RenderCase, BeforeAnyRunTheStartIsShown) {
    TemporaryFolder fresh;
    std::filesystem::create_directories(fresh.path() / "0");
    writeVtp(fresh.path() / "0" / "rbc.vtp", sphere(Vec3::Zero(), 0, false));
    const Outcome run = renderCase(fresh.path(), "-size 500");
    EXPECT_EQ(run.exitCode, 0) << run.text;
    EXPECT_TRUE(std::filesystem::exists(fresh.path() / "postProcessing" / "renderCase.png"));
}

TEST_F(RenderCase, WrongWordsAreNamed) {
    const std::pair<const char*, const char*> wrong[] = {{"-field areaStrian", "Did you mean 'areaStrain'?"},
                                                         {"-view xzz", "Did you mean 'xz'?"},
                                                         {"-times 0,9", "the results reach from 0 to 5"},
                                                         {"-times a", "'a' is no number"},
                                                         {"-membrane rcb", "Did you mean 'rbc'?"},
                                                         {"-size 20", "too small"}};
    for (const auto& [options, words] : wrong) {
        const Outcome run = renderCase(caseDir(), options);
        EXPECT_EQ(run.exitCode, 1) << options << run.text;
        EXPECT_NE(run.text.find(words), std::string::npos) << options << ": " << run.text;
    }
    TemporaryFolder empty;
    const Outcome run = renderCase(empty.path(), "");
    EXPECT_EQ(run.exitCode, 4);
    EXPECT_NE(run.text.find("membraneMesh"), std::string::npos) << run.text;
}

}  // namespace
}  // namespace corpuscle::io
