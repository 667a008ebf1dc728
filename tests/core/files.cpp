#include <gtest/gtest.h>

#include <filesystem>

#include "core/atomicFile.hpp"
#include "core/error.hpp"
#include "core/log.hpp"

namespace corpuscle {
namespace {

namespace fs = std::filesystem;

class Files : public testing::Test {
  protected:
    void SetUp() override {
        const auto* test = testing::UnitTest::GetInstance()->current_test_info();
        folder = fs::temp_directory_path() / ("corpuscleFiles." + std::string(test->name()));
        fs::remove_all(folder);
    }
    void TearDown() override { fs::remove_all(folder); }
    fs::path folder;
};

TEST_F(Files, areReplacedAsAWhole) {
    writeFileAtomically(folder / "a/b.txt", "one");
    writeFileAtomically(folder / "a/b.txt", "two\n");
    EXPECT_EQ(readFile(folder / "a/b.txt"), "two\n");
    EXPECT_EQ(std::distance(fs::directory_iterator(folder / "a"), fs::directory_iterator{}),
              1);  // no temporary file is left
}

TEST_F(Files, failuresNameThePathAndTheReason) {
    writeFileAtomically(folder / "file", "");
    EXPECT_EQ(readFile(folder / "file"), "");
    const auto message = [](auto action) {
        try {
            action();
        } catch (const Failure& f) {
            EXPECT_EQ(f.code(), ExitCode::io);
            return std::string(f.what());
        }
        return std::string();
    };
    EXPECT_NE(message([&] { writeFileAtomically(folder / "file/below", "x"); }).find("file/below: Not a directory"),
              std::string::npos);
    fs::create_directories(folder / "taken/x");
    EXPECT_NE(message([&] { writeFileAtomically(folder / "taken", "x"); }).find("taken: Is a directory"),
              std::string::npos);
    EXPECT_NE(message([&] { readFile(folder / "none"); }).find("none: No such file"), std::string::npos);
}

TEST_F(Files, logKeepsWhatWasSaidBeforeItWasOpened) {
    fs::create_directories(folder);
    testing::internal::CaptureStdout();
    testing::internal::CaptureStderr();
    Log log(true, true);
    log.info("early {}", 1);
    log.open(folder / "log.x");
    log.warning("late {}", 2);
    log.table({"limit", "dt"}, {{"sound", "1.5 ns"}, {"viscous", "10 ns"}});
    EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "warning: late 2\n");
    EXPECT_EQ(readFile(folder / "log.x"),
              "early 1\nwarning: late 2\n"
              "limit        dt\n"
              "sound    1.5 ns\n"
              "viscous   10 ns\n");
    EXPECT_EQ(log.warnings().size(), 1u);
}

}  // namespace
}  // namespace corpuscle
