// The lock of a case: one program writes at a time, and others are told which; a stale lock file is distinguished from
// one that is held.
#include "core/caseLock.hpp"

#include <gtest/gtest.h>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "../io/temporaryFolder.hpp"
#include "core/atomicFile.hpp"
#include "core/buildInfo.hpp"
#include "core/error.hpp"

namespace corpuscle {
namespace {

class Lock : public testing::Test {
  protected:
    Communicator world{MPI_COMM_WORLD};
    Log log{world.isRoot(), true};
    TemporaryFolder folder;
    std::filesystem::path file = folder.path() / CaseLock::fileName, said = folder.path() / "said";

    void SetUp() override { log.open(said); }
    std::string failure() {
        return messageOf<Failure>([&] { CaseLock(folder.path(), "second", world, log); });
    }
    void leave(const std::string& text) {
        if (world.isRoot()) std::ofstream(file) << text;
        world.barrier();
    }
    void expectNoFile() {  // checked before any rank continues and creates one
        EXPECT_FALSE(std::filesystem::exists(file));
        world.barrier();
    }
    std::string boot() {
        std::string text;
        std::getline(std::ifstream("/proc/sys/kernel/random/boot_id"), text);
        return text;
    }
};

TEST_F(Lock, RefusesASecondProgramAndNamesTheFirst) {
    {
        const CaseLock first(folder.path(), "dmpFlow", world, log);
        for (int attempt = 0; attempt < 3; ++attempt) {
            const std::string text = failure();
            for (const std::string& part :
                 {std::string("dmpFlow, process "), "on host " + machineInfo().host, std::string(", since 20"),
                  file.string(), std::string("Nothing was changed")})
                EXPECT_NE(text.find(part), std::string::npos) << part << " in: " << text;
        }
    }
    world.barrier();
    expectNoFile();
    EXPECT_EQ(failure(), "");
}

TEST_F(Lock, TakesOverWhatIsLeftOver) {
    const std::string host = machineInfo().host, since = "since: 2026-11-25T01:02:03Z\n";
    const std::vector<std::pair<std::string, std::string>> leftOver{
        {"program: dmpFlow\nprocess: 999999\nhost: " + host + "\nboot: " + boot() + "\n" + since, "has ended"},
        // The process number exists but now belongs to another process: the lock is not held.
        {"program: dmpFlow\nprocess: 1\nhost: " + host + "\nboot: " + boot() + "\n" + since, "has ended"},
        {"program: dmpFlow\nprocess: 1\nhost: " + host + "\nboot: another\n" + since, "started again"},
        {"program: dmpFlow\nprocess: 7\nhost: elsewhere\nboot: another\n" + since + "file: 1:2\n", "copied"},
    };
    for (const auto& [text, why] : leftOver) {
        leave(text);
        EXPECT_EQ(failure(), "") << text;
        if (world.isRoot()) {
            EXPECT_NE(readFile(said).find(why), std::string::npos) << why << " in: " << readFile(said);
            EXPECT_NE(readFile(said).find("is stale"), std::string::npos);
        }
        log.open(said);
        world.barrier();
        expectNoFile();
    }
    for (const char* text : {"", "\n\n", "not a lock at all: really\n"}) {  // names no process
        leave(text);
        EXPECT_EQ(failure(), "") << text;
    }
}

TEST_F(Lock, BelievesAnotherHostAndSaysWhatToDo) {
    for (const std::string host : {"node17", "node18.cluster", "laptop"}) {
        const std::string text =
            "program: sphFlow\nprocess: 4711\nhost: " + host + "\nboot: another\nsince: 2026-11-25T01:02:03Z\n";
        leave(text);
        const std::string found = failure();
        for (const std::string& part : {"sphFlow, process 4711 on host " + host + ", since 2026-11-25T01:02:03Z",
                                        "'ssh " + host + " ps -p 4711'", "remove " + file.string()})
            EXPECT_NE(found.find(part), std::string::npos) << part << " in: " << found;
        if (world.isRoot()) {
            EXPECT_EQ(readFile(file), text);
        }
        world.barrier();
    }
}

TEST_F(Lock, NeedsACaseThatCanBeWritten) {
    const std::string text = messageOf<Failure>([&] { CaseLock(folder.path() / "missing", "dmpFlow", world, log); });
    EXPECT_NE(text.find("missing"), std::string::npos) << text;
}

}  // namespace
}  // namespace corpuscle
