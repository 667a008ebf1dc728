// Rows of numbers in time: postProcessing/<observer>/<start time>/<file>.csv
//
// One header row of name_unit (time_s, strain, D12_extent, area_m2), then full double precision (%.17g), flushed with
// every row, so that a running case can be watched. A restart writes into the folder of its own start time and leaves
// the earlier rows alone; readCsvSeries joins the folders. Times in folder names have nine digits.
#pragma once
#include <mpi.h>

#include <filesystem>
#include <fstream>
#include <span>
#include <string>
#include <vector>

namespace corpuscle::io {

struct Column {
    std::string name;  // "area"
    std::string unit;  // "m2"; empty: dimensionless
    std::string header() const { return unit.empty() ? name : name + "_" + unit; }
};

class CsvSeries {
  public:
    // Collective in `comm`. Replaces a file that an earlier run with the same start time left.
    CsvSeries(MPI_Comm comm, const std::filesystem::path& caseDir, const std::string& observer, double startTime,
              const std::string& file, const std::vector<Column>& columns);

    // Rank 0 writes, the others do nothing. Throws Failure(ExitCode::io) on rank 0, std::invalid_argument for a row of
    // the wrong length.
    void row(std::span<const double> values);
    // Takes out the rows whose first number, the time, is greater. Throws as row().
    void cutAfter(double time);
    const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
    std::size_t columns_;
    bool root_ = false;
    std::ofstream file_;
};

struct CsvTable {
    std::vector<std::string> columns;
    std::vector<std::vector<double>> rows;
    // Throws Failure(ExitCode::io) naming the columns there are.
    std::vector<double> column(const std::string& name) const;
};

// Throws Failure(ExitCode::io) with the line when a row has another length than the header or holds no number. A last
// row without its line end (being written) is left out.
CsvTable readCsv(const std::filesystem::path& path);

// All start-time folders in order; the first column is the time, and rows of an earlier run after the next run's start,
// or at or after its first row, are left out. Throws Failure(ExitCode::io) when there is none or the columns differ.
CsvTable readCsvSeries(const std::filesystem::path& caseDir, const std::string& observer, const std::string& file);

}  // namespace corpuscle::io
