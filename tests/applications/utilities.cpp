// membraneMesh, particleFill, checkMesh and listModels, run as a user runs them: exit codes, numbers and error
// messages.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "io/polyData.hpp"
#include "io/temporaryFolder.hpp"

using namespace corpuscle;
using nlohmann::json;
namespace fs = std::filesystem;

namespace {

void writeText(const fs::path& file, const std::string& text) {
    fs::create_directories(file.parent_path());
    std::ofstream(file) << text;
}
std::string readText(const fs::path& file) {
    std::ostringstream text;
    text << std::ifstream(file).rdbuf();
    return text.str();
}

class Utilities : public testing::Test {
  protected:
    struct Result {
        int code = 0;
        std::string out, err;
    };

    void SetUp() override {
        writeText(at("system/control.yaml"), "application: dmpFlow\nendStrain: 1\n");
        writeText(at("system/numerics.yaml"),
                  "spacing: 1 um\nkernel: {type: wendlandC2, support: 3.0 dx}\nintegrator: velocityVerlet\n"
                  "coupling: dualIdentity\n");
        writeText(at("system/mesh.yaml"),
                  "domain: {size: [12 um, 10 um, 10 um], periodic: [true, true, false]}\n"
                  "cells: [{name: rbc, shape: {type: kuchelFackerell, d: 8 um, h: 2.12 um, b: 1 um}, edge: 0.8 um, "
                  "axis: [0.2, 0, 1]}]\n");
        writeText(at("constant/fluid.yaml"), "density: 1000 kg/m^3\nviscosity: 1.0e-3 Pa s\n");
        writeText(at("constant/membranes.yaml"),
                  "rbc:\n  interior: {viscosityRatio: 1}\n  bonds: {type: harmonic, k: 5e-4 N/m}\n  bending: {type: "
                  "dihedral, Eb: 0.01}\n");
        writeText(at("constant/flow.yaml"), "type: shear\nCa: 0.02\ninertia: {Re: 0.1}\n");
    }

    fs::path at(const std::string& inCase) const { return folder_.path() / inCase; }

    Result run(const std::string& program, const std::string& options = "") const {
        const fs::path out = at("out.txt"), err = at("err.txt");
        const std::string command = "OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 " PROGRAMS "/" +
                                    program + " -case " + folder_.path().string() + " " + options + " > " +
                                    out.string() + " 2> " + err.string();
        const int status = std::system(command.c_str());
        return {WEXITSTATUS(status), readText(out), readText(err)};
    }
    json runJson(const std::string& program, const std::string& options = "") const {
        const Result result = run(program, "-json " + options);
        EXPECT_EQ(result.code, 0) << result.err;
        return json::parse(result.out, nullptr, false);
    }

    TemporaryFolder folder_;
};

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST_F(Utilities, AStartIsMadeAndFoundSound) {
    const json mesh = runJson("membraneMesh");
    EXPECT_EQ(mesh["rbc"]["quality"]["euler"], 2);
    EXPECT_NEAR(mesh["rbc"]["quality"]["edgeMean_m"].get<double>(), 0.8e-6, 0.03 * 0.8e-6);
    EXPECT_NEAR(mesh["rbc"]["quality"]["volume_m3"].get<double>() / 85.988326e-18, 1, 1e-7);
    EXPECT_LT(mesh["rbc"]["quality"]["residual"].get<double>(), 0.05);  // distance of nodes from the surface, in radii
    // Hexagonal network: Gs = sqrt(3)/4 k; the affine estimate is slightly larger.
    EXPECT_NEAR(mesh["rbc"]["moduli"]["Gs_N_m"].get<double>(), 2.165e-4, 0.05 * 2.165e-4);

    const json fill = runJson("particleFill");
    const long fluid = fill["fluid"], carved = fill["carved"];
    EXPECT_EQ(fluid + carved, 12 * 10 * 10);
    EXPECT_EQ(fill["walls"], 2 * 3 * 12 * 10);
    EXPECT_EQ(fill["outside"].get<long>() + fill["inside"]["rbc"]["particles"].get<long>(), fluid);
    EXPECT_LT(fill["sigma"]["nearAfter"]["deviation"].get<double>(),
              0.5 * fill["sigma"]["nearBefore"]["deviation"].get<double>());

    const io::PolyData data = io::readVtp(at("0/fluid.vtp"));
    ASSERT_EQ(static_cast<long>(data.points.size()), fluid);
    EXPECT_EQ(data.field.at("TimeValue"), 0);
    EXPECT_EQ(data.field.at("strain"), 0);
    EXPECT_EQ(data.point.integer("id").back(), fluid - 1);
    EXPECT_EQ(data.point.scalar("spacing").front(), 1e-6);
    EXPECT_EQ(data.point.scalar("pressure").front(), 0);
    // Re = rho gammadot a^2/mu and Ca = mu gammadot a/Gs at a = 4 um.
    const double rate = 0.02 * std::sqrt(3.0) / 4 * 5e-4 / (1e-3 * 4e-6);
    EXPECT_NEAR(data.point.scalar("density").front(), 0.1 * 1e-3 / (rate * 16e-12), 1e-6);
    for (const std::size_t i : {std::size_t{0}, data.points.size() / 2})
        EXPECT_NEAR(data.point.vector("velocity")[i].x(), rate * data.points[i].z(), 1e-9);
    const io::PolyData walls = io::readVtp(at("0/walls.vtp"));
    EXPECT_EQ(walls.point.integer("id").front(), fluid);
    EXPECT_NEAR(walls.point.vector("velocity").back().x(), rate * 5e-6, 1e-9);

    const Result check = run("checkMesh");
    EXPECT_EQ(check.code, 0) << check.err;
    EXPECT_TRUE(contains(check.out, "Mesh OK.")) << check.out;
}

TEST_F(Utilities, TheSameCaseGivesTheSameStart) {
    run("membraneMesh");
    run("particleFill");
    const std::string mesh = readText(at("0/rbc.vtp")), fluid = readText(at("0/fluid.vtp"));
    run("membraneMesh");
    run("particleFill");
    EXPECT_EQ(readText(at("0/rbc.vtp")), mesh);
    EXPECT_EQ(readText(at("0/fluid.vtp")), fluid);
}

TEST_F(Utilities, ChecksFailOnAStartThatBelongsToAnotherCase) {
    run("membraneMesh");
    run("particleFill");
    for (const char* program : {"checkMesh", "particleFill"}) {
        const Result other = run(program, "-set 'system/mesh.yaml:/cells/0/shape/d=7.5 um'");
        EXPECT_EQ(other.code, 2);
        EXPECT_TRUE(
            contains(other.err,
                     "cells[0].shape.d: the case says 7.5e-06 m, but 0/rbc.vtp was made for 8e-06 m; run membraneMesh"))
            << other.err;
    }
    EXPECT_EQ(run("checkMesh", "-set 'constant/flow.yaml:/Ca=0.3'").code, 0);

    const io::PolyData mesh = io::readVtp(at("0/rbc.vtp"));
    for (const auto& [factor, fault] : {std::pair{1.01, "the mesh encloses"}, std::pair{2.0, "off the shape"}}) {
        io::PolyData moved = mesh;
        moved.points[0] *= factor;
        io::writeVtp(at("0/rbc.vtp"), moved);
        const Result off = run("checkMesh");
        EXPECT_EQ(off.code, 2);
        EXPECT_TRUE(contains(off.err, fault)) << off.err;
    }
    io::writeVtp(at("0/rbc.vtp"), mesh);

    io::PolyData fluid = io::readVtp(at("0/fluid.vtp"));
    fluid.points[1] = fluid.points[0] + Vec3(1e-8, 0, 0);
    fluid.point.integers["side"][5] = 1;
    io::writeVtp(at("0/fluid.vtp"), fluid);
    const Result broken = run("checkMesh");
    EXPECT_EQ(broken.code, 2);
    EXPECT_TRUE(contains(broken.err, "1 fluid particles have the wrong side (first: particle 5 at (")) << broken.err;
    EXPECT_TRUE(contains(broken.err, "overlap: two fluid particles are 0.010 dx apart")) << broken.err;
    EXPECT_TRUE(contains(broken.err, "2 checks failed.")) << broken.err;

    fluid.texts.clear();
    io::writeVtp(at("0/fluid.vtp"), fluid);
    const Result silent = run("checkMesh");
    EXPECT_EQ(silent.code, 2);
    EXPECT_TRUE(
        contains(silent.err, "0/fluid.vtp: does not say for which settings it was made; run particleFill again"))
        << silent.err;
}

TEST_F(Utilities, AMeshEnclosesTheVolumeOfItsShape) {
    const std::string onSurface = "-set system/mesh.yaml:/cells/0/enclose=surface";
    EXPECT_EQ(run("membraneMesh", onSurface).code, 0);
    EXPECT_EQ(run("particleFill", onSurface).code, 0);
    EXPECT_EQ(run("checkMesh", onSurface).code, 0);
    const Result other = run("checkMesh");
    EXPECT_EQ(other.code, 2);
    EXPECT_TRUE(contains(other.err, "cells[0].enclose: the case says exact, but 0/rbc.vtp was made for surface"))
        << other.err;

    EXPECT_EQ(run("membraneMesh").code, 0);
    EXPECT_EQ(run("particleFill").code, 0);
    const Result check = run("checkMesh");
    EXPECT_EQ(check.code, 0) << check.err;
    const io::PolyData mesh = io::readVtp(at("0/rbc.vtp"));
    double volume = 0;
    for (const auto& t : mesh.triangles)
        volume += mesh.points[t[0]].dot(mesh.points[t[1]].cross(mesh.points[t[2]])) / 6;
    EXPECT_NEAR(volume / 85.988326e-18, 1, 1e-7);

    io::PolyData larger = mesh;
    for (Vec3& x : larger.points) x *= 1.001;
    io::writeVtp(at("0/rbc.vtp"), larger);
    const Result off = run("checkMesh");
    EXPECT_EQ(off.code, 2);
    EXPECT_TRUE(contains(off.err, "the mesh encloses +0.3 % more than the shape")) << off.err;

    const Result unknown = run("membraneMesh", "-set system/mesh.yaml:/cells/0/enclose=exactly");
    EXPECT_EQ(unknown.code, 2);
    EXPECT_TRUE(contains(unknown.err, "exact")) << unknown.err;
}

TEST_F(Utilities, CellsInEachOtherAreRefused) {
    const std::string cells =
        "-set 'system/mesh.yaml:/cells=[{name: a, membrane: rbc, shape: {type: sphere, radius: 2 um}, edge: 0.8 um}, "
        "{name: b, membrane: rbc, shape: {type: sphere, radius: 2 um}, edge: 0.8 um, centre: [1 um, 0 um, 0 um]}]'";
    const Result mesh = run("membraneMesh", cells);
    EXPECT_EQ(mesh.code, 0) << mesh.err;
    EXPECT_TRUE(contains(mesh.out, "cell b: the same mesh")) << mesh.out;
    EXPECT_TRUE(contains(mesh.err, "the cell 'a' and the cell 'b' overlap at (")) << mesh.err;
    const Result fill = run("particleFill", cells);
    EXPECT_EQ(fill.code, 2);
    EXPECT_TRUE(contains(fill.err, "cells[1].centre: the cell 'a' and the cell 'b' overlap at (")) << fill.err;
}

TEST_F(Utilities, FluidAloneNeedsNoMesh) {
    fs::remove(at("constant/membranes.yaml"));
    writeText(at("constant/flow.yaml"), "type: shear\nshearRate: 100 1/s\n");
    const json fill = runJson("particleFill", "-set 'system/mesh.yaml:/cells=[]'");
    EXPECT_EQ(fill["fluid"], 1200);
    EXPECT_EQ(run("checkMesh", "-set 'system/mesh.yaml:/cells=[]'").code, 0);
}

TEST_F(Utilities, ErrorsSayWhatToDo) {
    Result missing = run("particleFill");
    EXPECT_EQ(missing.code, 4);
    EXPECT_TRUE(contains(missing.err, "run membraneMesh first")) << missing.err;
    EXPECT_EQ(run("checkMesh").code, 4);

    const Result unknown = run("membraneMesh", "-set 'system/mesh.yaml:/fil={}'");
    EXPECT_EQ(unknown.code, 2);
    EXPECT_TRUE(contains(unknown.err, "fill")) << unknown.err;

    const Result option = run("particleFill", "-quite");
    EXPECT_EQ(option.code, 1);
    EXPECT_TRUE(contains(option.err, "Did you mean '-quiet'?")) << option.err;
}

TEST_F(Utilities, WhatLiesOutsideTheSafeRangesIsNamed) {
    const std::string scheme =
        "-set system/numerics.yaml:/integrator=implicit -set system/numerics.yaml:/coupling=immersed -json ";
    const Result inside = run("checkCase", scheme + "-set constant/flow.yaml:/Ca=0.1");
    ASSERT_EQ(inside.code, 0) << inside.err;
    EXPECT_FALSE(json::parse(inside.out).contains("outsideSafeRange")) << inside.out;
    const auto outside = [&](const std::string& setting, const char* words) {
        const Result result = run("checkCase", scheme + "-set " + setting);
        ASSERT_EQ(result.code, 0) << result.err;
        const json found = json::parse(result.out).at("outsideSafeRange");
        ASSERT_EQ(found.size(), 1u) << found;
        EXPECT_NE(found[0].get<std::string>().find(words), std::string::npos) << found;
        EXPECT_NE(result.err.find("is known to be safe"), std::string::npos) << result.err;
    };
    outside("constant/flow.yaml:/Ca=1e4", "Ca = 1e+04 is outside");
    outside("constant/flow.yaml:/Ca=0.005", "edge/dx of 'rbc' = 0.8 is outside");
    const std::string twins =
        "'system/mesh.yaml:/cells=[{name: one, membrane: rbc, shape: {type: sphere, radius: 2 um}, edge: 0.8 dx, "
        "centre: [-3 um, 0 um, 0 um]}, {name: two, membrane: rbc, shape: {type: sphere, radius: 2 um}, edge: 0.8 dx, "
        "centre: "
        "[3 um, 0 um, 0 um]}]' -set ";
    outside(twins + "constant/flow.yaml:/Ca=0.005", "edge/dx of 'one' = 0.8 is outside");
}

TEST_F(Utilities, DiskIsForAllTimesThatAreWritten) {
    const auto disk = [&](const std::string& steps) {
        const Result result = run("checkCase", "-json -set 'system/control.yaml:/write={steps: " + steps + "}'");
        EXPECT_EQ(result.code, 0) << result.err;
        return json::parse(result.out).at("disk_B").get<double>();
    };
    const double once = disk("1000000"), often = disk("100"), more = disk("10");
    EXPECT_GT(often, once);
    EXPECT_NEAR((more - once) / (often - once), 10, 0.5);
}

// An edge may be given in particle spacings.
TEST_F(Utilities, EdgeInSpacingsIsThatInMetres) {
    const auto edgeOf = [&](const std::string& edge) {
        const Result result = run("checkCase", "-json -set 'system/mesh.yaml:/cells/0/edge=" + edge + "'");
        EXPECT_EQ(result.code, 0) << result.err;
        return json::parse(result.out).at("groups").at("edge/dx").get<double>();
    };
    EXPECT_DOUBLE_EQ(edgeOf("0.75 um"), 0.75);
    EXPECT_DOUBLE_EQ(edgeOf("0.75 dx"), 0.75);
}

TEST_F(Utilities, EveryCellHasItsGroups) {
    const std::string cells =
        "-set 'system/mesh.yaml:/cells=[{name: one, membrane: rbc, shape: {type: sphere, radius: 2 um}, edge: 0.8 um, "
        "centre: [-5 um, 0 um, 0 um]}, {name: same, membrane: rbc, shape: {type: sphere, radius: 2 um}, edge: 0.8 um}, "
        "{name: stiff, membrane: rbc, shape: {type: sphere, radius: 1 um}, edge: 0.5 um, centre: [5 um, 0 um, 0 um]}]' "
        "-set system/numerics.yaml:/integrator=implicit -set system/numerics.yaml:/coupling=immersed -json "
        "-set constant/flow.yaml:/Ca=12";
    const Result result = run("checkCase", cells);
    ASSERT_EQ(result.code, 0) << result.err;
    const json groups = json::parse(result.out).at("groups");
    EXPECT_NEAR(groups.at("Ca").get<double>(), 12, 1e-9);
    EXPECT_NEAR(groups.at("Ca (stiff)").get<double>(), 6, 1e-9);
    EXPECT_FALSE(groups.contains("Ca (same)")) << groups;
    EXPECT_FALSE(groups.contains("lambda (stiff)")) << groups;
    EXPECT_TRUE(groups.contains("a/dx (stiff)")) << groups;
}

// A dimensionless group that only a later cell has is also named after that cell.
TEST_F(Utilities, GroupsOfALaterCellAloneAreItsOwn) {
    const Result result =
        run("checkCase",
            "-set 'system/mesh.yaml:/cells=[{name: plain, shape: {type: sphere, radius: 2 um}, edge: 0.8 um, centre: "
            "[-3 um, 0 um, 0 um]}, {name: rbc, shape: {type: sphere, radius: 2 um}, edge: 0.8 um, centre: [3 um, 0 um, "
            "0 um]}]' "
            "-set 'constant/membranes.yaml:/plain={bonds: {type: harmonic, k: 5e-4 N/m}}' -json");
    ASSERT_EQ(result.code, 0) << result.err;
    const json groups = json::parse(result.out).at("groups");
    EXPECT_TRUE(groups.contains("E_b (rbc)")) << groups;
    EXPECT_FALSE(groups.contains("E_b")) << groups;
}

TEST_F(Utilities, ModelsAreListed) {
    const Result all = run("listModels");
    EXPECT_EQ(all.code, 0);
    for (const char* name :
         {"bond law", "harmonic", "kuchelFackerell", "wendlandC2", "tait", "shear", "conservation", "bondStretch"})
        EXPECT_TRUE(contains(all.out, name)) << name;
    EXPECT_TRUE(contains(run("listModels", "bondLaw").out, "spring constant"));
    EXPECT_TRUE(contains(run("listModels", "kuchelFackerell").out, "diameter"));
    EXPECT_TRUE(contains(run("listModels", "numerics").out, "particle spacing"));
    EXPECT_TRUE(runJson("listModels")["kernel"].contains("quintic"));
    const Result unknown = run("listModels", "kernl");
    EXPECT_EQ(unknown.code, 1);
    EXPECT_TRUE(contains(unknown.err, "Did you mean 'kernel'?")) << unknown.err;

    const std::string page = run("listModels", "-markdown").out;
    for (const char* part :
         {"# Dictionary reference", "## system/mesh.yaml", "## constant/flow.yaml", "## kernel", "### wendlandC2"})
        EXPECT_TRUE(contains(page, part)) << part;

    EXPECT_EQ(run("listModels", "-schema " + at("schema").string()).code, 0);
    for (const char* file : {"control", "numerics", "mesh", "observers", "fluid", "membranes", "flow"})
        EXPECT_FALSE(json::parse(readText(at(std::string("schema/") + file + ".json")), nullptr, false).is_discarded())
            << file;
}

}  // namespace
