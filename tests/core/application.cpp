// Runs sampleApplication as a user would, and checks exit code and output.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/atomicFile.hpp"

namespace corpuscle {
namespace {

namespace fs = std::filesystem;

struct Outcome {
    int code = -1;
    std::string text;
};

Outcome shell(const std::string& command) {
    Outcome outcome;
    std::FILE* pipe = popen(command.c_str(), "r");
    std::array<char, 4096> buffer;
    for (std::size_t n; (n = std::fread(buffer.data(), 1, buffer.size(), pipe)) > 0;)
        outcome.text.append(buffer.data(), n);
    const int status = pclose(pipe);
    outcome.code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    return outcome;
}

class Application : public testing::Test {
  protected:
    void SetUp() override {
        folder = fs::temp_directory_path() / "corpuscleApplication";
        writeFileAtomically(folder / "system/control.yaml", "write: {strain: 0.5}\n");
    }
    void TearDown() override { fs::remove_all(folder); }

    Outcome run(const std::string& options, const std::string& before = "", const std::string& after = "2>&1") const {
        return shell(before + " " SAMPLE_APPLICATION " -case " + folder.string() + " " + options + " " + after);
    }
    static void expectPart(const Outcome& o, const std::string& part) {
        EXPECT_NE(o.text.find(part), std::string::npos) << part << "\n" << o.text;
    }
    fs::path folder;
};

TEST_F(Application, readsTheCaseWithItsChanges) {
    const Outcome o =
        run("-quiet -steps 3 -set system/control.yaml:/write/strain=0.25 -set 'system/control.yaml:/end=1 s'");
    EXPECT_EQ(o.code, 0);
    EXPECT_EQ(o.text, "write:\n  strain: 0.25\nend: 1 s\n");
    EXPECT_NE(readFile(folder / "log.sample").find("steps 3"), std::string::npos);
}

TEST_F(Application, wrongUsage) {
    const auto expectUsage = [&](const std::string& options, const std::string& part) {
        const Outcome o = run(options);
        EXPECT_EQ(o.code, 1) << options;
        expectPart(o, part);
    };
    expectUsage("-stpes 3", "Did you mean '-steps'?");
    expectUsage("-steps", "needs its value, N");
    expectUsage("-steps x", "whole number");
    expectUsage("-steps 1 -steps 2", "given twice");
    expectUsage("word", "unexpected argument 'word'");
    expectUsage("-set nonsense", "FILE:/path/to/key=value");
}

TEST_F(Application, helpAndVersionDoNothingElse) {
    const Outcome help = run("--help");
    EXPECT_EQ(help.code, 0);
    for (const char* part :
         {"sample: A sample.", "-case DIR", "-steps N", "Sample runs:\n  sample -steps 3", "Exit codes"})
        expectPart(help, part);
    expectPart(run("-version"), "Corpuscle");
    EXPECT_FALSE(fs::exists(folder / "log.sample"));
}

TEST_F(Application, invalidCase) {
    Outcome o = run("-set system/contrl.yaml:/a=1");
    EXPECT_EQ(o.code, 2);
    expectPart(o, "-set: system/contrl.yaml: the case has no such file. Did you mean 'system/control.yaml'?");
    writeFileAtomically(folder / "system/control.yaml", "a: 1\na: 2\nb: &x 3\n");
    o = run("");
    EXPECT_EQ(o.code, 2);
    expectPart(o, "system/control.yaml:2:1: a: this key stands twice");
    expectPart(o, "2 problems in the case");
    const Outcome json = run("-json", "", "2>/dev/null");
    const auto problems = nlohmann::json::parse(json.text)["problems"];
    ASSERT_EQ(problems.size(), 2u);
    EXPECT_EQ(problems[0]["line"], 2);
    fs::remove(folder / "system/control.yaml");
    EXPECT_EQ(run("").code, 2);
}

TEST_F(Application, failuresBecomeExitCodes) {
    const Outcome o = run("-fail numerics");
    EXPECT_EQ(o.code, 3);
    expectPart(o, "sample: NaN in step 3");
    EXPECT_EQ(run("-fail stopped").code, 5);
}

TEST_F(Application, oneFailingRankEndsAll) {
    const std::string two =
        "OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 timeout 40 " MPIEXEC " --oversubscribe -np 2";
    Outcome o = run("-fail one", two);  // the other rank waits in a barrier
    EXPECT_EQ(o.code, 4) << o.text;
    expectPart(o, "[rank 1] sample: the disk is full");
    o = run("-fail numerics", two);  // all ranks fail alike: reported once
    EXPECT_EQ(o.code, 3) << o.text;
    EXPECT_EQ(o.text.find("NaN in step 3"), o.text.rfind("NaN in step 3"));
}

TEST_F(Application, errorsAreRecordedFromWhicheverRankKnowsOfThem) {
    const auto record = [&] { return nlohmann::json::parse(readFile(folder / "run.json")); };
    run("-fail numerics");
    EXPECT_EQ(record()["status"], "failed");
    EXPECT_EQ(record()["reason"], "NaN in step 3");
    run("-fail one",
        "OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 timeout 40 " MPIEXEC " --oversubscribe -np 2");
    EXPECT_EQ(record()["status"], "failed");
    EXPECT_EQ(record()["reason"], "the disk is full");
}

TEST_F(Application, memoryThatRunsOutIsSaidInWords) {
    for (const char* how : {"memory", "memoryTogether"}) {
        const Outcome o = run(std::string("-fail ") + how);
        EXPECT_EQ(o.code, 4) << o.text;
        expectPart(o, "sample: no memory is left: this process had up to ");
        EXPECT_EQ(o.text.find("bad_alloc"), std::string::npos) << o.text;
    }
}

TEST_F(Application, closedStreamsAndPipesDoNotEndIt) {
    EXPECT_EQ(shell("bash -c 'trap - PIPE; " SAMPLE_APPLICATION " -case " + folder.string() +
                    " | true; exit ${PIPESTATUS[0]}'")
                  .code,
              0);
    EXPECT_EQ(run("", "", ">&- 2>&-").code, 0);
    const std::string log = readFile(folder / "log.sample");
    EXPECT_NE(log.find("steps -1"), std::string::npos);
    EXPECT_EQ(log.find("write:"), std::string::npos) << "standard output went into the log: " << log;
    const Outcome full = run("-json", "", "2>&1 >/dev/full");
    EXPECT_EQ(full.code, 4);
    expectPart(full, "cannot write standard output: No space left on device");
}

}  // namespace
}  // namespace corpuscle
