// renderCase, run as a user runs it, on spheres whose projected area is known.
#include <gtest/gtest.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <sstream>
#include <vector>

#include "io/polyData.hpp"
#include "io/temporaryFolder.hpp"

namespace corpuscle::io {
namespace {

constexpr double radius = 4e-6;

// A sphere meshed by longitudes and latitudes, triangles facing outwards. If `ruptured`, the triangles around the point
// nearest to the camera of the xz view are broken.
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

void writeIndex(const std::filesystem::path& caseDir, const std::string& name, const std::vector<double>& times) {
    std::ofstream index(caseDir / "results" / (name + ".pvd"));
    index << "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\">\n<Collection>\n";
    for (std::size_t i = 0; i < times.size(); ++i)
        index << "<DataSet timestep=\"" << times[i] << "\" file=\"" << name << "/" << name << "_" << i << ".vtp\"/>\n";
    index << "</Collection>\n</VTKFile>\n";
}

// Eleven times from 0 to 1 s, with strains from 0 to 5 and a membrane that ruptures at strain 3.
void writeCase(const std::filesystem::path& caseDir) {
    std::filesystem::create_directories(caseDir / "results" / "rbc");
    std::vector<double> times;
    for (int i = 0; i <= 10; ++i) {
        const std::string file = "rbc/rbc_" + std::to_string(i) + ".vtp";
        writeVtp(caseDir / "results" / file, sphere(Vec3(1e-6 * i, 0, 0), 0.5 * i, i >= 6));
        times.push_back(0.1 * i);
    }
    writeIndex(caseDir, "rbc", times);
    std::filesystem::create_directories(caseDir / "0");
    writeVtp(caseDir / "0" / "fluid.vtp", shearedFluid());
}

void writeBox(const std::filesystem::path& caseDir, const std::string& size, const std::string& periodic) {
    std::filesystem::create_directories(caseDir / "system");
    std::ofstream(caseDir / "system" / "mesh.yaml") << "domain: {size: " << size << ", periodic: " << periodic << "}\n";
}

struct Outcome {
    int exitCode;
    std::string text;
};
Outcome renderCase(const std::filesystem::path& caseDir, const std::string& options, const std::string& before = "") {
    const auto log = caseDir / "log";
    const std::string command = before +
                                "OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 " RENDER_CASE " -case " +
                                caseDir.string() + " " + options + " > " + log.string() + " 2>&1";
    const int status = std::system(command.c_str());
    std::ifstream file(log);
    std::stringstream text;
    text << file.rdbuf();
    return {WEXITSTATUS(status), text.str()};
}

// The pixels of a panel; rows count from the top.
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
    // Mean column of the pixels that satisfy `is`, counted from the left of the panel.
    template <class Is>
    double meanColumn(const nlohmann::json& panel, Is&& is) {
        double sum = 0, number = 0;
        const int x0 = panel["x"], y0 = panel["y"], w = panel["width"], h = panel["height"];
        for (int y = y0; y < y0 + h; ++y) {
            for (int x = x0; x < x0 + w; ++x) {
                if (!is(at(x, y))) continue;
                sum += x - x0;
                ++number;
            }
        }
        return sum / number;
    }
};
bool isReddish(const unsigned char* c) { return c[0] > c[1] + 15; }
// The outside of the membrane; its inside is darker.
bool isOutside(const unsigned char* c) { return c[0] > 95 && c[0] > c[1] + 50; }
bool isInside(const unsigned char* c) { return c[0] <= 95 && isReddish(c); }
bool isWhite(const unsigned char* c) { return c[0] == 255 && c[1] == 255 && c[2] == 255; }

class RenderCase : public ::testing::Test {
  protected:
    static void SetUpTestSuite() {
        folder_ = std::make_unique<TemporaryFolder>();
        writeCase(folder_->path());
    }
    static void TearDownTestSuite() { folder_.reset(); }
    static const std::filesystem::path& caseDir() { return folder_->path(); }
    static nlohmann::json drawIn(const std::filesystem::path& folder, const std::string& options,
                                 const std::string& before = "") {
        const Outcome run = renderCase(folder, "-json -quiet " + options, before);
        EXPECT_EQ(run.exitCode, 0) << run.text;
        return run.exitCode == 0 ? nlohmann::json::parse(run.text) : nlohmann::json();
    }
    static nlohmann::json draw(const std::string& options) { return drawIn(caseDir(), options); }
    static void expectTwoCells(const std::filesystem::path& folder, double apart);
    static std::unique_ptr<TemporaryFolder> folder_;
};
std::unique_ptr<TemporaryFolder> RenderCase::folder_;

TEST_F(RenderCase, FourTimesWithTheProjectedAreaOfTheSphere) {
    const auto report = draw("-view xz");
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
        const double rest = static_cast<int>(panel["width"]) * static_cast<int>(panel["height"]) -
                            pixels.count(panel, isWhite) - projected;
        EXPECT_LT(std::abs(rest) / projected, 0.02) << "the rest is white";
    }
    EXPECT_TRUE(isWhite(pixels.at(2, 2)));
}

// The sphere moves by 10 um from the first panel to the last.
TEST_F(RenderCase, TheCameraStandsStill) {
    const auto report = draw("-view xz -strain 0,5 -size 600");
    Pixels pixels(caseDir() / "postProcessing" / "renderCase.png");
    const double first = pixels.meanColumn(report["panels"][0], isReddish);
    const double last = pixels.meanColumn(report["panels"][1], isReddish);
    EXPECT_NEAR((last - first) * report["metresPerPixel"].get<double>(), 10e-6, 0.1e-6);
}

TEST_F(RenderCase, ARuptureShowsAsAHole) {
    const auto report = draw("-view xz -strain 2.5,3 -size 900x500 -output " + (caseDir() / "hole.png").string());
    Pixels pixels(caseDir() / "hole.png");
    EXPECT_EQ(pixels.width(), 900);
    EXPECT_EQ(pixels.height(), 500);
    const double scale = report["metresPerPixel"];
    const double hole = M_PI * radius * radius * (1 - 0.8 * 0.8) / (scale * scale);
    const int whole = pixels.count(report["panels"][0], isOutside), open = pixels.count(report["panels"][1], isOutside);
    EXPECT_NEAR((whole - open) / hole, 1, 0.2) << "the inside is dark";
    // The same triangles, now kept and shown in the colour of broken ones.
    const auto marked =
        draw("-view xz -strain 2.5,3 -field broken -size 900 -output " + (caseDir() / "broken.png").string());
    Pixels broken(caseDir() / "broken.png");
    const double other = marked["metresPerPixel"];
    EXPECT_EQ(broken.count(marked["panels"][0], isReddish), 0);
    EXPECT_NEAR(broken.count(marked["panels"][1], isReddish) / (hole * scale * scale / (other * other)), 1, 0.05);
}

TEST_F(RenderCase, FieldsViewsAndFluid) {
    for (const std::string options : {"-field areaStrain -times 0,5", "-field tension1 -view iso -times 5",
                                      "-fluid -field areaStrain -view xz -times 0", "-field broken -mesh -time latest",
                                      "-frame cells -fluid -arrows"}) {
        const auto report = draw(options + " -size 500 -output " + (caseDir() / "any.png").string());
        Pixels pixels(caseDir() / "any.png");
        EXPECT_EQ(pixels.width(), 500) << options;
        const int coloured = pixels.count(report["panels"][0], [](const unsigned char* c) { return !isWhite(c); });
        const double scale = report["metresPerPixel"];
        EXPECT_GT(coloured, M_PI * radius * radius / (scale * scale)) << options;
    }
}

// The least-squares fit is exact for a linear field, also up to the walls, half a spacing beyond the last particles.
TEST_F(RenderCase, TheSliceOfALinearFlowIsExact) {
    TemporaryFolder sheared;
    writeCase(sheared.path());
    writeBox(sheared.path(), "[16 um, 4 um, 12 um]", "[true, true, false]");
    const auto report = drawIn(sheared.path(), "-fluid -arrows -strain 0 -view xz -size 400");
    EXPECT_EQ(report["fluid"]["axis"], "y");
    EXPECT_EQ(report["fluid"]["position"], 0.0);
    EXPECT_NEAR(report["fluid"]["high"].get<double>(), 100 * 6e-6, 1e-9);
    EXPECT_NEAR(report["fluid"]["low"].get<double>(), -100 * 6e-6, 1e-9);
    const auto other = drawIn(sheared.path(), "-slice 'z=3 um' -strain 0 -size 400");
    EXPECT_NEAR(other["fluid"]["low"].get<double>(), 0, 1e-12) << "of one sign: from zero";
    EXPECT_NEAR(other["fluid"]["high"].get<double>(), 100 * 3e-6, 1e-9);
    const auto outside = renderCase(sheared.path(), "-slice 'z=30 um'");
    EXPECT_EQ(outside.exitCode, 1);
    EXPECT_NE(outside.text.find("the box reaches from -6 um to 6 um"), std::string::npos) << outside.text;
}

// A linear pressure and a shear flow that continue in all images, provided that the images have their offset and
// velocity.
TEST_F(RenderCase, TheSliceKnowsThatImagesSlide) {
    TemporaryFolder sheared;
    writeCase(sheared.path());
    writeBox(sheared.path(), "[16 um, 4 um, 12 um]", "[false, true, true]");
    constexpr double offset = 3.3e-6, height = 12e-6;
    PolyData fluid = shearedFluid();
    fluid.field = {{"slidingAxis", 2}, {"imageOffset", offset}, {"imageVelocity", 100 * height}};
    for (const Vec3& x : fluid.points) fluid.point.scalars["pressure"].push_back(1e6 * (x[0] - offset / height * x[2]));
    writeVtp(sheared.path() / "0" / "fluid.vtp", fluid);
    const auto pressure = drawIn(sheared.path(), "-fluid -fluidField pressure -strain 0 -view xz -size 400");
    EXPECT_NEAR(pressure["fluid"]["high"].get<double>(), 8 + offset / height * 6, 1e-9);
    EXPECT_NEAR(pressure["fluid"]["low"].get<double>(), -8 - offset / height * 6, 1e-9);
    const auto velocity = drawIn(sheared.path(), "-fluid -fluidField u -strain 0 -view xz -size 400");
    EXPECT_NEAR(velocity["fluid"]["high"].get<double>(), 100 * 6e-6, 1e-9);
    EXPECT_NEAR(velocity["fluid"]["low"].get<double>(), -100 * 6e-6, 1e-9);
}

// A cell that has crossed the periodic box many times, in a flow without strain.
TEST_F(RenderCase, CellsAreDrawnInTheBoxAndLabelledByTime) {
    TemporaryFolder channel;
    std::filesystem::create_directories(channel.path() / "results" / "rbc");
    writeBox(channel.path(), "[16 um, 12 um, 16 um]", "[true, true, false]");
    const std::vector<double> xs{0, 316e-6, -28e-6};  // -4, 4 um in the box
    for (std::size_t i = 0; i < xs.size(); ++i)
        writeVtp(channel.path() / "results" / "rbc" / ("rbc_" + std::to_string(i) + ".vtp"),
                 sphere(Vec3(xs[i], 0, 0), 0, false));
    writeIndex(channel.path(), "rbc", {0, 2e-3, 4e-3});
    const auto report = drawIn(channel.path(), "-view xz -time '0,2 ms,latest' -size 900");
    ASSERT_EQ(report["panels"].size(), 3u);
    Pixels pixels(channel.path() / "postProcessing" / "renderCase.png");
    const double scale = report["metresPerPixel"];
    const double middle = pixels.meanColumn(report["panels"][0], isReddish);
    EXPECT_NEAR((pixels.meanColumn(report["panels"][1], isReddish) - middle) * scale, -4e-6, 0.1e-6);
    EXPECT_NEAR((pixels.meanColumn(report["panels"][2], isReddish) - middle) * scale, 4e-6, 0.1e-6);
    std::vector<std::string> words;
    for (const auto& place : report["places"]) words.push_back(place["what"]);
    for (const std::string label : {"t = 0 ms", "t = 2 ms", "t = 4 ms"})
        EXPECT_NE(std::find(words.begin(), words.end(), label), words.end()) << label;
    EXPECT_FALSE(report["panels"][1].contains("strain"));
    const auto none = renderCase(channel.path(), "-strain 1");
    EXPECT_EQ(none.exitCode, 1);
    EXPECT_NE(none.text.find("no strain"), std::string::npos) << none.text;
    EXPECT_NE(none.text.find("give -time between 0 s and 4 ms"), std::string::npos) << none.text;
    const auto bare = renderCase(channel.path(), "-times 0.002");  // neither a strain nor a stage
    EXPECT_EQ(bare.exitCode, 1);
    EXPECT_NE(bare.text.find("give times with units, between 0 s and 4 ms"), std::string::npos) << bare.text;
    EXPECT_EQ(renderCase(channel.path(), "-times '0,2 ms'").exitCode, 0);
}

// Two cells of one type share a stream. They have left the box by different numbers of box lengths, so that their
// common mean does not tell where either of them belongs.
TEST_F(RenderCase, EachCellOfAStreamIsMovedIntoTheBoxByItself) {
    TemporaryFolder crowd;
    std::filesystem::create_directories(crowd.path() / "results" / "rbc");
    writeBox(crowd.path(), "[24 um, 12 um, 16 um]", "[true, true, false]");
    PolyData both;
    const double xs[] = {-6e-6 + 10 * 24e-6, 6e-6 - 3 * 24e-6};
    for (std::int64_t cell = 0; cell < 2; ++cell) {
        const PolyData one = sphere(Vec3(xs[cell], 0, 0), 0, false);
        const int first = static_cast<int>(both.points.size());
        both.points.insert(both.points.end(), one.points.begin(), one.points.end());
        for (const auto& t : one.triangles) both.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
        both.point.integers["cell"].resize(both.points.size(), cell);
    }
    writeVtp(crowd.path() / "results" / "rbc" / "rbc_0.vtp", both);
    writeIndex(crowd.path(), "rbc", {0});
    expectTwoCells(crowd.path(), 12e-6);
}

// Expects two whole cells at this distance [m] in the view along y.
void RenderCase::expectTwoCells(const std::filesystem::path& folder, double apart) {
    const auto report = drawIn(folder, "-view xz -count 1 -size 900");
    Pixels pixels(folder / "postProcessing" / "renderCase.png");
    const auto& panel = report["panels"][0];
    const double scale = report["metresPerPixel"], projected = M_PI * radius * radius / (scale * scale);
    EXPECT_NEAR(pixels.count(panel, isReddish) / projected, 2, 0.04);
    const double mean = pixels.meanColumn(panel, isReddish);
    nlohmann::json half = panel;
    half["width"] = static_cast<int>(mean);
    const int left = pixels.count(half, isReddish);
    const double leftMean = pixels.meanColumn(half, isReddish);
    half["x"] = panel["x"].get<int>() + static_cast<int>(mean);
    half["width"] = panel["width"].get<int>() - static_cast<int>(mean);
    const int right = pixels.count(half, isReddish);
    const double rightMean = pixels.meanColumn(half, isReddish) + static_cast<int>(mean);
    EXPECT_NEAR(left / projected, 1, 0.02);
    EXPECT_NEAR(right / projected, 1, 0.02);
    EXPECT_NEAR((rightMean - leftMean) * scale, apart, 0.1e-6);
}

// The mesh in 0/ of a type that is placed by a list is centred on the origin; before a run the picture shows the cells
// at their places in the case.
TEST_F(RenderCase, BeforeARunCellsStandAtTheirPlaces) {
    const std::string x = "[{centre: [-5 um, 0 um, 0 um]}, {centre: [6 um, 0 um, 0 um], axis: [1, 0, 1]}]";
    for (const std::string& entry : {"places: " + x, std::string("table: cells.csv")}) {
        TemporaryFolder fresh;
        std::filesystem::create_directories(fresh.path() / "0");
        writeBox(fresh.path(), "[24 um, 12 um, 16 um]", "[true, true, false]");
        std::ofstream(fresh.path() / "system" / "mesh.yaml", std::ios::app)
            << "cells: [{name: rbc, " << entry << "}]\n";
        std::ofstream(fresh.path() / "cells.csv") << "x_um,y_um,z_um\n-5,0,0\n6,0,0\n";
        writeVtp(fresh.path() / "0" / "rbc.vtp", sphere(Vec3::Zero(), 0, false));
        expectTwoCells(fresh.path(), 11e-6);
    }
    TemporaryFolder wrong;
    std::filesystem::create_directories(wrong.path() / "0");
    writeBox(wrong.path(), "[24 um, 12 um, 16 um]", "[true, true, false]");
    std::ofstream(wrong.path() / "system" / "mesh.yaml", std::ios::app) << "cells: [{name: rbc, table: none.csv}]\n";
    writeVtp(wrong.path() / "0" / "rbc.vtp", sphere(Vec3::Zero(), 0, false));
    const Outcome run = renderCase(wrong.path(), "-size 300");
    EXPECT_EQ(run.exitCode, 0) << run.text;
    EXPECT_NE(run.text.find("cells are drawn where their meshes stand"), std::string::npos) << run.text;
    EXPECT_NE(run.text.find("none.csv"), std::string::npos) << run.text;
}

TEST_F(RenderCase, WordsBarsAndPanelsLieBesideEachOther) {
    TemporaryFolder boxed;
    writeCase(boxed.path());
    writeBox(boxed.path(), "[16 um, 4 um, 12 um]", "[true, true, false]");
    for (const std::string options :
         {"-size 700", "-fluid -arrows -field tension1 -size 900", "-count 9 -field broken -size 1000",
          "-size 700x500 -fluid -arrows -count 2", "-view xy -frame cells -count 1 -size 400"}) {
        const auto report = drawIn(boxed.path(), options);
        std::vector<nlohmann::json> all = report["places"];
        for (const auto& panel : report["panels"]) all.push_back(panel);
        for (std::size_t i = 0; i < all.size(); ++i) {
            const double x = all[i]["x"], y = all[i]["y"], right = x + all[i]["width"].get<double>(),
                         low = y + all[i]["height"].get<double>();
            EXPECT_TRUE(x >= -0.5 && y >= -0.5 && right <= report["width"].get<double>() + 0.5 &&
                        low <= report["height"].get<double>() + 0.5)
                << options << ": " << all[i];
            for (std::size_t j = 0; j < i; ++j) {
                const double x2 = all[j]["x"], y2 = all[j]["y"];
                const bool apart = x2 >= right || x2 + all[j]["width"].get<double>() <= x || y2 >= low ||
                                   y2 + all[j]["height"].get<double>() <= y;
                EXPECT_TRUE(apart) << options << ": " << all[i] << " and " << all[j];
            }
        }
    }
}

// A fluid of the extent of shearedFluid with another velocity.
PolyData fluidMoving(const std::function<Vec3(const Vec3&)>& velocity) {
    PolyData data = shearedFluid();
    for (std::size_t i = 0; i < data.points.size(); ++i) data.point.vectors["velocity"][i] = velocity(data.points[i]);
    return data;
}

Vec3 vectorOf(const nlohmann::json& list) {
    return {list[0].get<double>(), list[1].get<double>(), list[2].get<double>()};
}

TEST_F(RenderCase, StreamlinesOfAShearFlowAreStraight) {
    TemporaryFolder sheared;
    writeCase(sheared.path());
    writeBox(sheared.path(), "[16 um, 4 um, 12 um]", "[true, true, false]");
    const auto report = drawIn(sheared.path(), "-streamlines 12 -strain 0,5 -view xz -size 600");
    Vec3 mean = Vec3::Zero();
    for (const auto& panel : report["panels"]) {
        ASSERT_EQ(panel["streamlines"].size(), 12u);
        for (const auto& line : panel["streamlines"]) {
            const Vec3 seed = vectorOf(line["seed"]), low = vectorOf(line["low"]), high = vectorOf(line["high"]);
            EXPECT_NEAR(seed[0], -8e-6, 1e-12);
            EXPECT_NEAR(high[1] - low[1], 0, 1e-12);
            EXPECT_NEAR(high[2] - low[2], 0, 1e-12);
            EXPECT_NEAR(line["length"].get<double>(), 16e-6, 1e-12);
            EXPECT_EQ(line["downstream"], "period");
            EXPECT_GT(vectorOf(line["to"])[0] * seed[2] + 8e-6 * std::abs(seed[2]), 0) << "to the left below z = 0";
            mean += seed / 24;
        }
    }
    EXPECT_NEAR(mean[1], 0, 0.2e-6) << "seeds are spread evenly";
    EXPECT_NEAR(mean[2], 0, 0.2e-6);
    EXPECT_EQ(report["fluid"]["title"], "speed, \u00b5m/s");
    EXPECT_FALSE(report["fluid"].contains("axis")) << "no plane";

    // With a plane of fluid the lines lie in it, at equal distances.
    const auto inPlane = drawIn(sheared.path(), "-streamlines 6 -fluid -strain 0 -view xz -size 600");
    for (std::size_t i = 0; i < 6; ++i) {
        const Vec3 seed = vectorOf(inPlane["panels"][0]["streamlines"][i]["seed"]);
        EXPECT_NEAR(seed[1], 0, 1e-15);
        EXPECT_NEAR(seed[2], (-5 + 2.0 * static_cast<double>(i)) * 1e-6, 0.02e-6);
    }
}

// Each line appears in the picture as a tube across the whole box, at the height of its seed.
TEST_F(RenderCase, StreamlinesCrossTheBox) {
    TemporaryFolder sheared;
    std::filesystem::create_directories(sheared.path() / "0");
    writeBox(sheared.path(), "[16 um, 4 um, 12 um]", "[true, true, false]");
    writeVtp(sheared.path() / "0" / "fluid.vtp", shearedFluid());
    const auto report = drawIn(sheared.path(), "-streamlines 4 -seeds 'x=3 um' -time first -view xz -size 900");
    Pixels pixels(sheared.path() / "postProcessing" / "renderCase.png");
    const auto isColoured = [](const unsigned char* c) {
        return std::max({c[0], c[1], c[2]}) > std::min({c[0], c[1], c[2]}) + 25;
    };
    const double scale = report["metresPerPixel"];
    const auto& panel = report["panels"][0];
    const double middle = panel["y"].get<double>() + 0.5 * panel["height"].get<double>();
    for (const auto& line : panel["streamlines"]) {
        nlohmann::json band = panel;
        band["y"] = static_cast<int>(std::lround(middle - vectorOf(line["seed"])[2] / scale));
        band["height"] = 1;
        EXPECT_NEAR(pixels.count(band, isColoured) * scale, 16e-6, 0.4e-6) << line;
    }
}

// u = sin kx cos kz, w = -cos kx sin kz has the stream function sin kx sin kz: known extremes of each line.
TEST_F(RenderCase, StreamlinesOfAVortexClose) {
    TemporaryFolder vortex;
    std::filesystem::create_directories(vortex.path() / "0");
    writeBox(vortex.path(), "[16 um, 4 um, 12 um]", "[true, true, true]");
    const double kx = 2 * M_PI / 16e-6, kz = 2 * M_PI / 12e-6;
    writeVtp(vortex.path() / "0" / "fluid.vtp", fluidMoving([&](const Vec3& x) {
                 return Vec3(kz * std::sin(kx * x[0]) * std::cos(kz * x[2]), 0,
                             -kx * std::cos(kx * x[0]) * std::sin(kz * x[2]));
             }));
    const auto report = drawIn(vortex.path(), "-streamlines 8 -seeds 'x=4 um' -slice y -time first -view xz -size 500");
    for (const auto& line : report["panels"][0]["streamlines"]) {
        const Vec3 seed = vectorOf(line["seed"]);
        EXPECT_EQ(line["downstream"], "closed") << line;
        EXPECT_NEAR((vectorOf(line["to"]) - seed).norm(), 0, 0.05e-6);
        const double reach = std::asin(std::abs(std::sin(kz * seed[2]))) / kx;
        EXPECT_NEAR(vectorOf(line["low"])[0], reach, 0.05e-6);
        EXPECT_NEAR(vectorOf(line["high"])[0], 8e-6 - reach, 0.05e-6);
    }
}

// Beyond a face across which images slide the fluid moves with another velocity: lines end there.
TEST_F(RenderCase, StreamlinesEndWhereImagesSlide) {
    TemporaryFolder sheared;
    std::filesystem::create_directories(sheared.path() / "0");
    writeBox(sheared.path(), "[16 um, 4 um, 12 um]", "[true, true, true]");
    PolyData fluid = fluidMoving([](const Vec3&) { return Vec3(0, 0, 1e-3); });
    for (const bool slides : {false, true}) {
        if (slides) fluid.field = {{"slidingAxis", 2}, {"imageOffset", 3e-6}, {"imageVelocity", 1e-9}};
        writeVtp(sheared.path() / "0" / "fluid.vtp", fluid);
        const auto report = drawIn(sheared.path(), "-streamlines 5 -time first -view xz -size 500");
        for (const auto& line : report["panels"][0]["streamlines"]) {
            EXPECT_EQ(line["downstream"], slides ? "outside" : "period");
            EXPECT_NEAR(line["length"].get<double>(), 12e-6, slides ? 0.02e-6 : 1e-12);
            if (slides) {
                EXPECT_NEAR(vectorOf(line["from"])[2], -6e-6, 0.01e-6);
            }
        }
    }
}

// A plane at a distance d from the middle of the sphere cuts it in a circle of the radius sqrt(radius^2 - d^2). The eye
// of the view along y is below.
TEST_F(RenderCase, ACutOpensTheSphere) {
    const double whole = M_PI * radius * radius;
    for (const double at : {-2e-6, 0.0, 2e-6}) {
        const auto report = draw("-view xz -strain 0 -size 700 -cut 'y=" + std::to_string(at * 1e6) + " um'");
        EXPECT_EQ(report["cut"]["axis"], "y");
        EXPECT_EQ(report["cut"]["position"], at);
        EXPECT_EQ(report["cut"]["removed"], "below");
        Pixels pixels(caseDir() / "postProcessing" / "renderCase.png");
        const double pixel = std::pow(report["metresPerPixel"].get<double>(), 2);
        const auto& panel = report["panels"][0];
        const double circle = M_PI * (radius * radius - at * at);
        EXPECT_NEAR(pixels.count(panel, isReddish) * pixel / (at > 0 ? circle : whole), 1, 0.03) << at;
        const double dark = pixels.count(panel, isInside) * pixel;
        EXPECT_NEAR(dark / circle, 1, at < 0 ? 0.15 : 0.06) << at << ", where the outer side is dark at its edge";
    }
}

// Seen obliquely, a slice in the plane of the cut hides the outer side of what remains of the sphere, but not its
// inside.
TEST_F(RenderCase, ASliceInThePlaneOfTheCutHasHoles) {
    TemporaryFolder sheared;
    writeCase(sheared.path());
    writeBox(sheared.path(), "[16 um, 4 um, 12 um]", "[true, true, false]");
    const std::string options = "-view iso -fluidField speed -strain 0 -size 700";
    int fluid = 0;  // pixels
    const auto outsideOf = [&](const std::string& more) {
        const auto report = drawIn(sheared.path(), options + more);
        EXPECT_EQ(report["fluid"]["axis"], "y");
        Pixels pixels(sheared.path() / "postProcessing" / "renderCase.png");
        const double pixel = std::pow(report["metresPerPixel"].get<double>(), 2) / (M_PI * radius * radius);
        fluid = pixels.count(report["panels"][0], [](const unsigned char* c) { return c[2] > c[0] + 20; });
        const auto isRed = [](const unsigned char* c) { return isOutside(c) && c[1] < 100; };  // not the pale rim
        return std::array{pixels.count(report["panels"][0], isRed) * pixel,
                          pixels.count(report["panels"][0], isInside) * pixel};
    };
    EXPECT_GT(outsideOf(" -slice y")[0], 0.8);
    const int beside = fluid;
    const auto [outer, inner] = outsideOf(" -cut y -fluid");
    EXPECT_GT(inner, 0.2);
    EXPECT_NEAR(static_cast<double>(fluid) / beside, 1, 0.2) << "the slice is coloured beside the cell";
    const double inFront = outsideOf(" -cut 'y=0 um' -slice 'y=0.1 um'")[0];
    EXPECT_GT(inFront, 0.03);
    EXPECT_LT(outer, 0.1 * inFront) << "in another plane the cell is drawn in front of the slice";
}

TEST_F(RenderCase, ACutOpensAVessel) {
    TemporaryFolder vessel;
    writeCase(vessel.path());
    writeBox(vessel.path(), "[16 um, 10 um, 10 um]", "[true, false, false]");
    std::filesystem::create_directories(vessel.path() / "constant");
    std::ofstream(vessel.path() / "constant" / "flow.yaml")
        << "type: poiseuille\npressureDrop: 1 Pa\nwalls: {type: tube, diameter: 10 um}\n";
    const auto isGrey = [](const unsigned char* c) { return c[0] < 240 && std::abs(c[0] - c[1]) < 15; };
    std::vector<double> areas;
    for (const std::string cut : {"", " -cut 'y=3 um'"}) {
        const auto report = drawIn(vessel.path(), "-membrane rbc -view xz -strain 0 -size 700" + cut);
        Pixels pixels(vessel.path() / "postProcessing" / "renderCase.png");
        const double scale = report["metresPerPixel"];
        areas.push_back(pixels.count(report["panels"][0], isGrey) * scale * scale);
    }
    // Beyond y = 3 um the tube of radius 5 um is 8 um wide, and the sphere no longer covers it.
    EXPECT_NEAR(areas[0] / (16e-6 * 10e-6 - M_PI * radius * radius), 1, 0.05);
    EXPECT_NEAR(areas[1] / (16e-6 * 8e-6 - M_PI * (radius * radius - 9e-12)), 1, 0.05);
}

TEST_F(RenderCase, ASeriesHasOneCameraAndOneRange) {
    const auto reports =
        draw("-series -strain 0,2,5 -field tension1 -size 400 -output " + (caseDir() / "film" / "f.png").string());
    ASSERT_EQ(reports.size(), 3u);
    for (const auto& report : reports) {
        for (const char* key : {"metresPerPixel", "width", "height", "field"})
            EXPECT_EQ(report[key], reports[0][key]) << key;
        EXPECT_TRUE(std::filesystem::exists(report["output"].get<std::string>()));
    }
    EXPECT_TRUE(reports[2]["output"].get<std::string>().ends_with("film/f_0002.png"));
    const auto asked = draw("-field tension1 -range '0,50 uN/m' -count 1 -size 400");
    EXPECT_NEAR(asked["field"]["high"].get<double>(), 5e-5, 1e-12);
}

// A script takes the place of ffmpeg, which need not be installed: its arguments are checked, and its messages must be
// passed on.
TEST_F(RenderCase, AMovieHasAPictureForEachTime) {
    const TemporaryFolder folder;
    const auto program = folder.path() / "ffmpeg", film = folder.path() / "film.mp4";
    const auto standIn = [&](const std::string& end) {
        std::ofstream(program) << "#!/bin/sh\necho \"$@\" >" << folder.path().string() << "/words\n"
                               << "for last; do :; done\ncp $(dirname $last)/000000.png " << folder.path().string()
                               << "/first.png\nls $(dirname $last) | grep -c png$ >$last\n"
                               << end;
        std::filesystem::permissions(program, std::filesystem::perms::owner_all);
    };
    const std::string path = "PATH=" + folder.path().string() + ":$PATH ";
    standIn("");
    const auto report = drawIn(caseDir(), "-movie " + film.string() + " -fps 4 -view xz -size 401x301", path);
    const std::size_t times = report.size();
    ASSERT_GE(times, 4u);
    std::size_t drawn = 0;
    std::ifstream(film) >> drawn;
    EXPECT_EQ(drawn, times);
    std::string words;
    std::getline(std::ifstream(folder.path() / "words"), words);
    EXPECT_NE(words.find("-framerate 4 "), std::string::npos) << words;
    EXPECT_NE(words.find("-pix_fmt yuv420p"), std::string::npos) << words;
    EXPECT_EQ(Pixels(folder.path() / "first.png").width(), 401);
    EXPECT_EQ(report[0]["output"], film.string());
    const auto only = std::filesystem::directory_iterator(folder.path());
    EXPECT_EQ(std::distance(begin(only), end(only)), 4) << "pictures of the movie are left";

    standIn("echo no space >&2\nexit 7\n");
    const Outcome failed = renderCase(caseDir(), "-movie " + film.string() + " -size 400", path);
    EXPECT_EQ(failed.exitCode, 4);
    EXPECT_NE(failed.text.find("ffmpeg ended with code 7: no space"), std::string::npos) << failed.text;
    const Outcome none = renderCase(caseDir(), "-movie " + film.string(), "PATH=/nowhere ");
    EXPECT_EQ(none.exitCode, 4);
    EXPECT_NE(none.text.find("apt-get install ffmpeg"), std::string::npos) << none.text;
}

TEST_F(RenderCase, BeforeAnyRunTheStartIsShown) {
    TemporaryFolder fresh;
    std::filesystem::create_directories(fresh.path() / "0");
    writeVtp(fresh.path() / "0" / "rbc.vtp", sphere(Vec3::Zero(), 0, false));
    const Outcome run = renderCase(fresh.path(), "-size 500");
    EXPECT_EQ(run.exitCode, 0) << run.text;
    EXPECT_TRUE(std::filesystem::exists(fresh.path() / "postProcessing" / "renderCase.png"));
    // A case with fluid only is shown as a slice.
    std::filesystem::remove(fresh.path() / "0" / "rbc.vtp");
    writeVtp(fresh.path() / "0" / "fluid.vtp", shearedFluid());
    EXPECT_EQ(drawIn(fresh.path(), "-time first -size 500")["fluid"]["title"], "velocity u, \u00b5m/s");
}

TEST_F(RenderCase, WrongWordsAreNamed) {
    const std::pair<const char*, const char*> wrong[] = {
        {"-field areaStrian", "there are: areaStrain, broken, tension1, none. Did you mean 'areaStrain'?"},
        {"-fluid -fluidField sped", "Did you mean 'speed'?"},
        {"-view xzz", "Did you mean 'xz'?"},
        {"-strain 9", "-strain 9: the results reach from 0 to 5"},
        {"-time '3 s'", "the results reach from 0 s to 1 s"},
        {"-time 3", "'3' has no unit"},
        {"-stage 2", "no stages"},
        {"-strain 0,,2", "does not start with a number"},
        {"-strain 0 -time '0 s'", "one of them is enough"},
        {"-membrane rcb", "Did you mean 'rbc'?"},
        {"-slice q", "'q' is none of x, y, z"},
        {"-field tension1 -range 5,1", "the second must be greater"},
        {"-range 0,1", "Give -field too"},
        {"-output cell.jpg", "its name ends in .png"},
        {"-movie cell.avi", "its name ends in .mp4"},
        {"-movie cell.mp4 -series", "-output and -series are for pictures"},
        {"-fps 5", "Give -movie too"},
        {"-streamlines 0", "-streamlines 0: a whole number of at least 1 is expected"},
        {"-streamlines 2000", "-streamlines 2000: at most 1000 lines are drawn"},
        {"-seeds x", "-seeds: of how many lines? Give -streamlines too"},
        {"-streamlines 5 -seeds 'x=9 um'", "-streamlines 5: there is no fluid at x = 9 um"},
        {"-streamlines 5 -fluidField sped", "Did you mean 'speed'?"},
        {"-cut q", "-cut q: 'q' is none of x, y, z"},
        {"-cut y=3", "'3' is no length"},
        {"-cut 'z=30 um'", "-cut z=30 um: the cells reach from -4 um to 4 um"},
        {"-cut x -view xz", "-cut x: the view xz sees this plane edge-on"},
        {"-size 900x100 -field areaStrain", "too small"}};
    for (const auto& [options, words] : wrong) {
        const Outcome run = renderCase(caseDir(), options);
        EXPECT_EQ(run.exitCode, 1) << options << run.text;
        EXPECT_NE(run.text.find(words), std::string::npos) << options << ": " << run.text;
    }
    TemporaryFolder empty;
    const Outcome run = renderCase(empty.path(), "");
    EXPECT_EQ(run.exitCode, 4);
    EXPECT_NE(run.text.find("membraneMesh"), std::string::npos) << run.text;
    EXPECT_EQ(renderCase(empty.path(), "-case " + (empty.path() / "none").string()).exitCode, 1);
}

TEST_F(RenderCase, WhatCannotBeReadIsNamed) {
    TemporaryFolder damaged;
    std::filesystem::create_directories(damaged.path() / "0");
    PolyData bad = sphere(Vec3::Zero(), 0, false);
    bad.points[7][1] = std::nan("");
    writeVtp(damaged.path() / "0" / "rbc.vtp", bad);
    const Outcome nan = renderCase(damaged.path(), "-size 300");
    EXPECT_EQ(nan.exitCode, 4);
    EXPECT_NE(nan.text.find("point 7 has no finite position"), std::string::npos) << nan.text;
    std::ofstream(damaged.path() / "0" / "rbc.vtp") << "no VTK";
    const Outcome text = renderCase(damaged.path(), "-size 300");
    EXPECT_EQ(text.exitCode, 4);
    EXPECT_NE(text.text.find("0/rbc.vtp"), std::string::npos) << text.text;
    // A box that cannot be read is not drawn; a warning says so.
    writeVtp(damaged.path() / "0" / "rbc.vtp", sphere(Vec3::Zero(), 0, false));
    writeBox(damaged.path(), "[16, 4, 12]", "[true, true, false]");
    const Outcome box = renderCase(damaged.path(), "-size 300");
    EXPECT_EQ(box.exitCode, 0);
    EXPECT_NE(box.text.find("the box is not drawn: system/mesh.yaml:1:"), std::string::npos) << box.text;
}

}  // namespace
}  // namespace corpuscle::io
