// cloneCase, run as a user runs it: what is copied, what is left out, and what is refused.
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <set>
#include <sstream>

#include "io/temporaryFolder.hpp"

using corpuscle::TemporaryFolder;
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
bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

class CloneCase : public testing::Test {
  protected:
    struct Result {
        int code = 0;
        std::string text;
    };
    void SetUp() override {
        for (const char* file :
             {"old/README.md", "old/shapes/cell.stl", "old/0/rbc.vtp", "old/results/rbc.pvd",
              "old/postProcessing/a/0/a.csv", "old/checkpoints/000001.h5", "old/runs/turn/run.json", "old/log.dmpFlow",
              "old/log.dmpFlow.1", "old/run.json", "old/used.yaml", "old/stop", "old/case.lock", "old/.hidden",
              "old/__pycache__/a.pyc", "old/shapes/__pycache__/b.pyc"})
            writeText(at(file), "text");
        writeText(at("old/system/control.yaml"), "application: dmpFlow\nendStrain: 6   # long\n");
        writeText(at("old/system/mesh.yaml"),
                  "domain: {size: [20 um, 16 um, 16 um], periodic: [true, true, false]}\ncells: [{name: rbc, edge: 0.4 "
                  "um}]  # one\n");
        writeText(at("old/constant/flow.yaml"),
                  "# flow\ntype: shear\nCa: 0.02      # capillary number\ninertia: {Re: 0.1}\n");
        writeText(at("old/Allrun"), "#!/bin/sh\n");
        fs::permissions(at("old/Allrun"), fs::perms::owner_all);
    }
    fs::path at(const std::string& path) const { return folder_.path() / path; }
    Result run(const std::string& words) const {
        const fs::path out = at("out.txt");
        const std::string command = "cd " + folder_.path().string() +
                                    " && OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 " PROGRAM " " +
                                    words + " > " + out.string() + " 2>&1";
        const int status = std::system(command.c_str());
        return {WEXITSTATUS(status), readText(out)};
    }
    TemporaryFolder folder_;
};

TEST_F(CloneCase, CopiesTheCaseAndNoResults) {
    const Result result = run("old new/deep");
    ASSERT_EQ(result.code, 0) << result.text;
    std::set<std::string> found;
    for (const auto& entry : fs::directory_iterator(at("new/deep"))) found.insert(entry.path().filename());
    EXPECT_EQ(found, (std::set<std::string>{"Allrun", "README.md", "constant", "shapes", "system"}));
    EXPECT_TRUE(fs::exists(at("new/deep/shapes/cell.stl")) && !fs::exists(at("new/deep/shapes/__pycache__")));
    EXPECT_EQ(readText(at("new/deep/system/mesh.yaml")), readText(at("old/system/mesh.yaml")));
    EXPECT_NE(fs::status(at("new/deep/Allrun")).permissions() & fs::perms::owner_exec, fs::perms::none);
    EXPECT_TRUE(contains(result.text, "left behind: 0, __pycache__, case.lock, checkpoints, log.dmpFlow, "))
        << result.text;
    EXPECT_TRUE(fs::exists(at("old/results/rbc.pvd"))) << "the old case stays as it is";
}

TEST_F(CloneCase, ChangesStandInTheCopyAndCommentsStay) {
    const Result result =
        run("old new -set constant/flow.yaml:/Ca=0.1 -set 'system/mesh.yaml:/cells/0/edge=0.5 um' "
            "-set 'system/mesh.yaml:/domain/size=[24 um, 24 um, 24 um]' -set constant/flow.yaml:/inertia=physical");
    ASSERT_EQ(result.code, 0) << result.text;
    EXPECT_EQ(readText(at("new/constant/flow.yaml")),
              "# flow\ntype: shear\nCa: 0.1      # capillary number\ninertia: physical\n");
    EXPECT_EQ(readText(at("new/system/mesh.yaml")),
              "domain: {size: [24 um, 24 um, 24 um], periodic: [true, true, false]}\ncells: [{name: rbc, edge: 0.5 "
              "um}]  # one\n");
    EXPECT_TRUE(contains(readText(at("old/constant/flow.yaml")), "Ca: 0.02"));
    // Changes that the programs would refuse (a rate beside Ca, and without its unit) or whose entry they cannot find.
    for (const std::string change :
         {"constant/flow.yaml:/shearRate=10", "system/mesh.yaml:/cells/3/edge=1", "constant/flo.yaml:/Ca=1"}) {
        const Result other = run("old other -set '" + change + "'");
        EXPECT_EQ(other.code, 2) << other.text;
        EXPECT_FALSE(fs::exists(at("other"))) << change;
    }
    EXPECT_EQ(run("old added -set 'constant/flow.yaml:/walls={normal: y}'").code, 0);
    EXPECT_TRUE(contains(readText(at("added/constant/flow.yaml")), "walls: {normal: y}"));
}

TEST_F(CloneCase, WhatCannotBeIsRefused) {
    fs::create_directories(at("empty"));
    EXPECT_EQ(run("old empty").code, 0) << "an empty directory is free";
    const struct {
        const char *words, *message;
        int code;
    } wrong[] = {
        {"old empty", "exists already", 4},
        {"old out.txt", "exists already", 4},
        {"old old", "exists already", 4},
        {"old old/inner", "cannot be copied into itself", 1},
        {". new",
         "is not a case: it has neither system/control.yaml nor system/relax.yaml. Cases in it: ./empty, ./old.", 2},
        {"old/system new", "is not a case", 2},
        {"nothing new", "there is no such directory", 4},
        {"old", "the argument TO is missing", 1},
        {"old new more", "unexpected argument 'more'", 1}};
    for (const auto& w : wrong) {
        const Result result = run(w.words);
        EXPECT_EQ(result.code, w.code) << w.words << ": " << result.text;
        EXPECT_TRUE(contains(result.text, w.message)) << w.words << ": " << result.text;
        EXPECT_FALSE(fs::exists(at("new"))) << w.words;
    }
}

}  // namespace
