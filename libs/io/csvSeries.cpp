#include "io/csvSeries.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "core/atomicFile.hpp"
#include "core/error.hpp"
#include "core/together.hpp"
#include "io/publish.hpp"

namespace corpuscle::io {

CsvSeries::CsvSeries(MPI_Comm comm, const std::filesystem::path& caseDir, const std::string& observer, double startTime,
                     const std::string& file, const std::vector<Column>& columns)
    : path_(caseDir / "postProcessing" / observer / fmt::format("{:.9g}", startTime) / (file + ".csv")),
      columns_(columns.size()) {
    onRoot(comm, [&] {
        root_ = true;
        makeFolder(path_.parent_path());
        file_.open(path_, std::ios::trunc);
        std::string header;
        for (const auto& column : columns) header += (header.empty() ? "" : ",") + column.header();
        file_ << header << '\n' << std::flush;
        if (!file_)
            throw Failure(ExitCode::io,
                          fmt::format("cannot write {}; check permissions and free space", path_.string()));
    });
}

void CsvSeries::row(std::span<const double> values) {
    if (!root_) return;
    if (values.size() != columns_) {
        throw std::invalid_argument(
            fmt::format("{}: a row of {} numbers for {} columns", path_.string(), values.size(), columns_));
    }
    std::string line;
    for (const double value : values) line += fmt::format("{}{:.17g}", line.empty() ? "" : ",", value);
    file_ << line << '\n' << std::flush;
    if (!file_) throw Failure(ExitCode::io, fmt::format("cannot write {}; check free space", path_.string()));
}

void CsvSeries::cutAfter(double time) {
    if (!root_) return;
    std::string kept, line;
    {
        std::ifstream written(path_);
        std::getline(written, line);
        kept = line + '\n';
        while (std::getline(written, line) && std::strtod(line.c_str(), nullptr) <= time) kept += line + '\n';
        if (written.bad() || kept == "\n")
            throw Failure(ExitCode::io,
                          fmt::format("cannot read {}, which this run has written: was it moved?", path_.string()));
    }
    file_.close();
    writeFileAtomically(path_, kept);
    file_.open(path_, std::ios::app);
    if (!file_) throw Failure(ExitCode::io, fmt::format("cannot write {}; check permissions", path_.string()));
}

std::vector<double> CsvTable::column(const std::string& name) const {
    const auto found = std::find(columns.begin(), columns.end(), name);
    if (found == columns.end()) {
        throw Failure(ExitCode::io, fmt::format("there is no column '{}'; there are: {}.{}", name, joinWords(columns),
                                                didYouMean(name, columns)));
    }
    const auto index = static_cast<std::size_t>(found - columns.begin());
    std::vector<double> values;
    for (const auto& row : rows) values.push_back(row[index]);
    return values;
}

CsvTable readCsv(const std::filesystem::path& path) {
    std::ifstream file(path);
    std::string line;
    if (!file || !std::getline(file, line))
        throw Failure(ExitCode::io, fmt::format("{}: the file is missing or empty", path.string()));
    CsvTable table;
    std::string word;
    for (std::istringstream header(line); std::getline(header, word, ',');) table.columns.push_back(word);
    for (int number = 2; std::getline(file, line) && !file.eof(); ++number) {
        std::vector<double> row;
        for (std::istringstream words(line); std::getline(words, word, ',');) {
            char* end = nullptr;
            row.push_back(std::strtod(word.c_str(), &end));
            if (word.empty() || *end)
                throw Failure(ExitCode::io, fmt::format("{}:{}: '{}' is no number", path.string(), number, word));
        }
        if (row.size() != table.columns.size()) {
            throw Failure(ExitCode::io, fmt::format("{}:{}: {} numbers for {} columns", path.string(), number,
                                                    row.size(), table.columns.size()));
        }
        table.rows.push_back(std::move(row));
    }
    return table;
}

CsvTable readCsvSeries(const std::filesystem::path& caseDir, const std::string& observer, const std::string& file) {
    const auto folder = caseDir / "postProcessing" / observer;
    std::vector<std::pair<double, std::filesystem::path>> runs;
    std::error_code ignored;
    for (const auto& entry : std::filesystem::directory_iterator(folder, ignored)) {
        const auto path = entry.path() / (file + ".csv");
        if (!std::filesystem::exists(path)) continue;
        const std::string name = entry.path().filename().string();
        char* end = nullptr;
        const double start = std::strtod(name.c_str(), &end);
        if (!*end) runs.emplace_back(start, path);
    }
    if (runs.empty())
        throw Failure(ExitCode::io, fmt::format("{}: no start-time folder holds {}.csv", folder.string(), file));
    std::sort(runs.begin(), runs.end());
    CsvTable all;
    for (const auto& [start, path] : runs) {
        CsvTable run = readCsv(path);
        if (all.columns.empty()) all.columns = run.columns;
        if (run.columns != all.columns)
            throw Failure(ExitCode::io, fmt::format("{}: other columns than in the runs before", path.string()));
        // A restarted run begins after its start, where the earlier one has a row; one that begins there takes its place.
        const double slack = 1e-8 * std::abs(start), last = start + slack;
        const double first = run.rows.empty() ? last : run.rows.front()[0] - slack;
        std::erase_if(all.rows, [&](const auto& row) { return row[0] > last || row[0] >= first; });
        all.rows.insert(all.rows.end(), run.rows.begin(), run.rows.end());
    }
    return all;
}

}  // namespace corpuscle::io
