// Checkpoints: on the same number of ranks every rank reads back its own bits, on another number evenly sized slabs; no
// changed byte goes unnoticed.
#include <gtest/gtest.h>
#include <mpi.h>

#include <cmath>
#include <fstream>
#include <limits>

#include "core/error.hpp"
#include "io/checkpointFile.hpp"
#include "io/checksum.hpp"
#include "io/memoryCheckpoint.hpp"
#include "io/temporaryFolder.hpp"

namespace corpuscle::io {
namespace {

int rankOf(MPI_Comm comm) {
    int rank = 0;
    MPI_Comm_rank(comm, &rank);
    return rank;
}
int sizeOf(MPI_Comm comm) {
    int size = 1;
    MPI_Comm_size(comm, &size);
    return size;
}

// Uneven slabs: rank r has 100 (r mod 3) + 10 r rows, so rank 0 has none.
std::vector<double> velocities(int rank) {
    std::vector<double> values;
    for (int i = 0; i < 3 * (100 * (rank % 3) + 10 * rank); ++i) values.push_back(std::sin(1.0 + i + 1000.0 * rank));
    return values;
}
std::vector<std::int64_t> identities(int rank) {
    std::vector<std::int64_t> values;
    for (int i = 0; i < 7 + rank; ++i) values.push_back((std::int64_t{1} << 55) * rank - i);
    return values;
}
const std::vector<double> limits{0.1, -0.0, std::numeric_limits<double>::infinity(), 5e-324};

void write(MPI_Comm comm, const std::filesystem::path& path, double time) {
    CheckpointWriter writer(comm, path);
    writer.attribute("time", time);
    writer.attribute("step", std::int64_t{42});
    writer.attribute("application", std::string("dmpFlow"));
    writer.writeDistributed("fluid/velocity", velocities(rankOf(comm)), 3);
    writer.writeDistributed("fluid/id", identities(rankOf(comm)));
    writer.writeDistributed("empty", std::span<const double>(), 3);
    writer.writeReplicated("limits", limits);
    writer.finish();
}

void flipBit(const std::filesystem::path& path, std::size_t byte) {
    std::fstream file(path, std::ios::binary | std::ios::in | std::ios::out);
    file.seekg(static_cast<std::streamoff>(byte));
    const char old = static_cast<char>(file.get());
    file.seekp(static_cast<std::streamoff>(byte));
    file.put(static_cast<char>(old ^ 0x10));
}

// The position in the file of this number.
std::size_t placeOf(const std::filesystem::path& path, double value) {
    std::ifstream file(path, std::ios::binary);
    const std::string bytes((std::istreambuf_iterator<char>(file)), {});
    return bytes.find(std::string(reinterpret_cast<const char*>(&value), sizeof value));
}

TEST(Checkpoint, SameRanksGetTheirOwnSlabs) {
    TemporaryFolder folder;
    const auto path = nextCheckpoint(MPI_COMM_WORLD, folder.path());
    EXPECT_EQ(path.filename(), "000000.h5");
    write(MPI_COMM_WORLD, path, 0.125);
    CheckpointReader reader(MPI_COMM_WORLD, path);
    EXPECT_TRUE(reader.sameRanks());
    EXPECT_EQ(reader.readDistributed<double>("fluid/velocity", 3), velocities(rankOf(MPI_COMM_WORLD)));
    EXPECT_EQ(reader.readDistributed<std::int64_t>("fluid/id"), identities(rankOf(MPI_COMM_WORLD)));
    EXPECT_TRUE(reader.readDistributed<double>("empty", 3).empty());
    const auto back = reader.readReplicated<double>("limits");
    EXPECT_EQ(back, limits);
    EXPECT_TRUE(std::signbit(back[1]));
    EXPECT_EQ(reader.attribute<double>("time"), 0.125);
    EXPECT_EQ(reader.attribute<std::int64_t>("step"), 42);
    EXPECT_EQ(reader.attribute<std::string>("application"), "dmpFlow");
    EXPECT_TRUE(reader.has("limits"));
    EXPECT_FALSE(reader.has("limit"));
    EXPECT_EQ(nextCheckpoint(MPI_COMM_WORLD, folder.path()).filename(), "000001.h5");
}

TEST(Checkpoint, OtherRanksGetEvenSlabs) {
    TemporaryFolder folder;
    const auto path = folder.path() / "checkpoints" / "000000.h5";
    write(MPI_COMM_WORLD, path, 0);
    std::vector<double> all;
    for (int r = 0; r < sizeOf(MPI_COMM_WORLD); ++r) {
        const auto part = velocities(r);
        all.insert(all.end(), part.begin(), part.end());
    }
    CheckpointReader alone(MPI_COMM_SELF, path);
    EXPECT_EQ(alone.sameRanks(), sizeOf(MPI_COMM_WORLD) == 1);
    EXPECT_EQ(alone.readDistributed<double>("fluid/velocity", 3), all);
    MPI_Barrier(MPI_COMM_WORLD);

    // Written by one rank and read by all.
    const auto serial = folder.path() / "checkpoints" / "000001.h5";
    if (rankOf(MPI_COMM_WORLD) == 0) {
        CheckpointWriter writer(MPI_COMM_SELF, serial);
        std::vector<double> counting(1001);
        for (std::size_t i = 0; i < counting.size(); ++i) counting[i] = static_cast<double>(i);
        writer.writeDistributed("counting", counting);
        writer.finish();
    }
    MPI_Barrier(MPI_COMM_WORLD);
    CheckpointReader reader(MPI_COMM_WORLD, serial);
    const auto mine = reader.readDistributed<double>("counting");
    EXPECT_NEAR(static_cast<double>(mine.size()), 1001.0 / sizeOf(MPI_COMM_WORLD), 1);
    double sum = 0;
    for (const double value : mine) sum += value;
    MPI_Allreduce(MPI_IN_PLACE, &sum, 1, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
    EXPECT_EQ(sum, 1001.0 * 1000.0 / 2);
}

TEST(Checkpoint, SaysWhatIsMissingOrOtherwise) {
    TemporaryFolder folder;
    const auto path = folder.path() / "checkpoints" / "000000.h5";
    EXPECT_NE(messageOf<Failure>([&] { CheckpointReader(MPI_COMM_WORLD, path); }).find("no such checkpoint"),
              std::string::npos);
    write(MPI_COMM_WORLD, path, 0);
    CheckpointReader reader(MPI_COMM_WORLD, path);
    const std::string missing = messageOf<Failure>([&] { reader.readDistributed<double>("fluid/velocty", 3); });
    EXPECT_NE(missing.find("000000.h5: dataset 'fluid/velocty' is missing"), std::string::npos) << missing;
    EXPECT_NE(missing.find("Did you mean 'fluid/velocity'?"), std::string::npos) << missing;
    const std::string type = messageOf<Failure>([&] { reader.readDistributed<std::int64_t>("fluid/velocity", 3); });
    EXPECT_NE(type.find("holds floating-point numbers in rows of 3"), std::string::npos) << type;
    EXPECT_THROW(reader.readDistributed<double>("fluid/velocity", 1), Failure);
    EXPECT_THROW(reader.attribute<double>("tme"), Failure);
}

TEST(Checkpoint, AChangedByteIsFoundAndAnOlderOneNamed) {
    TemporaryFolder folder;
    const auto checkpoints = folder.path() / "checkpoints";
    for (int i = 0; i < 3; ++i) write(MPI_COMM_WORLD, nextCheckpoint(MPI_COMM_WORLD, folder.path()), 0.5 * i);
    if (rankOf(MPI_COMM_WORLD) == 0) {
        flipBit(checkpoints / "000002.h5", placeOf(checkpoints / "000002.h5", limits[0]));
        flipBit(checkpoints / "000001.h5", placeOf(checkpoints / "000001.h5", limits[0]) + 5);
    }
    MPI_Barrier(MPI_COMM_WORLD);
    CheckpointReader reader(MPI_COMM_WORLD, checkpoints / "000002.h5");
    EXPECT_EQ(reader.readDistributed<double>("fluid/velocity", 3), velocities(rankOf(MPI_COMM_WORLD)))
        << "another dataset is untouched";
    const std::string message = messageOf<Failure>([&] { reader.readReplicated<double>("limits"); });
    EXPECT_NE(message.find("000002.h5: dataset 'limits' is corrupt"), std::string::npos) << message;
    EXPECT_NE(message.find("000000.h5: restart with -restart 0."), std::string::npos) << message;

    const CheckpointSearch latest = latestCheckpoint(MPI_COMM_WORLD, folder.path());
    EXPECT_EQ(latest.path, checkpoints / "000000.h5");
    EXPECT_EQ(latest.warnings.size(), 2u);
}

TEST(Checkpoint, NoByteOfTheFileCanChangeUnseen) {
    TemporaryFolder folder;  // each rank has its own file in it
    const auto own = folder.path() / std::to_string(rankOf(MPI_COMM_WORLD)), path = own / "000000.h5";
    std::filesystem::create_directories(own);
    {
        CheckpointWriter writer(MPI_COMM_SELF, path);
        writer.attribute("time", 0.25);
        writer.writeDistributed("x", std::vector{1.0, 2.0, 3.0});
        writer.finish();
    }
    const auto size = std::filesystem::file_size(path);
    int seen = 0;
    for (std::size_t byte = 0; byte < size; ++byte) {
        flipBit(path, byte);
        std::vector<double> values{1, 2, 3};
        double time = 0.25;
        try {
            CheckpointReader reader(MPI_COMM_SELF, path);
            time = reader.attribute<double>("time");
            values = reader.readDistributed<double>("x");
        } catch (const Failure&) {
            ++seen;
        }
        ASSERT_EQ(values, (std::vector<double>{1, 2, 3})) << "byte " << byte;
        ASSERT_EQ(time, 0.25) << "byte " << byte;
        flipBit(path, byte);
    }
    EXPECT_GT(seen, 500) << "of " << size;
    EXPECT_TRUE(checkCheckpoint(path).empty());
}

TEST(Checkpoint, AKilledWriterLeavesTheOldOnes) {
    TemporaryFolder folder;
    const auto checkpoints = folder.path() / "checkpoints";
    write(MPI_COMM_WORLD, nextCheckpoint(MPI_COMM_WORLD, folder.path()), 1);
    {
        CheckpointWriter unfinished(MPI_COMM_WORLD, checkpoints / "000001.h5");
        unfinished.writeReplicated("limits", limits);
    }
    MPI_Barrier(MPI_COMM_WORLD);
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(checkpoints), {}), 1) << "an abandoned file remains";
    MPI_Barrier(MPI_COMM_WORLD);
    if (rankOf(MPI_COMM_WORLD) == 0)
        for (const char* name : {".000001.h5.part", ".000001.h5.part.data.1", ".000001.h5.part.metadata.0"})
            std::ofstream(checkpoints / name) << "killed here";
    MPI_Barrier(MPI_COMM_WORLD);
    const CheckpointSearch latest = latestCheckpoint(MPI_COMM_WORLD, folder.path());
    EXPECT_EQ(latest.path, checkpoints / "000000.h5");
    ASSERT_EQ(latest.warnings.size(), 1u);
    EXPECT_NE(latest.warnings[0].find("incomplete"), std::string::npos);
    EXPECT_EQ(nextCheckpoint(MPI_COMM_WORLD, folder.path()).filename(), "000001.h5");
    keepCheckpoints(MPI_COMM_WORLD, folder.path(), 2);
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(checkpoints), {}), 1) << "files of a killed run remain";
}

TEST(Checkpoint, ListsFindsAndKeepsTheLatest) {
    TemporaryFolder folder;
    EXPECT_TRUE(latestCheckpoint(MPI_COMM_WORLD, folder.path()).path.empty());
    for (int i = 0; i < 4; ++i) {
        write(MPI_COMM_WORLD, nextCheckpoint(MPI_COMM_WORLD, folder.path()), 0.1 * i);
        keepCheckpoints(MPI_COMM_WORLD, folder.path(), 2);
    }
    const auto list = listCheckpoints(folder.path());
    ASSERT_EQ(list.size(), 2u);
    EXPECT_EQ(list[0].number, 2);
    EXPECT_EQ(list[1].time, 0.1 * 3);
    EXPECT_EQ(findCheckpoint(folder.path(), 0.3).path, list[1].path);
    // The latest one before the given time is found; one slightly after it, because the time was rounded, counts as at
    // that time.
    EXPECT_EQ(findCheckpoint(folder.path(), 0.7).path, list[1].path);
    EXPECT_EQ(findCheckpoint(folder.path(), 0.29).path, list[0].path);
    EXPECT_EQ(findCheckpoint(folder.path(), 0.1 * 3 * (1 - 1e-7)).path, list[1].path);
    EXPECT_EQ(findCheckpoint(folder.path(), 0.29998).path, list[1].path);  // rounded as in a table
    EXPECT_EQ(findCheckpoint(folder.path(), 0.2999).path, list[0].path);
    EXPECT_EQ(findCheckpoint(folder.path(), 0.19999).path, list[0].path);
    const std::string message = messageOf<Failure>([&] { findCheckpoint(folder.path(), 0.1); });
    EXPECT_NE(message.find("there are: 200 ms, 300 ms"), std::string::npos) << message;
    MPI_Barrier(MPI_COMM_WORLD);
}

TEST(Checksum, DoesNotDependOnTheCut) {
    const auto all = velocities(2);
    const std::span<const double> whole(all);
    const std::uint64_t sum = checksum(whole, 0);
    EXPECT_EQ(checksum(whole.first(100), 0) + checksum(whole.subspan(100), 100), sum);
    auto swapped = all;
    std::swap(swapped[3], swapped[4]);
    EXPECT_NE(checksum(std::span<const double>(swapped), 0), sum);
}

TEST(MemoryCheckpoint, GivesBackWhatWasPutInLast) {
    MemoryCheckpoint memory;
    for (const int pass : {0, 1}) {  // the second state replaces the first
        const std::vector<double> v = velocities(rankOf(MPI_COMM_WORLD) + pass);
        const std::vector<std::int64_t> id = identities(rankOf(MPI_COMM_WORLD) + pass);
        memory.writeDistributed("particles/u", v);
        memory.writeReplicated("ids", id);
        memory.attribute("time", 0.25 + pass);
        memory.attribute("step", std::int64_t{7} + pass);
        EXPECT_EQ(memory.readDistributed<double>("particles/u"), v);
        EXPECT_EQ(memory.readReplicated<std::int64_t>("ids"), id);
        EXPECT_EQ(memory.attribute<double>("time"), 0.25 + pass);
        EXPECT_EQ(memory.attribute<std::int64_t>("step"), 7 + pass);
    }
    EXPECT_TRUE(memory.has("ids"));
    EXPECT_FALSE(memory.has("time"));  // as for a file, only datasets count
    EXPECT_THROW(memory.readReplicated<double>("none"), std::out_of_range);
    EXPECT_THROW(memory.readReplicated<double>("ids"), std::bad_variant_access);
}

}  // namespace
}  // namespace corpuscle::io
