#include "core/machineMemory.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cmath>
#include <fstream>
#include <string>

#include "core/atomicFile.hpp"

namespace corpuscle {
namespace {

namespace fs = std::filesystem;

constexpr double MiB = 1024 * 1024;

class Machine : public testing::Test {
  protected:
    void SetUp() override {
        fs::remove_all(folder);
        put("proc/meminfo", "MemTotal:       1000000 kB\nMemFree: 10 kB\nMemAvailable:   512000 kB\n");
    }
    void TearDown() override { fs::remove_all(folder); }
    void put(const std::string& file, const std::string& text) const { writeFileAtomically(folder / file, text); }
    MemoryLimit shared() const { return availableMemory(folder / "proc", folder / "cgroup").shared; }
    bool isOfGroup() const { return shared().name.find("control group") != std::string::npos; }

    fs::path folder = fs::temp_directory_path() /
                      ("corpuscleMemory." + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
};

TEST_F(Machine, hasWhatTheKernelCallsAvailable) {
    EXPECT_EQ(shared().bytes, 500 * MiB);
    EXPECT_EQ(shared().name, "the free memory of the machine");
}

TEST_F(Machine, isLimitedByAControlGroupAndThoseAboveIt) {
    put("proc/self/cgroup", "0::/batch/job/step\n");
    put("cgroup/batch/job/step/memory.max", "max\n");
    put("cgroup/batch/job/step/memory.current", std::to_string(static_cast<long>(20 * MiB)));
    put("cgroup/batch/job/memory.max", std::to_string(static_cast<long>(100 * MiB)));
    put("cgroup/batch/job/memory.current", std::to_string(static_cast<long>(40 * MiB)));
    put("cgroup/batch/job/memory.stat", "anon 1\ninactive_file " + std::to_string(static_cast<long>(10 * MiB)) + "\n");
    EXPECT_EQ(shared().bytes, 70 * MiB);  // the file cache is released when memory is needed
    EXPECT_TRUE(isOfGroup());
}

TEST_F(Machine, knowsTheFirstVersionOfControlGroups) {
    put("proc/self/cgroup", "5:cpuset:/\n4:cpu,memory:/job\n0::/\n");
    put("cgroup/memory/job/memory.limit_in_bytes", std::to_string(static_cast<long>(64 * MiB)));
    put("cgroup/memory/job/memory.usage_in_bytes", std::to_string(static_cast<long>(80 * MiB)));
    EXPECT_EQ(shared().bytes, 0);
    EXPECT_TRUE(isOfGroup());
}

TEST_F(Machine, takesGroupsThatItCannotSeeForUnlimited) {
    put("proc/self/cgroup", "not a line\n0::/elsewhere\n");
    EXPECT_EQ(shared().bytes, 500 * MiB);
}

TEST(Memory, isLimitedForTheProcess) {
    // Beyond what the process has already: under AddressSanitizer that is many TiB of shadow memory.
    rlim_t used = 0;
    std::ifstream status("/proc/self/status");
    for (std::string line; std::getline(status, line);)
        if (line.starts_with("VmData:")) used = std::stoull(line.substr(7)) * 1024;
    ASSERT_GT(used, 0);
    rlimit before{};
    getrlimit(RLIMIT_DATA, &before);
    rlimit small = before;
    small.rlim_cur = used + (rlim_t{1} << 40) - (rlim_t{1} << 30);
    setrlimit(RLIMIT_DATA, &small);
    const MemoryLimit own = availableMemory().own;
    setrlimit(RLIMIT_DATA, &before);
    EXPECT_LT(own.bytes, std::ldexp(1.0, 40));
    EXPECT_GT(own.bytes, std::ldexp(1.0, 39));
    EXPECT_NE(own.name.find("ulimit -d"), std::string::npos);
}

TEST(Memory, isWrittenShort) {
    EXPECT_EQ(formatBytes(12), "12 B");
    EXPECT_EQ(formatBytes(3.25 * MiB), "3.2 MiB");
    EXPECT_EQ(formatBytes(126 * 1024 * MiB), "126 GiB");
}

}  // namespace
}  // namespace corpuscle
