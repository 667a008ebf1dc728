#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>

#include "core/appendedFile.hpp"
#include "core/atomicFile.hpp"
#include "core/log.hpp"
#include "core/writeFailure.hpp"

namespace corpuscle {
namespace {

namespace fs = std::filesystem;

// Limits the size of files for the duration of a test.
class SizeLimit {
  public:
    explicit SizeLimit(rlim_t bytes) {
        prepareOutput();
        getrlimit(RLIMIT_FSIZE, &before_);
        rlimit small = before_;
        small.rlim_cur = bytes;
        setrlimit(RLIMIT_FSIZE, &small);
    }
    ~SizeLimit() { setrlimit(RLIMIT_FSIZE, &before_); }
    SizeLimit(const SizeLimit&) = delete;
    SizeLimit& operator=(const SizeLimit&) = delete;

  private:
    rlimit before_{};
};

class Writing : public testing::Test {
  protected:
    void SetUp() override {
        fs::remove_all(folder);
        fs::create_directories(folder);
    }
    void TearDown() override { fs::remove_all(folder); }
    fs::path folder =
        fs::temp_directory_path() /
        ("corpuscleWriting." + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
};

template <class Work>
std::string messageOf(Work&& work) {
    try {
        work();
    } catch (const Failure& failure) {
        EXPECT_EQ(failure.code(), ExitCode::io);
        return failure.what();
    }
    return "";
}

TEST_F(Writing, addsWholeRowsOrNone) {
    const fs::path path = folder / "table.csv";
    writeFileAtomically(path, "time_s\n");
    AppendedFile file(path);
    file.add("0\n");
    {
        const SizeLimit limit(14);
        EXPECT_EQ(messageOf([&] { file.add("1.00000000\n"); }),
                  "cannot write " + path.string() +
                      ": File too large; the limit of 14 B (ulimit -f) is reached: raise it ('ulimit -f unlimited')");
    }
    EXPECT_EQ(readFile(path), "time_s\n0\n");
    file.add("1\n");
    EXPECT_EQ(readFile(path), "time_s\n0\n1\n");
}

TEST_F(Writing, ofAFullDiskNamesWhatIsFree) {
    AppendedFile full("/dev/full");
    const std::string text = messageOf([&] { full.add("1\n"); });
    EXPECT_TRUE(text.starts_with("cannot write /dev/full: No space left on device; ")) << text;
    EXPECT_NE(text.find("free on its disk"), std::string::npos) << text;
}

TEST_F(Writing, leavesTheOldFileWhereTheNewOneDoesNotFit) {
    const fs::path path = folder / "run.json";
    writeFileAtomically(path, "old", 1 << 15);
    EXPECT_EQ(fs::file_size(path), 3u);
    const SizeLimit limit(100);
    EXPECT_NE(messageOf([&] { writeFileAtomically(path, std::string(200, 'x')); }).find("File too large"),
              std::string::npos);
    EXPECT_EQ(readFile(path), "old");
    EXPECT_EQ(std::distance(fs::directory_iterator(folder), fs::directory_iterator{}), 1);
    EXPECT_TRUE(overwriteFile(path, "status: failed"));  // in the space that was reserved
    EXPECT_EQ(readFile(path), "status: failed");
    EXPECT_FALSE(overwriteFile(folder / "missing", "x"));
}

TEST_F(Writing, isTriedWithoutATrace) {
    const fs::path path = folder / "file";
    EXPECT_EQ(tryWriting(path), 0);
    EXPECT_FALSE(fs::exists(path));
    writeFileAtomically(path, "content");
    EXPECT_EQ(tryWriting(path), 0);
    EXPECT_EQ(readFile(path), "content");
    EXPECT_EQ(tryWriting(folder / "missing" / "file"), ENOENT);
    EXPECT_EQ(tryWriting(folder / std::string(300, 'x')), ENAMETOOLONG);
    const SizeLimit limit(100);
    EXPECT_EQ(tryWriting(path), EFBIG);
    EXPECT_EQ(readFile(path), "content");
    const SizeLimit wider(1 << 20);
    EXPECT_EQ(tryWriting(path), 0);
    EXPECT_EQ(tryWriting(path, 1 << 20), EFBIG) << "a file written out of order";
    EXPECT_EQ(readFile(path), "content");
}

TEST_F(Writing, namesTheWayOut) {
    const auto text = [](const fs::path& file, int reason) { return std::string(writeFailure(file, reason).what()); };
    EXPECT_NE(text(folder / "a" / "b", EACCES).find("permissions of " + folder.string()), std::string::npos);
    EXPECT_NE(text("/proc/x", EROFS).find("copy the case"), std::string::npos);
    EXPECT_NE(text("x", EDQUOT).find("quota"), std::string::npos);
    EXPECT_NE(text(folder / std::string(300, 'x'), ENAMETOOLONG).find("its last part 300); 4095 and 255 are the most"),
              std::string::npos)
        << text(folder / std::string(300, 'x'), ENAMETOOLONG);
    EXPECT_NE(text("x", 0).find("does not give"), std::string::npos);
}

TEST_F(Writing, ofTheLogFailsWithOneWarning) {
    Log log(true, true);
    log.open(folder / "log.sample");
    {
        const SizeLimit limit(20);
        for (int i = 0; i < 5; ++i) log.info("a line of the log");
    }
    ASSERT_EQ(log.warnings().size(), 1u);
    EXPECT_NE(log.warnings()[0].find("File too large"), std::string::npos);
    EXPECT_NE(log.warnings()[0].find("terminal only"), std::string::npos);
}

}  // namespace
}  // namespace corpuscle
