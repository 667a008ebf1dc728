// Output of an earlier run that lies after the start of a new one is removed, and nothing else.
#include "io/earlierRun.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "core/communicator.hpp"
#include "core/error.hpp"
#include "io/checkpointFile.hpp"
#include "io/temporaryFolder.hpp"
#include "io/vtkSeries.hpp"

namespace corpuscle::io {
namespace {

class EarlierRun : public testing::Test {
  protected:
    Communicator world{MPI_COMM_WORLD};
    TemporaryFolder folder;
    std::filesystem::path results = folder.path() / "results";

    // A run with five results, every 0.1 s from 0 s, and checkpoints at 0.15 and 0.35 s.
    void SetUp() override {
        for (const char* stream : {"fluid", "rbc", "oldCell"}) {
            VtkSeries series(MPI_COMM_WORLD, folder.path(), stream, 0, 0);
            PolyData piece;
            piece.points.emplace_back(0, 0, world.rank());
            for (int k = 0; k < 5; ++k) series.write(0.1 * k, std::nullopt, piece);
        }
        for (const double time : {0.15, 0.35}) {
            CheckpointWriter file(MPI_COMM_WORLD, nextCheckpoint(MPI_COMM_WORLD, folder.path()));
            file.attribute("time", time);
            file.finish();
        }
        if (world.isRoot()) {
            std::ofstream(results / "notes.txt") << "mine";
            std::ofstream(results / "mine.pvd") << "<VTKFile type=\"Collection\"><Collection><DataSet timestep=\"0\" "
                                                   "file=\"../elsewhere/a.vtp\"/></Collection></VTKFile>";
            // Left by a write that was killed: no index names it.
            std::filesystem::create_directories(results / "rbc" / "rbc_000005");
            for (const auto& name : unfinished()) std::ofstream(folder.path() / name) << "half";
            for (const char* name : {"rbc/my_rbc_000009.pvtp", "rbc/my_rbc_000009.pvtp.4711.tmp", "../mine.4711.tmp",
                                     "../run.json.old.tmp"})
                std::ofstream(results / name) << "mine";
        }
        world.barrier();
    }
    static std::vector<std::string> unfinished() {
        return {"run.json.4711.tmp", "used.yaml.4711.tmp", "results/rbc.pvd.4711.tmp",
                "results/rbc/rbc_000003.pvtp.4711.tmp"};
    }
    std::size_t times(const std::string& stream) {
        world.barrier();
        const auto index = results / (stream + ".pvd");
        const std::size_t count = std::filesystem::exists(index) ? readPvd(index).size() : 0;
        std::size_t files = 0;
        std::error_code ignored;
        for (const auto& entry : std::filesystem::directory_iterator(results / stream, ignored))
            if (entry.path().filename().string().starts_with(stream + "_"))
                files += entry.path().extension() == ".pvtp" ? 1 : 0;
        EXPECT_EQ(files, count) << stream;
        return count;
    }
    std::size_t checkpoints() {
        world.barrier();
        return listCheckpoints(folder.path()).size();
    }
    void expectForeignFilesKept() {
        for (const char* file : {"notes.txt", "mine.pvd", "rbc/my_rbc_000009.pvtp", "rbc/my_rbc_000009.pvtp.4711.tmp",
                                 "../mine.4711.tmp", "../run.json.old.tmp"})
            EXPECT_TRUE(std::filesystem::exists(results / file)) << file;
        for (const auto& name : unfinished()) EXPECT_FALSE(std::filesystem::exists(folder.path() / name)) << name;
    }
};

TEST_F(EarlierRun, AStartAnewLeavesNothingOfIt) {
    const ClearedOutput cleared = clearAfter(MPI_COMM_WORLD, folder.path(), std::nullopt);
    for (const char* stream : {"fluid", "rbc", "oldCell"}) {
        EXPECT_EQ(times(stream), 0u) << stream;
        EXPECT_FALSE(std::filesystem::exists(results / (std::string(stream) + ".pvd")));
    }
    EXPECT_FALSE(std::filesystem::exists(results / "rbc" / "rbc_000005"));
    EXPECT_EQ(checkpoints(), 0u);
    expectForeignFilesKept();
    if (world.isRoot()) {
        EXPECT_EQ(cleared.text(), "15 times of fluid, oldCell, rbc in results/ and 2 checkpoints");
    }
}

TEST_F(EarlierRun, ARestartLeavesWhatCameBeforeAndTheEntryAtItsTime) {
    struct Expected {
        double start;
        std::size_t times, checkpoints;
    };
    // The order matters: each start is earlier than the one before. 0.2 s is stored in the results as 0.1*2, equal up
    // to rounding.
    for (const auto& [start, kept, left] :
         {Expected{0.35, 4, 2}, Expected{0.2 * (1 + 1e-15), 3, 1}, Expected{0.15, 2, 1}, Expected{0.05, 1, 0}}) {
        const ClearedOutput cleared = clearAfter(MPI_COMM_WORLD, folder.path(), start);
        for (const char* stream : {"fluid", "rbc", "oldCell"}) EXPECT_EQ(times(stream), kept) << stream << start;
        EXPECT_EQ(checkpoints(), left) << start;
        EXPECT_TRUE(clearAfter(MPI_COMM_WORLD, folder.path(), start).empty());
        if (world.isRoot()) {
            EXPECT_FALSE(cleared.empty()) << start;
        }
    }
    EXPECT_FALSE(std::filesystem::exists(results / "rbc" / "rbc_000005"));
    expectForeignFilesKept();
}

TEST_F(EarlierRun, ADamagedIndexIsNamedAtARestartAndGoesAtAStartAnew) {
    world.barrier();
    if (world.isRoot()) std::ofstream(results / "fluid.pvd") << "<VTKFile><Coll";
    world.barrier();
    EXPECT_NE(messageOf<Failure>([&] { clearAfter(MPI_COMM_WORLD, folder.path(), 0.1); }).find("fluid.pvd"),
              std::string::npos);
    clearAfter(MPI_COMM_WORLD, folder.path(), std::nullopt);
    EXPECT_EQ(times("fluid"), 0u);
}

TEST_F(EarlierRun, ACaseWithoutOutputHasNothingToClear) {
    const TemporaryFolder empty;
    for (const std::optional<double> start :
         {std::optional<double>(), std::optional<double>(0.0), std::optional<double>(1.0)})
        EXPECT_TRUE(clearAfter(MPI_COMM_WORLD, empty.path(), start).empty());
}

}  // namespace
}  // namespace corpuscle::io
