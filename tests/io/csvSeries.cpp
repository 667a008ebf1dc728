// Tables of time series: headers, restarts, rollbacks, leftovers of earlier runs and of killed programs.
#include "io/csvSeries.hpp"

#include <gtest/gtest.h>
#include <mpi.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "core/atomicFile.hpp"
#include "core/error.hpp"
#include "io/temporaryFolder.hpp"

namespace corpuscle::io {
namespace {

namespace fs = std::filesystem;

int rankHere() {
    int rank = 0;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    return rank;
}

CsvHead leak() {
    return {"leak",
            "count",
            "observer leakage",
            "particles that have leaked",
            {{"time", "s", "time of the flow"}, {"count", "", "particles on the wrong side"}}};
}

// Writes times 0, 1 ..., as a run does from `restart` on.
void run(const fs::path& caseDir, std::optional<double> restart, int rows, double value, const CsvHead& head = leak()) {
    clearTables(MPI_COMM_WORLD, caseDir, "observer", restart);
    CsvSeries csv(MPI_COMM_WORLD, caseDir, head, restart);
    const double start = restart.value_or(-1);
    for (int i = 1; i <= rows; ++i) csv.row(std::vector{start + i, value});
    MPI_Barrier(MPI_COMM_WORLD);
}

std::vector<double> counts(const fs::path& caseDir) {
    MPI_Barrier(MPI_COMM_WORLD);
    auto column = readCsvSeries(caseDir, "leak", "count").column("count");
    MPI_Barrier(MPI_COMM_WORLD);
    return column;
}

// Rank 0 writes; all ranks wait for it.
void put(const fs::path& path, const std::string& text) {
    if (rankHere() == 0) {
        fs::create_directories(path.parent_path());
        std::ofstream(path) << text;
    }
    MPI_Barrier(MPI_COMM_WORLD);
}

std::string text(const fs::path& path) { return readFile(path); }

TEST(CsvSeries, EveryBitOfEveryRow) {
    TemporaryFolder folder;
    const CsvHead head{
        "deformation",
        "rbc",
        "observer shape",
        "deformation of each cell",
        {{"time", "s", "time"}, {"D12_extent", "", "|L - H|/(L + H)"}, {"area", "m2", "of the surface"}}};
    CsvSeries csv(MPI_COMM_WORLD, folder.path(), head);
    csv.row(std::vector{0.1, 1.0 / 3.0, 1.35e-10});
    csv.row(std::vector{0.2, std::nan(""), 1e-300});
    MPI_Barrier(MPI_COMM_WORLD);
    const std::string written = text(folder.path() / "postProcessing/deformation/rbc.csv");
    EXPECT_TRUE(
        written.starts_with("# deformation/rbc.csv of Corpuscle, observer shape: deformation of each cell\n"
                            "# time_s: time [s]\n"
                            "# D12_extent: |L - H|/(L + H)\n"
                            "# area_m2: of the surface [m^2]\n"
                            "time_s,D12_extent,area_m2\n0.1"))
        << written;
    const CsvTable table = readCsv(csv.path());
    ASSERT_EQ(table.rows.size(), 2u) << "rows must be in the file at once";
    EXPECT_EQ(table.column("D12_extent")[0], 1.0 / 3.0);
    EXPECT_TRUE(std::isnan(table.column("D12_extent")[1]));
    EXPECT_EQ(table.column("area_m2")[1], 1e-300);
    EXPECT_NE(messageOf<Failure>([&] { table.column("D12_extend"); }).find("Did you mean 'D12_extent'"),
              std::string::npos);
    if (rankHere() == 0) {
        EXPECT_THROW(csv.row(std::vector{1.0}), std::invalid_argument);
    }
}

TEST(CsvSeries, UnitsAsPeopleWriteThem) {
    const auto shown = [](const char* unit) { return Column{"x", unit, ""}.unitText(); };
    EXPECT_EQ(shown("m_s"), "m/s");
    EXPECT_EQ(shown("kg_m3"), "kg/m^3");
    EXPECT_EQ(shown("1_s"), "1/s");
    EXPECT_EQ(shown("Nm"), "N m");
    EXPECT_EQ(shown("m2"), "m^2");
    EXPECT_EQ(shown("percent"), "%");
    EXPECT_EQ(shown(""), "");
}

TEST(CsvSeries, CutsWhatComesAfterATime) {
    TemporaryFolder folder;
    CsvSeries csv(MPI_COMM_WORLD, folder.path(), leak());
    csv.cutAfter(0);  // no row yet
    for (int i = 0; i < 4; ++i) csv.row(std::vector{0.1 * i, 1.0 * i});
    csv.cutAfter(0.1);
    csv.row(std::vector{0.15, 9.0});
    EXPECT_EQ(counts(folder.path()), (std::vector<double>{0, 1, 9}));
    EXPECT_TRUE(text(csv.path()).starts_with("# leak/count.csv")) << "a rollback keeps the head";
    MPI_Barrier(MPI_COMM_WORLD);
}

TEST(CsvSeries, OneCurveHoweverOftenTheRunWasContinued) {
    TemporaryFolder folder;
    run(folder.path(), {}, 4, 1);
    run(folder.path(), 1, 3, 2);
    run(folder.path(), 3, 2, 3);
    EXPECT_EQ(counts(folder.path()), (std::vector<double>{1, 1, 2, 2, 3, 3}));
    run(folder.path(), {}, 2, 7);
    EXPECT_EQ(counts(folder.path()), (std::vector<double>{7, 7})) << "a run from the first time begins anew";
}

TEST(CsvSeries, WhatAKilledProgramLeavesIsCutAtTheRestart) {
    const std::string lastRow = "3.000000000000";
    for (const std::string& tail :
         std::vector<std::string>{lastRow, std::string("0."), lastRow + "1,", std::string(1, '\0')}) {
        TemporaryFolder folder;
        run(folder.path(), {}, 3, 1);
        const fs::path path = folder.path() / "postProcessing/leak/count.csv";
        put(path, text(path) + tail);
        put(path.string() + ".4711.tmp", "half a table");
        EXPECT_EQ(counts(folder.path()).size(), 3u) << "a row that is being written is not read";
        run(folder.path(), 2, 1, 2);
        EXPECT_EQ(counts(folder.path()), (std::vector<double>{1, 1, 1, 2}));
        EXPECT_FALSE(fs::exists(path.string() + ".4711.tmp"));
        MPI_Barrier(MPI_COMM_WORLD);
    }
}

TEST(CsvSeries, RestartWithOtherColumnsKeepsTheOldTable) {
    TemporaryFolder folder;
    run(folder.path(), {}, 3, 1);
    CsvHead wider = leak();
    wider.columns.push_back({"share", "", "of all particles"});
    for (int time = 0; time < 2; ++time) {
        CsvSeries csv(MPI_COMM_WORLD, folder.path(), time == 0 ? wider : leak(), 1);
        if (rankHere() == 0) {
            EXPECT_NE(csv.note().find(time == 0 ? "it now has the columns share" : "it no longer has share"),
                      std::string::npos)
                << csv.note();
        }
        MPI_Barrier(MPI_COMM_WORLD);
    }
    EXPECT_TRUE(counts(folder.path()).empty());
    EXPECT_NE(text(folder.path() / "postProcessing/leak/count.csv.until_1").find("\n2,"), std::string::npos)
        << "all rows are kept";
    EXPECT_TRUE(fs::exists(folder.path() / "postProcessing/leak/count.csv.until_1_2"));
    MPI_Barrier(MPI_COMM_WORLD);
}

TEST(CsvSeries, ADamagedTableIsKeptAndItsGoodRowsGoOn) {
    for (const std::string& damage : std::vector<std::string>{"0.05,abc\n", "0.05\n", "0.05,1,2\n", "\n"}) {
        TemporaryFolder folder;
        run(folder.path(), {}, 3, 1);
        const fs::path path = folder.path() / "postProcessing/leak/count.csv";
        put(path, text(path) + damage);
        EXPECT_NE(messageOf<Failure>([&] { readCsv(path); }).find("count.csv:8: "), std::string::npos);
        MPI_Barrier(MPI_COMM_WORLD);
        CsvSeries csv(MPI_COMM_WORLD, folder.path(), leak(), 2);
        if (rankHere() == 0) {
            EXPECT_NE(csv.note().find("count.csv:8 is no row"), std::string::npos) << csv.note();
        }
        EXPECT_EQ(counts(folder.path()), (std::vector<double>{1, 1, 1}));
        EXPECT_TRUE(text(path.string() + ".until_2").ends_with(damage));
        MPI_Barrier(MPI_COMM_WORLD);
    }
}

// Tables of earlier runs are removed; all other files stay.
TEST(CsvSeries, AStartAfreshClearsTablesAndNothingElse) {
    TemporaryFolder folder;
    const fs::path all = folder.path() / "postProcessing";
    const std::string old = "time_s,strain,D12_extent\n0,0,0.58\n";
    run(folder.path(), {}, 3, 1);
    CsvHead other = leak();
    other.observer = "gone";  // an observer that the case no longer has
    CsvSeries(MPI_COMM_WORLD, folder.path(), other);
    CsvHead relax = leak();
    relax.observer = "relax", relax.writer = "protocol tweezers";
    CsvSeries(MPI_COMM_WORLD, folder.path(), relax);
    put(all / "leak/0/count.csv", old);
    put(all / "leak/0.000488/count.csv", old);
    put(all / "gone/0/count.csv", old);
    put(all / "leak/0.1/notes.txt", "mine");
    put(all / "leak/7/mine.csv", "a,b\n1,2\n");
    put(all / "leak/mine.csv", "time_s,count\n0,1\n");
    put(all / "leak/count_copy.csv", text(all / "leak/count.csv"));
    put(all / "cell.png", "a picture");
    clearTables(MPI_COMM_WORLD, folder.path(), "observer");
    std::vector<std::string> left;
    for (const auto& entry : fs::recursive_directory_iterator(all))
        if (entry.is_regular_file()) left.push_back(fs::relative(entry.path(), all).string());
    std::sort(left.begin(), left.end());
    EXPECT_EQ(left, (std::vector<std::string>{"cell.png", "leak/0.1/notes.txt", "leak/7/mine.csv",
                                              "leak/count_copy.csv", "leak/mine.csv", "relax/count.csv"}));
    EXPECT_FALSE(fs::exists(all / "gone"));
    MPI_Barrier(MPI_COMM_WORLD);
}

// Rows after the time of the restart are removed, also those of observers that this run no longer has.
TEST(CsvSeries, ARestartCutsTheTablesOfObserversThatAreGone) {
    TemporaryFolder folder;
    run(folder.path(), {}, 4, 1);
    clearTables(MPI_COMM_WORLD, folder.path(), "observer", 1);
    EXPECT_EQ(counts(folder.path()).size(), 2u);
}

TEST(CsvSeries, AMissingTableNamesThoseThatAreThere) {
    TemporaryFolder folder;
    run(folder.path(), {}, 1, 1);
    const std::string message = messageOf<Failure>([&] { readCsvSeries(folder.path(), "leak", "counts"); });
    EXPECT_NE(message.find("has count. Did you mean 'count'?"), std::string::npos) << message;
    EXPECT_NE(messageOf<Failure>([&] { readCsvSeries(folder.path(), "leaks", "count"); }).find("no table"),
              std::string::npos);
    MPI_Barrier(MPI_COMM_WORLD);
}

}  // namespace
}  // namespace corpuscle::io
