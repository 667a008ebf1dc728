// Series in time from the table of an observer, between two moments of a run.
//
// A table with a row for each cell gives the mean over the cells at each time. A table with a row for each place (the
// observer `profile`) gives a series for each place.
#pragma once
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "io/csvSeries.hpp"

namespace corpuscle::study {

// A moment of a run, as a value of the column in which it is given.
struct Moment {
    std::string column;  // "strain" or "time_s"
    double value;        // SI

    // Reads "5 strain", "0.2 s". Throws std::invalid_argument.
    static Moment parse(const std::string& text);
};

struct TableSelection {
    // By place and column. A table without places has the place 0, and its cells are averaged.
    std::map<double, std::map<std::string, std::vector<double>>> series;
    std::vector<std::string> columns;
    std::string along;            // "strain" or "time_s": the column in which the range was given, else the strain
    std::vector<double> moments;  // in this column, one for each value of a series
    std::string key;              // column by which rows of one time differ: "cell", a place; empty: one row per time

    const char* alongWord() const { return along == "strain" ? "strain" : "time"; }
    bool isByPlace() const { return !key.empty() && key != "cell"; }
};

// name: OBSERVER/FILE, for messages. columns: those that are wanted; empty: all. Without `from`, the selection begins
// in the middle of the run, or at its beginning if `wholeRun`. Throws Failure, which names what the table has.
TableSelection selectFrom(const io::CsvTable& table, const std::string& name, const std::optional<Moment>& from,
                          const std::optional<Moment>& to, const std::vector<std::string>& columns,
                          bool wholeRun = false);

// Blocks for standard errors have equal lengths in time; therefore this throws Failure where moments are not evenly
// spaced. A last moment that does not fit is that of the end of the run and is removed. Returns the interval, 0 for one
// moment.
double requireEvenSpacing(TableSelection& selection, const std::string& name);

// postProcessing/OBSERVER/FILE.csv of a case, from "OBSERVER/FILE". Throws Failure.
io::CsvTable readTable(const std::filesystem::path& caseDir, const std::string& name);

}  // namespace corpuscle::study
