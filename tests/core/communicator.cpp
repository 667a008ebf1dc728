#include "core/communicator.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

#include "core/atomicFile.hpp"
#include "core/machineMemory.hpp"
#include "core/runRecord.hpp"
#include "core/wallClock.hpp"

namespace corpuscle {
namespace {

namespace fs = std::filesystem;

TEST(Communicator, ranksShareTheMemoryOfTheirMachine) {
    const Communicator c;
    EXPECT_EQ(memoryShortage(c, 1e6), "");
    const std::string text = memoryShortage(c, 1e18);
    EXPECT_TRUE(text.starts_with("888 PiB of memory is needed on ")) << text;
    EXPECT_NE(text.find("(" + std::to_string(c.size()) + " rank"), std::string::npos) << text;
    EXPECT_EQ(text, c.broadcast(text));
}

TEST(Communicator, reductionsAndTexts) {
    const Communicator c;
    const long n = c.size(), r = c.rank();
    EXPECT_EQ(c.sum(1.5), 1.5 * static_cast<double>(n));
    EXPECT_EQ(c.sum(r), n * (n - 1) / 2);
    EXPECT_EQ(c.max(r), n - 1);
    EXPECT_EQ(c.min(static_cast<double>(r)), 0.0);
    EXPECT_EQ(c.sum(std::vector<double>{1, 2}),
              (std::vector<double>{1.0 * static_cast<double>(n), 2.0 * static_cast<double>(n)}));
    EXPECT_EQ(c.max(std::vector<double>{-1.0 * static_cast<double>(r)})[0], 0.0);
    EXPECT_EQ(c.broadcast("rank " + std::to_string(r)), "rank 0");
    EXPECT_EQ(c.broadcast(std::string(c.isRoot() ? "" : "x")), "");
    EXPECT_TRUE(c.allTrue(true));
    EXPECT_EQ(c.allTrue(r != 0), false);
    EXPECT_EQ(c.anyTrue(r == n - 1), true);
    EXPECT_EQ(c.gatherAll(r).back(), n - 1);
    const auto texts = c.gather(std::string(static_cast<std::size_t>(r), 'x'));
    EXPECT_EQ(texts.size(), c.isRoot() ? static_cast<std::size_t>(n) : 0u);
    for (std::size_t i = 0; i < texts.size(); ++i) EXPECT_EQ(texts[i], std::string(i, 'x'));
}

// Rank r has r + q numbers for rank q, from 1000 r + q upwards: rank 0 has none for itself.
template <class T>
void expectExchange() {
    const Communicator c;
    const auto part = [](int from, int to) {
        std::vector<T> numbers;
        for (int k = 0; k < from + to; ++k) numbers.push_back(static_cast<T>(1000 * from + to + 0.5 * k));
        return numbers;
    };
    std::vector<std::vector<T>> forRank, expected;
    for (int q = 0; q < c.size(); ++q) forRank.push_back(part(c.rank(), q)), expected.push_back(part(q, c.rank()));
    EXPECT_EQ(c.exchange(forRank), expected);
}
TEST(Communicator, exchangeBringsEachRankWhatIsMeantForIt) {
    expectExchange<double>();
    expectExchange<int>();
}

fs::path folder() { return fs::temp_directory_path() / "corpuscleStopControl"; }

// Checks that every rank stops at the same step, for the same reason.
void expectStop(StopControl& control, const Communicator& c, const std::string& reason) {
    long step = 0;
    while (!control.requested(step) && step < 100000) {
        ++step;
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    EXPECT_LT(step, 10000);
    EXPECT_EQ(c.min(step), c.max(step));
    EXPECT_NE(control.reason().find(reason), std::string::npos) << control.reason();
}

TEST(StopControl, stopsForFileWallClockAndSignal) {
    const Communicator c;
    const fs::path file = folder() / "stop";
    if (c.isRoot()) writeFileAtomically(file, "");
    c.barrier();
    {
        StopControl control({file, {}}, c);
        expectStop(control, c, "the file 'stop'");
        c.barrier();
        EXPECT_FALSE(fs::exists(file));
    }
    {
        StopControl control({{}, 0.05}, c);
        expectStop(control, c, "wall-clock limit");
        EXPECT_GE(control.elapsed(), 0.05);
        EXPECT_EQ(c.min(control.elapsed()), c.max(control.elapsed()));
        WallTicker never, soon(0.01);
        EXPECT_FALSE(never.due(control));
        EXPECT_TRUE(soon.due(control));
        EXPECT_FALSE(soon.due(control));
    }
    StopControl control({}, c);
    if (c.rank() == c.size() - 1) std::raise(SIGUSR1);  // raised on one rank only
    expectStop(control, c, "SIGUSR1");
    if (c.isRoot()) fs::remove_all(folder());
}

// The first half of the run took at least 0.6 s, so the remaining time must be at least as long. Nothing more is
// reported before the pause is over.
TEST(Progress, saysWhatIsDoneAndWhatIsLeft) {
    const Communicator c;
    const fs::path file = folder() / "log";
    if (c.isRoot()) fs::create_directories(file.parent_path());
    Log log(c.isRoot(), true);
    log.open(file);
    Time time{.dt = 0.5, .shearRate = 2, .endTime = 4.0};
    Progress often(log, time, 0.5), seldom(log, time, 100);
    for (int k = 0; k < 4; ++k) time.advance(0.5);
    std::this_thread::sleep_for(std::chrono::milliseconds(600));
    often.report(time), seldom.report(time), often.report(time);
    if (!c.isRoot()) return;
    std::ifstream lines(file);
    std::string line, further;
    ASSERT_TRUE(std::getline(lines, line));
    EXPECT_FALSE(std::getline(lines, further)) << further;
    EXPECT_EQ(line.rfind("step 4  t 2 s  strain 4  dt 500 ms  50.0 %  ", 0), 0u) << line;
    const std::size_t left = line.find("  left ");
    ASSERT_NE(left, std::string::npos) << line;
    EXPECT_GE(std::stod(line.substr(left + 7)), 0.6) << line;
    fs::remove_all(folder());
}

TEST(RunRecord, isWholeAtEveryMoment) {
    const Communicator c;
    const fs::path file = folder() / "run.json";
    RunRecord record(file, "testFlow", c);
    record.set("groups", "Ca", 0.02);
    record.set("groups", "bad", std::nan(""));
    record.set("performance", "steps", 7);
    record.set("", "command", "testFlow -quiet");
    record.write();
    if (c.isRoot()) {
        EXPECT_EQ(nlohmann::json::parse(readFile(file))["status"], "running");
    }
    record.finish(ExitCode::stopped, "the file 'stop' appeared");
    if (!c.isRoot()) return;
    const auto json = nlohmann::json::parse(readFile(file));
    EXPECT_EQ(json["status"], "stopped");
    EXPECT_EQ(json["groups"]["Ca"], 0.02);
    EXPECT_TRUE(json["groups"]["bad"].is_null());
    EXPECT_EQ(json["performance"]["steps"], 7);
    EXPECT_EQ(json["ranks"], c.size());
    EXPECT_FALSE(json["build"]["compiler"].get<std::string>().empty());
    fs::remove_all(folder());
}

TEST(Used, readsBack) {
    const Communicator c;
    Problems problems;
    const Node control = parseDictionary("endStrain: 6\nsize: [1 um, 2 um, 3 um]\n", "control", problems);
    writeUsed(folder() / "used.yaml", {{"system/control.yaml", control}, {"system/observers.yaml", Node{}}}, c);
    if (!c.isRoot()) return;
    const Node used = readDictionary(folder() / "used.yaml", "used.yaml", problems);
    EXPECT_TRUE(problems.empty());
    EXPECT_EQ(emit(*used.find("system/control.yaml")), emit(control));
    EXPECT_TRUE(used.find("system/observers.yaml")->entries.empty());
    fs::remove_all(folder());
}

TEST(Durations, forReaders) {
    EXPECT_EQ(formatDuration(3.21), "3.2 s");
    EXPECT_EQ(formatDuration(250), "4 min 10 s");
    EXPECT_EQ(formatDuration(59.99), "1 min 00 s");
    EXPECT_EQ(formatDuration(7500), "2 h 05 min");
}

}  // namespace
}  // namespace corpuscle
