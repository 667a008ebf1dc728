// Tables of numbers over time: postProcessing/<observer>/<file>.csv. One table holds a whole history, however often the
// run was continued:
//
//     # deformation/rbc.csv of Corpuscle, observer shape: deformation, orientation, tumbling and tank-treading of each
//         cell
//     # time_s: time since the start of the flow [s]
//     # D12_extent: |L - H|/(L + H)
//     time_s,D12_extent
//     0,0.58100000000000002
//
// The head consists of comment lines and one header row of name_unit. The first comment line names the table (it is one
// line in the file), each of the others gives meaning and unit of a column. Rows follow in full double precision
// (%.17g), flushed one by one, so that a running case can be watched.
//
// A run that starts anew writes new tables and removes what earlier runs left (clearTables). A restart removes the rows
// after its start time and an incomplete last row, and continues the same file. Every such change writes a complete new
// file, which then replaces the table by a rename, so that a program killed at any moment leaves a readable table with
// all rows up to the last checkpoint.
#pragma once
#include <mpi.h>

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/appendedFile.hpp"

namespace corpuscle::io {

struct Column {
    std::string name;     // "area"
    std::string unit;     // "m2"; empty: dimensionless
    std::string meaning;  // "of the whole triangles"
    std::string header() const { return unit.empty() ? name : name + "_" + unit; }
    // The unit as people write it: "m^2" for m2, "kg/m^3" for kg_m3, "N m" for Nm; empty: dimensionless.
    std::string unitText() const;
};

struct CsvHead {
    std::string observer, file;  // postProcessing/<observer>/<file>.csv
    std::string writer;          // "observer shape"; its first word is the kind of table that clearTables() looks for
    std::string text;            // one line: what the table holds
    std::vector<Column> columns;
};

class CsvSeries {
  public:
    // Collective in `comm`. restart: time (the first column) up to which earlier rows are kept; none: the table is
    // written anew. Throws Failure(ExitCode::io).
    CsvSeries(MPI_Comm comm, const std::filesystem::path& caseDir, const CsvHead& head,
              std::optional<double> restart = std::nullopt);

    // Rank 0 writes, the others do nothing. Throws Failure(ExitCode::io) on rank 0, std::invalid_argument for a row of
    // the wrong length.
    void row(std::span<const double> values);
    // Removes the rows whose first number, the time, is greater. Throws as row().
    void cutAfter(double time);
    const std::filesystem::path& path() const { return path_; }
    // On rank 0, why the table of an earlier run was kept under another name; empty if it was not.
    const std::string& note() const { return note_; }

  private:
    void resume(double time);

    std::filesystem::path path_;
    std::string head_;  // comments and header row
    std::size_t columns_;
    bool root_ = false;
    AppendedFile file_;
    std::string note_;
};

// Collective. Clears the tables of this kind ("observer") that earlier runs have left anywhere under postProcessing. A
// table is recognised by its first line, which names its own place, so that a copy that somebody has made under another
// name stays. restart: only rows up to this time stay, also in tables of observers that the case no longer has; none:
// the tables are removed, together with those of versions before 2026-11, in folders named by the start time, and with
// folders that are empty afterwards.
void clearTables(MPI_Comm comm, const std::filesystem::path& caseDir, const std::string& kind,
                 std::optional<double> restart = std::nullopt);

struct CsvTable {
    std::vector<std::string> columns;
    std::vector<std::vector<double>> rows;
    // Throws Failure(ExitCode::io) naming the existing columns.
    std::vector<double> column(const std::string& name) const;
};

// Skips lines that start with #, and a last row without its newline, which is still being written. Throws
// Failure(ExitCode::io) with the line when a row has another length than the header or holds what is not a number.
CsvTable readCsv(const std::filesystem::path& path);

// postProcessing/<observer>/<file>.csv. Throws Failure(ExitCode::io), naming the existing tables.
CsvTable readCsvSeries(const std::filesystem::path& caseDir, const std::string& observer, const std::string& file);

}  // namespace corpuscle::io
