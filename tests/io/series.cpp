// Time series of results on any number of ranks: pieces, restart, rollback, keeping only the latest.
#include <gtest/gtest.h>
#include <mpi.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkXMLPPolyDataReader.h>

#include <cmath>
#include <fstream>

#include "core/error.hpp"
#include "io/temporaryFolder.hpp"
#include "io/vtkSeries.hpp"

namespace corpuscle::io {
namespace {

int rankHere() {
    int rank = 0;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    return rank;
}
int ranks() {
    int size = 1;
    MPI_Comm_size(MPI_COMM_WORLD, &size);
    return size;
}

// Rank r has r points: rank 0 has none.
PolyData piece(double time) {
    PolyData data;
    for (int i = 0; i < rankHere(); ++i) data.points.emplace_back(rankHere(), i, time);
    data.point.scalars["density"].assign(data.points.size(), 1000 + time);
    data.point.integers["id"].assign(data.points.size(), rankHere());
    return data;
}

std::vector<double> times(const std::filesystem::path& caseDir) {
    MPI_Barrier(MPI_COMM_WORLD);
    std::vector<double> list;
    for (const auto& entry : readPvd(caseDir / "results" / "fluid.pvd")) list.push_back(entry.time);
    MPI_Barrier(MPI_COMM_WORLD);
    return list;
}

TEST(VtkSeries, PiecesOfAllRanksComeBackTogether) {
    TemporaryFolder folder;
    VtkSeries series(MPI_COMM_WORLD, folder.path(), "fluid", 0, 0);
    series.write(0.1, 1.0 / 3.0, piece(0.1));
    MPI_Barrier(MPI_COMM_WORLD);
    const auto entries = readPvd(folder.path() / "results" / "fluid.pvd");
    ASSERT_EQ(entries.size(), 1u);
    EXPECT_EQ(entries[0].time, 0.1);
    EXPECT_EQ(entries[0].file, folder.path() / "results" / "fluid" / "fluid_000000.pvtp");
    const PolyData all = readPvtp(entries[0].file);
    EXPECT_EQ(static_cast<int>(all.points.size()), ranks() * (ranks() - 1) / 2);
    EXPECT_EQ(all.point.scalar("density").size(), all.points.size());
    EXPECT_EQ(all.field.at("TimeValue"), 0.1);
    EXPECT_EQ(all.field.at("strain"), 1.0 / 3.0);
}

TEST(VtkSeries, TheReaderOfParaViewAgrees) {
    TemporaryFolder folder;
    VtkSeries series(MPI_COMM_WORLD, folder.path(), "fluid", 0, 0);
    series.write(0.1, 0.5, piece(0.1));
    MPI_Barrier(MPI_COMM_WORLD);
    vtkNew<vtkXMLPPolyDataReader> reader;
    reader->SetFileName((folder.path() / "results" / "fluid" / "fluid_000000.pvtp").c_str());
    reader->Update();
    vtkPolyData* read = reader->GetOutput();
    const int expected = ranks() * (ranks() - 1) / 2;
    EXPECT_EQ(read->GetNumberOfPoints(), expected);
    EXPECT_EQ(read->GetNumberOfVerts(), expected);
    ASSERT_TRUE(read->GetPointData()->HasArray("density"));
    ASSERT_TRUE(read->GetPointData()->HasArray("id"));
    if (expected > 0) {
        EXPECT_EQ(read->GetPointData()->GetArray("density")->GetComponent(0, 0), 1000.1);
    }
}

// Rank r has r lines, rank 0 none.
TEST(VtkSeries, LinesOfAllRanksComeBackTogether) {
    TemporaryFolder folder;
    PolyData data;
    auto& number = data.cell.integers["hole"];
    for (int i = 0; i < rankHere(); ++i) {
        for (int n = 0; n < 3; ++n) data.points.emplace_back(rankHere(), i, n);
        data.lines.push_back({3 * i, 3 * i + 1, 3 * i + 2});
        number.push_back(10 * rankHere() + i);
    }
    VtkSeries(MPI_COMM_WORLD, folder.path(), "holes", 0, 0).write(0.1, {}, data);
    MPI_Barrier(MPI_COMM_WORLD);
    const PolyData all = readPvtp(readPvd(folder.path() / "results" / "holes.pvd").at(0).file);
    ASSERT_EQ(static_cast<int>(all.lines.size()), ranks() * (ranks() - 1) / 2);
    for (std::size_t k = 0; k < all.lines.size(); ++k)
        for (int n = 0; n < 3; ++n) {
            const Vec3& x = all.points[static_cast<std::size_t>(all.lines[k][static_cast<std::size_t>(n)])];
            EXPECT_EQ(10 * x[0] + x[1], static_cast<double>(all.cell.integer("hole")[k]));
            EXPECT_EQ(x[2], n);
        }
}

TEST(VtkSeries, AStreamThatHasNothingToWriteCanDropToo) {
    TemporaryFolder folder;
    VtkSeries(MPI_COMM_WORLD, folder.path(), "nothing", 0, 0).start();
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "results"));
    VtkSeries series(MPI_COMM_WORLD, folder.path(), "fluid", 0, 0);
    for (int i = 0; i < 3; ++i) series.write(0.1 * i, i, piece(i));
    VtkSeries(MPI_COMM_WORLD, folder.path(), "fluid", 0, 0.1).start();
    EXPECT_EQ(times(folder.path()), (std::vector<double>{0.0}));
}

TEST(VtkSeries, RestartDropsWhatComesAfterIt) {
    TemporaryFolder folder;
    {
        VtkSeries series(MPI_COMM_WORLD, folder.path(), "fluid", 0, 0);
        for (int i = 0; i < 5; ++i) series.write(0.1 * i, i, piece(i));
    }
    VtkSeries again(MPI_COMM_WORLD, folder.path(), "fluid", 0, 0.1 * 3);
    EXPECT_EQ(times(folder.path()).size(), 5u) << "nothing may change before the first write";
    again.write(0.3, 3, piece(3));
    again.write(0.35, 3.5, piece(3.5));
    EXPECT_EQ(times(folder.path()), (std::vector<double>{0.0, 0.1, 0.2, 0.3, 0.35}));
    EXPECT_EQ(readPvd(folder.path() / "results" / "fluid.pvd").back().file.filename(), "fluid_000004.pvtp");
}

TEST(VtkSeries, GoesBackWithinARun) {
    TemporaryFolder folder;
    VtkSeries series(MPI_COMM_WORLD, folder.path(), "fluid", 0, 0);
    series.start();
    series.goBack(0);  // nothing written yet
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "results" / "fluid.pvd"));
    series.write(0, 0, piece(0));
    series.goBack(0);
    EXPECT_EQ(times(folder.path()), std::vector<double>{0.0}) << "the first entry stays";
    for (int i = 1; i < 5; ++i) series.write(0.1 * i, i, piece(i));
    series.goBack(0.1 * 3);
    EXPECT_EQ(times(folder.path()), (std::vector<double>{0.0, 0.1, 0.2, 0.1 * 3})) << "the entry at that time stays";
    series.write(0.35, 3.5, piece(3.5));
    EXPECT_EQ(times(folder.path()), (std::vector<double>{0.0, 0.1, 0.2, 0.1 * 3, 0.35}));
    EXPECT_EQ(readPvd(folder.path() / "results" / "fluid.pvd").back().file.filename(), "fluid_000004.pvtp");
    MPI_Barrier(MPI_COMM_WORLD);
}

TEST(VtkSeries, KeepsTheLatest) {
    TemporaryFolder folder;
    VtkSeries series(MPI_COMM_WORLD, folder.path(), "fluid", 2, 0);
    for (int i = 0; i < 4; ++i) series.write(i, i, piece(i));
    EXPECT_EQ(times(folder.path()), (std::vector<double>{2, 3}));
    int files = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder.path() / "results" / "fluid"))
        files += entry.path().extension() == ".pvtp";
    EXPECT_EQ(files, 2);
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "results" / "fluid" / "fluid_000001"));
}

TEST(VtkSeries, WhatFailsOnOneRankFailsOnAll) {
    TemporaryFolder folder;
    VtkSeries series(MPI_COMM_WORLD, folder.path(), "fluid", 0, 0);
    PolyData data = piece(0);
    if (rankHere() == ranks() - 1) data.point.scalars["density"].push_back(1);
    EXPECT_THROW(series.write(0, 0, data), Failure);
    if (ranks() == 1) return;
    data = piece(0);
    if (rankHere() == ranks() - 1) data.point.scalars["pressure"].assign(data.points.size(), 0);
    const std::string message = messageOf<Failure>([&] { series.write(0, 0, data); });
    EXPECT_NE(message.find("other arrays"), std::string::npos) << message;
}

}  // namespace
}  // namespace corpuscle::io
