// Sweeps over cases whose programs are shell scripts: which of them run once, which run again, and what is refused.
#include "study/sweep.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <thread>

#include "core/atomicFile.hpp"
#include "study/batch.hpp"
#include "study/report.hpp"

namespace corpuscle::study {
namespace {

namespace fs = std::filesystem;

class SweepTest : public testing::Test {
  protected:
    void SetUp() override {
        base_ = fs::path(testing::TempDir()) / ("sweep" + std::to_string(getpid()));
        fs::remove_all(base_);
        write("template/system/control.yaml", "application: one  # kept\nendStrain: 1\n");
        write("template/constant/flow.yaml", "Ca: 0.1\n");
        write("template/constant/places.csv", "x\n1\n");
        program("one", "echo \"one $2\" >>" + (base_ / "calls").string());
        program("two", "echo \"two $2\" >>" + (base_ / "calls").string());
        options_ = {.base = base_,
                    .studyFile = "study.yaml",
                    .templateCase = base_ / "template",
                    .cases = base_ / "cases",
                    .programFolder = base_ / "bin",
                    .jobs = 2};
        for (const char* Ca : {"0.1", "0.2", "0.3"})
            cases_.push_back({.name = std::string("Ca") + Ca,
                              .values = {{"Ca", Ca}},
                              .settings = {{"constant/flow.yaml", "/Ca", Ca}},
                              .programs = {"one", "two"}});
    }
    void TearDown() override { fs::remove_all(base_); }

    void write(const std::string& file, const std::string& text) const { writeFileAtomically(base_ / file, text); }
    void program(const std::string& name, const std::string& body) const {
        write("bin/" + name, "#!/bin/sh\n" + body + "\n");
        fs::permissions(base_ / "bin" / name, fs::perms::owner_all);
    }
    std::vector<std::string> calls() const {
        std::ifstream file(base_ / "calls");
        std::vector<std::string> lines;
        for (std::string line; std::getline(file, line);) {
            const std::size_t slash = line.rfind('/');
            lines.push_back(line.substr(0, 4) + line.substr(slash + 1));
        }
        return lines;
    }
    std::vector<std::string> sorted(std::vector<std::string> lines) const {
        std::sort(lines.begin(), lines.end());
        return lines;
    }
    std::vector<CaseState> run(const std::function<bool(Sweep&)>& until = {}) const {
        Sweep sweep(options_, cases_, Environment::ofThisProcess());
        while (!sweep.isEnded()) {
            sweep.advance();
            if (until && !sweep.isStopping() && until(sweep)) sweep.stop();
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
        }
        std::vector<CaseState> states;
        for (const CaseStatus& one : sweep.cases()) states.push_back(one.state);
        return states;
    }

    fs::path base_;
    SweepOptions options_;
    std::vector<StudyCase> cases_;
    const std::vector<CaseState> allDone_{CaseState::done, CaseState::done, CaseState::done};
};

TEST_F(SweepTest, RunsEachProgramOnceInEachCase) {
    EXPECT_EQ(run(), allDone_);
    const std::vector<std::string> once{"one Ca0.1", "one Ca0.2", "one Ca0.3", "two Ca0.1", "two Ca0.2", "two Ca0.3"};
    EXPECT_EQ(sorted(calls()), once);
    EXPECT_EQ(run(), allDone_);
    EXPECT_EQ(sorted(calls()), once);
    EXPECT_EQ(readFile(base_ / "cases/Ca0.3/constant/flow.yaml"), "Ca: 0.3\n");
    EXPECT_EQ(readFile(base_ / "cases/Ca0.3/system/control.yaml"), "application: one  # kept\nendStrain: 1\n");
    cases_.push_back({.name = "Ca0.4",
                      .values = {{"Ca", "0.4"}},
                      .settings = {{"constant/flow.yaml", "/Ca", "0.4"}},
                      .programs = {"one", "two"}});
    EXPECT_EQ(run().back(), CaseState::done);  // one more value
    EXPECT_EQ(calls().size(), 8u);
}

TEST_F(SweepTest, AFailureKeepsItsLogAndDoesNotStopTheOthers) {
    program("two",
            "case $2 in *Ca0.2) echo it is broken; exit 3;; esac; echo \"two $2\" >>" + (base_ / "calls").string());
    const std::vector<CaseState> states{CaseState::done, CaseState::failed, CaseState::done};
    EXPECT_EQ(run(), states);
    EXPECT_EQ(run(), states);  // does not run again
    EXPECT_EQ(calls().size(), 5u);
    const auto record = CaseRecord::read(base_ / "cases/Ca0.2");
    ASSERT_TRUE(record && record->failed);
    EXPECT_EQ(record->failed->code, 3);
    EXPECT_EQ(record->failed->logEnd, "it is broken");
    program("two", "echo \"two $2\" >>" + (base_ / "calls").string());
    options_.retry = true;
    EXPECT_EQ(run(), allDone_);
    EXPECT_EQ(calls().size(), 6u);
}

TEST_F(SweepTest, AProgramThatIsMissingOrKilledIsAFailure) {
    for (StudyCase& one : cases_) one.programs = {"one", "notThere"};
    EXPECT_EQ(run(), std::vector<CaseState>(3, CaseState::failed));
    EXPECT_NE(CaseRecord::read(base_ / "cases/Ca0.1")->failed->logEnd.find("notThere cannot be started"),
              std::string::npos);
    for (StudyCase& one : cases_) one.programs = {"one", "two"};
    program("two", "kill -9 $$");
    options_.retry = true;
    EXPECT_EQ(run(), std::vector<CaseState>(3, CaseState::failed));
    EXPECT_EQ(CaseRecord::read(base_ / "cases/Ca0.1")->failed->code, 128 + SIGKILL);
}

TEST_F(SweepTest, StopsOnRequestAndGoesOn) {
    program("two", "echo \"two $2\" >>" + (base_ / "calls").string() +
                       "\n[ -e $2/again ] && exit 0\ntrap 'exit 5' TERM\n"
                       "touch $2/again\nsleep 5 & wait");
    const auto states =
        run([&](Sweep&) { return fs::exists(base_ / "cases/Ca0.1/again") && fs::exists(base_ / "cases/Ca0.2/again"); });
    EXPECT_EQ(states[0], CaseState::stopped);
    EXPECT_EQ(states[1], CaseState::stopped);
    EXPECT_EQ(states[2], CaseState::waiting);
    write("cases/Ca0.3/again", "");
    fs::remove_all(base_ / "cases/Ca0.3");
    program("two", "echo \"two $2\" >>" + (base_ / "calls").string());
    EXPECT_EQ(run(), allDone_);
    const auto all = calls();
    EXPECT_EQ(std::count(all.begin(), all.end(), "one Ca0.1"), 1);  // had already ended
    EXPECT_EQ(std::count(all.begin(), all.end(), "two Ca0.1"), 2);
}

TEST_F(SweepTest, ASolverThatReachesItsWallClockLimitGoesOnAtOnce) {
    const std::string record = R"({"reason": "the wall-clock limit of 2 h 00 min", "performance": {"steps": 9}})";
    program("two", "echo \"two $2\" >>" + (base_ / "calls").string() +
                       "\n[ -e $2/again ] && exit 0\ntouch $2/again\n"
                       "echo '" +
                       record + "' >$2/run.json\nexit 5");
    EXPECT_EQ(run(), allDone_);
    const auto all = calls();
    EXPECT_EQ(std::count(all.begin(), all.end(), "two Ca0.2"), 2);
    // If a user makes the stop file, the case must stay stopped.
    fs::remove_all(base_ / "cases");
    program("two", "echo '{\"reason\": \"the file stop appeared\"}' >$2/run.json\nexit 5");
    EXPECT_EQ(run(), std::vector<CaseState>(3, CaseState::stopped));
}

TEST_F(SweepTest, CasesThatDifferAreNamed) {
    for (StudyCase& one : cases_) one.programs = {"one", "dmpFlow"};
    program("dmpFlow", "echo \"two $2\" >>" + (base_ / "calls").string() + "\necho '{}' >$2/run.json");
    run();
    write("template/system/control.yaml", "application: one\nendStrain: 2\n");
    write("template/constant/places.csv", "x\n2\n");
    const auto refusal = [&] {
        try {
            run();
        } catch (const Failure& failure) {
            return std::string(failure.what());
        }
        return std::string();
    };
    EXPECT_NE(refusal().find("Ca0.2: system/control.yaml:/endStrain is 1 and would be 2; the template's "
                             "constant/places.csv has changed"),
              std::string::npos);
    EXPECT_EQ(calls().size(), 6u);
    options_.differing = Differing::keep;
    EXPECT_EQ(run(), allDone_);
    EXPECT_EQ(calls().size(), 6u);
    // Refused after such changes, since old results would pass for new ones.
    options_.differing = Differing::update;
    EXPECT_NE(refusal().find("places.csv has changed"), std::string::npos);
    write("template/constant/places.csv", "x\n1\n");
    write("cases/Ca0.2/results/kept", "x");
    EXPECT_EQ(run(), allDone_);
    EXPECT_EQ(calls().size(), 9u);  // only the solver continues
    EXPECT_EQ(readFile(base_ / "cases/Ca0.2/system/control.yaml"), "application: one\nendStrain: 2\n");
    EXPECT_TRUE(fs::exists(base_ / "cases/Ca0.2/results/kept"));
    options_.differing = Differing::refuse;
    EXPECT_EQ(refusal(), "");
    write("template/system/control.yaml~", "an editor's\n");
    write("template/README.md", "a page\n");
    EXPECT_EQ(refusal(), "");
    write("template/cell.stl", "1");  // beside system/, and therefore copied too
    EXPECT_NE(refusal().find("the template's cell.stl has changed"), std::string::npos);
    fs::remove(base_ / "template/cell.stl");
    write("template/constant/contact.yaml", "a: 1\n");
    EXPECT_NE(refusal().find("constant/contact.yaml is missing"), std::string::npos);
    options_.differing = Differing::fresh;
    EXPECT_EQ(run(), allDone_);
    EXPECT_EQ(calls().size(), 15u);
    EXPECT_FALSE(fs::exists(base_ / "cases/Ca0.2/results/kept"));
    fs::remove(base_ / "template/constant/contact.yaml");
    options_.differing = Differing::refuse;
    EXPECT_NE(refusal().find("constant/contact.yaml is not in the template"), std::string::npos);
    options_.readOnly = true;
    options_.differing = Differing::fresh;
    EXPECT_EQ(run(), allDone_);  // nothing is removed and nothing runs
    EXPECT_EQ(calls().size(), 15u);
}

TEST_F(SweepTest, WhatIsNotThereAnyMoreRunsAgain) {
    for (StudyCase& one : cases_) one.programs = {"one", "dmpFlow"};
    program("dmpFlow", "echo \"two $2\" >>" + (base_ / "calls").string() + "\necho '{}' >$2/run.json");
    EXPECT_EQ(run(), allDone_);
    fs::remove(base_ / "cases/Ca0.2/run.json");  // as cleanCase does
    EXPECT_EQ(run(), allDone_);
    EXPECT_EQ(calls().size(), 7u);
    // Another list of programs: runs from the first that differs.
    for (StudyCase& one : cases_) one.programs = {"two", "dmpFlow"};
    EXPECT_EQ(run(), allDone_);
    EXPECT_EQ(calls().size(), 13u);
}

TEST_F(SweepTest, FailedCasesAreMadeAnewByFresh) {
    program("two", "[ -e $2/constant/good ]");
    EXPECT_EQ(run(), std::vector<CaseState>(3, CaseState::failed));
    write("template/constant/good", "");
    options_.differing = Differing::fresh;
    EXPECT_EQ(run(), allDone_);
}

TEST_F(SweepTest, UpdateGoesOnWithTheSolverAndWhatStandsBehindIt) {
    for (StudyCase& one : cases_) one.programs = {"one", "dmpFlow", "two"};
    program("dmpFlow", "echo \"run $2\" >>" + (base_ / "calls").string() + "\necho '{}' >$2/run.json");
    EXPECT_EQ(run(), allDone_);
    EXPECT_EQ(calls().size(), 9u);
    write("template/system/control.yaml", "application: one\nendStrain: 7\n");
    options_.differing = Differing::update;
    EXPECT_EQ(run(), allDone_);
    EXPECT_EQ(calls().size(), 15u);  // dmpFlow and two, in each case
    options_.differing = Differing::refuse;
    EXPECT_EQ(run(), allDone_);
    write("template/system/control.yaml", "application: other\nendStrain: 7\n");  // another solver is another case
    options_.differing = Differing::update;
    EXPECT_THROW(run(), Failure);
}

TEST_F(SweepTest, FreshIsDecidedOnceMoreWhenTheCaseIsTaken) {
    run();
    write("template/constant/flow.yaml", "Ca: 0.1\nx: 1\n");
    options_.differing = Differing::fresh;
    options_.jobs = 1;
    Sweep late(options_, cases_, Environment::ofThisProcess());  // has made its plan ...
    EXPECT_EQ(run(), allDone_);                                  // ... but another run has completed all cases by now
    EXPECT_EQ(calls().size(), 12u);
    while (!late.isEnded()) {
        late.advance();
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    EXPECT_EQ(calls().size(), 12u);
}

TEST_F(SweepTest, RetryAndFreshOfFailedCases) {
    program("two", "exit 3");
    run();
    write("cases/Ca0.1/marker", "");
    write("cases/Ca0.2/case.lock", "");
    program("two", "exit 0");
    options_.retry = true;
    // Another process looks at the lock for a moment.
    const int held = open((base_ / "cases/Ca0.2/case.lock").c_str(), O_RDWR);
    ASSERT_EQ(flock(held, LOCK_EX), 0);
    Sweep sweep(options_, cases_, Environment::ofThisProcess());
    while (!sweep.isEnded()) {
        sweep.advance();
        if (sweep.cases()[1].state == CaseState::elsewhere) flock(held, LOCK_UN);
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    close(held);
    EXPECT_EQ(sweep.cases()[1].state, CaseState::done);
    program("two", "exit 3");
    for (const char* name : {"Ca0.1", "Ca0.2", "Ca0.3"}) fs::remove_all(base_ / "cases" / name);
    run();
    write("cases/Ca0.1/marker", "");
    program("two", "exit 0");
    options_.differing = Differing::fresh;
    EXPECT_EQ(run(), allDone_);
    EXPECT_FALSE(fs::exists(base_ / "cases/Ca0.1/marker"));
}

TEST_F(SweepTest, ADamagedRecordIsOfItsCaseAlone) {
    run();
    write("cases/Ca0.2/sweep.json", "{");
    EXPECT_THROW(run(), Failure);
    const std::vector<CaseState> states{CaseState::done, CaseState::failed, CaseState::done};
    options_.differing = Differing::keep;
    EXPECT_EQ(run(), states);
    options_.differing = Differing::refuse;
    options_.readOnly = true;
    EXPECT_EQ(run(), states);
    options_.readOnly = false;
    options_.differing = Differing::fresh;
    fs::create_directories(base_ / "cases/.Ca0.2.old/left");  // left by a kill
    EXPECT_EQ(run(), allDone_);
    EXPECT_FALSE(fs::exists(base_ / "cases/.Ca0.2.old"));
}

TEST_F(SweepTest, WhatGoesWrongInOneCaseStopsNoOther) {
    program("one", "case $2 in *Ca0.1) rm -r $2/log.caseSweep; mkdir $2/log.caseSweep;; *Ca0.2) rm -r $2;; esac");
    const std::vector<CaseState> states{CaseState::failed, CaseState::failed, CaseState::done};
    EXPECT_EQ(run(), states);
    EXPECT_FALSE(fs::exists(base_ / "cases/Ca0.2"));
}

TEST_F(SweepTest, KeptCasesKeepTheirValues) {
    run();
    options_.differing = Differing::keep;
    cases_[0].values = {{"Ca", "0.7"}};  // as with another seed of a Latin hypercube
    cases_[0].settings[0].value = "0.7";
    const Sweep sweep(options_, cases_, Environment::ofThisProcess());
    EXPECT_EQ(sweep.cases()[0].what.values[0].second, "0.1");
}

TEST_F(SweepTest, ACaseInWhichSomebodyWorksIsLeftAlone) {
    run();
    write("cases/Ca0.2/case.lock", "");
    write("template/constant/flow.yaml", "Ca: 0.1\nx: 1\n");
    options_.differing = Differing::fresh;
    const int held = open((base_ / "cases/Ca0.2/case.lock").c_str(), O_RDWR);
    ASSERT_EQ(flock(held, LOCK_EX), 0);
    const auto states = run([&](Sweep& sweep) { return sweep.cases()[2].state == CaseState::done; });
    EXPECT_EQ(states, (std::vector<CaseState>{CaseState::done, CaseState::elsewhere, CaseState::done}));
    EXPECT_EQ(readFile(base_ / "cases/Ca0.2/constant/flow.yaml"), "Ca: 0.2\n");
    close(held);
    EXPECT_EQ(run(), allDone_);
    EXPECT_EQ(readFile(base_ / "cases/Ca0.2/constant/flow.yaml"), "Ca: 0.2\nx: 1\n");
}

TEST_F(SweepTest, ASignalFromOutsideIsAStop) {
    program("two", "kill -TERM $$");
    EXPECT_EQ(run(), std::vector<CaseState>(3, CaseState::stopped));
    program("two", "exit 0");
    EXPECT_EQ(run(), allDone_);
}

TEST_F(SweepTest, ASolverThatDoesNotAdvanceIsNotStartedForEver) {
    const std::string record = R"({"reason": "the wall-clock limit of 1 ms", "performance": {"steps": 0}})";
    program("two", "echo '" + record + "' >$2/run.json\nexit 5");
    EXPECT_EQ(run(), std::vector<CaseState>(3, CaseState::stopped));
}

TEST_F(SweepTest, FoldersOfOthersAreLeftAlone) {
    write("cases/Ca0.2/mine", "x");
    EXPECT_THROW(run(), Failure);
    EXPECT_TRUE(fs::exists(base_ / "cases/Ca0.2/mine"));
    EXPECT_TRUE(calls().empty());
    fs::remove_all(base_ / "cases");
    run();
}

TEST_F(SweepTest, TwoSweepsShareTheCases) {
    program("one", "echo \"one $2\" >>" + (base_ / "calls").string() + "\nsleep 0.2");
    options_.jobs = 1;
    std::vector<CaseState> other;
    std::thread second([&] { other = run(); });
    const auto first = run();
    second.join();
    EXPECT_EQ(first, allDone_);
    EXPECT_EQ(other, allDone_);
    EXPECT_EQ(calls().size(), 6u);
}

TEST_F(SweepTest, TheReportIsSafeAndWhole) {
    run();
    StudySettings settings;
    settings.parameters["Ca"] = {};
    settings.parameters["Ca"].values = std::vector<std::string>{"0.1", "0.2", "0.3"};
    Sweep sweep(options_, cases_, Environment::ofThisProcess());
    KnownResults known;
    const Summary summary = summarise(settings, sweep.cases(), options_.cases, known);
    const std::string page = reportPage(
        summary, {.title = "<b>&", .templateCase = "t", .settings = {"a:/b=\"x\""}, .version = "0", .date = "d"},
        base_ / "scratch", Environment::ofThisProcess());
    EXPECT_NE(page.find("<h1>&lt;b&gt;&amp;</h1>"), std::string::npos);
    EXPECT_NE(page.find("a:/b=&quot;x&quot;"), std::string::npos);
    EXPECT_EQ(page.find("http"), std::string::npos);  // nothing is loaded from elsewhere
    const std::string table = csvText(summary, "a study");
    EXPECT_NE(table.find("case,status,Ca,runTime_s\nCa0.1,done,0.1,"), std::string::npos);
}

TEST(Batch, QuotesNames) {
    const Batch batch{.name = "it's",
                      .study = "it's.yaml",
                      .program = "caseSweep",
                      .casesFolder = "cases",
                      .names = {"a\"b", "c"},
                      .ranks = 4};
    const std::string script = slurmScript(batch);
    EXPECT_NE(script.find("exec 'caseSweep' 'it'\\''s.yaml' -only \"${CASES[SLURM_ARRAY_TASK_ID - 1]}\" -ranks 4"),
              std::string::npos);
    EXPECT_NE(script.find("CASES=(\n'a\"b'\n'c'\n)"), std::string::npos);
    EXPECT_NE(script.find("#SBATCH --array=1-2\n"), std::string::npos);
    EXPECT_NE(script.find("#SBATCH --job-name=it_s\n"), std::string::npos);
    EXPECT_NE(snakefile(batch).find("\"a\\\"b\","), std::string::npos);
}

}  // namespace
}  // namespace corpuscle::study
