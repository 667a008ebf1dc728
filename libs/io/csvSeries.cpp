#include "io/csvSeries.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "core/atomicFile.hpp"
#include "core/error.hpp"
#include "core/together.hpp"
#include "io/publish.hpp"

namespace corpuscle::io {

namespace fs = std::filesystem;

namespace {

constexpr const char* signature = " of Corpuscle, ";

std::string firstLine(const CsvHead& head) {
    return fmt::format("# {}/{}.csv{}{}: {}", head.observer, head.file, signature, head.writer, head.text);
}

std::string headOf(const CsvHead& head) {
    std::string comments = firstLine(head) + '\n', header;
    for (const Column& column : head.columns) {
        const std::string unit = column.unitText();
        comments += fmt::format("# {}: {}{}\n", column.header(), column.meaning, unit.empty() ? "" : " [" + unit + "]");
        header += (header.empty() ? "" : ",") + column.header();
    }
    return comments + header + '\n';
}

// Complete lines only, without their newline: what follows the last newline was still being written.
bool nextLine(std::istream& file, std::string& line) {
    if (!std::getline(file, line) || file.eof()) return false;
    if (line.ends_with('\r')) line.pop_back();
    return true;
}

std::vector<std::string> words(const std::string& line) {
    std::vector<std::string> all;
    std::string word;
    for (std::istringstream stream(line); std::getline(stream, word, ',');) all.push_back(word);
    return all;
}

// Reads the numbers of a row. Returns what is wrong with it, or an empty text.
std::string parseRow(const std::string& line, std::size_t columns, std::vector<double>& row) {
    row.clear();
    for (const std::string& word : words(line)) {
        char* end = nullptr;
        row.push_back(std::strtod(word.c_str(), &end));
        if (word.empty() || *end) return fmt::format("'{}' is no number", word);
    }
    return row.size() == columns ? "" : fmt::format("{} numbers for {} columns", row.size(), columns);
}

// Content of an existing table that is to be continued from `time`.
struct Earlier {
    std::string comments, header;  // comments with newlines, header without
    std::string rows;              // up to that time
    int badLine = 0;               // the first line that is not a row; 0: all are rows
};

Earlier readUntil(const fs::path& path, double time) {
    std::ifstream file(path);
    Earlier found;
    std::string line;
    std::size_t columns = 0;
    std::vector<double> row;
    for (int number = 1; nextLine(file, line); ++number) {
        if (line.starts_with('#')) {
            if (found.header.empty()) found.comments += line + '\n';
        } else if (found.header.empty()) {
            found.header = line;
            columns = words(line).size();
        } else if (!parseRow(line, columns, row).empty()) {
            if (found.badLine == 0) found.badLine = number;
        } else if (row[0] <= time) {
            found.rows += line + '\n';
        }
    }
    if (!fs::exists(path) || file.bad())
        throw Failure(ExitCode::io,
                      fmt::format("cannot read {}, which this run has written: was it moved?", path.string()));
    return found;
}

// Message about the columns that were added and removed.
std::string columnChanges(const std::string& before, const std::string& now) {
    const std::vector<std::string> had = words(before), has = words(now);
    const auto only = [](const std::vector<std::string>& all, const std::vector<std::string>& others) {
        std::vector<std::string> list;
        for (const std::string& one : all)
            if (std::find(others.begin(), others.end(), one) == others.end()) list.push_back(one);
        return list;
    };
    const std::vector<std::string> added = only(has, had), gone = only(had, has);
    if (added.empty() && gone.empty()) return "its columns stand in another order than before";
    std::string text;
    if (!added.empty()) text = "it now has the columns " + joinWords(added);
    if (!gone.empty()) text += (text.empty() ? "it" : ", and") + (" no longer has " + joinWords(gone));
    return text;
}

// A free name in the folder of the table that does not end with .csv, so that nothing takes the file for a table.
fs::path nameAside(const fs::path& path, double time) {
    const std::string base = fmt::format("{}.until_{:.9g}", path.string(), time);
    fs::path aside = base;
    for (int n = 2; fs::exists(aside); ++n) aside = fmt::format("{}_{}", base, n);
    return aside;
}

bool isNumber(const std::string& name) {
    char* end = nullptr;
    std::strtod(name.c_str(), &end);
    return !name.empty() && *end == 0;
}

std::string firstLineOf(const fs::path& path) {
    std::ifstream file(path);
    std::string line;
    nextLine(file, line);
    return line;
}

// Whether the first line says that this is the place of a table of this kind.
bool isOwn(const fs::path& path, const std::string& kind) {
    const std::string place = path.parent_path().filename().string() + "/" + path.filename().string();
    return firstLineOf(path).starts_with(fmt::format("# {}{}{} ", place, signature, kind));
}

// postProcessing/<observer>/<start time>/<file>.csv, as versions before 2026-11 wrote them.
bool isOfEarlierVersion(const fs::path& path, const std::string& kind) {
    return isNumber(path.parent_path().filename().string()) &&
           firstLineOf(path).starts_with(kind == "observer" ? "time_s,strain" : "stage,");
}

std::vector<fs::path> entries(const fs::path& folder) {
    std::vector<fs::path> list;
    std::error_code none;
    for (const auto& entry : fs::directory_iterator(folder, none)) list.push_back(entry.path());
    std::sort(list.begin(), list.end());
    return list;
}

void removeFile(const fs::path& path) {
    std::error_code error;
    fs::remove(path, error);
    if (error)
        throw Failure(ExitCode::io,
                      fmt::format("cannot remove {}, a table of an earlier run: {}", path.string(), error.message()));
}

// Folders that are not empty stay.
void removeIfEmpty(const fs::path& folder) {
    std::error_code notEmpty;
    fs::remove(folder, notEmpty);
}

void clearFolder(const fs::path& folder, const std::string& kind, std::optional<double> restart) {
    for (const fs::path& path : entries(folder)) {
        if (fileOfTemporary(path).extension() == ".csv")  // left by a program that was killed while it wrote a table
            removeFile(path);
        else if (fs::is_directory(path) && !restart) {
            for (const fs::path& old : entries(path))
                if (old.extension() == ".csv" && isOfEarlierVersion(old, kind)) removeFile(old);
            if (isNumber(path.filename().string())) removeIfEmpty(path);
        } else if (path.extension() == ".csv" && isOwn(path, kind)) {
            if (!restart)
                removeFile(path);
            else if (const Earlier found = readUntil(path, *restart); found.badLine == 0) {
                const std::string text = found.comments + found.header + '\n' + found.rows;
                if (text.size() != fs::file_size(path)) writeFileAtomically(path, text);
            }
        }
    }
    if (!restart) removeIfEmpty(folder);
}

}  // namespace

std::string Column::unitText() const {
    if (unit == "percent") return "%";
    if (unit == "Pas") return "Pa s";
    for (const char* product : {"Nm", "Ns", "Js"})
        if (unit == product) return fmt::format("{} {}", product[0], product[1]);
    std::string text;
    for (const char c : unit) {
        if (std::isdigit(static_cast<unsigned char>(c)) && !text.empty()) text += '^';
        text += c == '_' ? '/' : c;
    }
    return text;
}

CsvSeries::CsvSeries(MPI_Comm comm, const fs::path& caseDir, const CsvHead& head, std::optional<double> restart)
    : path_(caseDir / "postProcessing" / head.observer / (head.file + ".csv")),
      head_(headOf(head)),
      columns_(head.columns.size()) {
    onRoot(comm, [&] {
        root_ = true;
        makeFolder(path_.parent_path());
        if (restart && fs::exists(path_))
            resume(*restart);
        else
            writeFileAtomically(path_, head_);
        file_ = AppendedFile(path_);
    });
}

void CsvSeries::resume(double time) {
    const Earlier found = readUntil(path_, time);
    const std::string comments = head_.substr(0, head_.rfind('\n', head_.size() - 2) + 1),
                      header = head_.substr(comments.size(), head_.size() - comments.size() - 1);
    const bool others = !found.header.empty() && found.header != header;
    if (others || found.badLine > 0) {
        const fs::path aside = nameAside(path_, time);
        std::error_code error;
        fs::copy_file(path_, aside, error);
        if (error)
            throw Failure(ExitCode::io,
                          fmt::format("cannot copy {} to {}: {}", path_.string(), aside.string(), error.message()));
        note_ = others
                    ? fmt::format("{}: {}; the rows until t = {:.9g} s are kept in {}, the table begins anew",
                                  path_.string(), columnChanges(found.header, header), time, aside.filename().string())
                    : fmt::format(
                          "{}:{} is no row of this table; the file is kept as it is in {}, the table goes on "
                          "without such lines",
                          path_.string(), found.badLine, aside.filename().string());
    }
    writeFileAtomically(path_, head_ + (others ? "" : found.rows));
}

void CsvSeries::row(std::span<const double> values) {
    if (!root_) return;
    if (values.size() != columns_) {
        throw std::invalid_argument(
            fmt::format("{}: a row of {} numbers for {} columns", path_.string(), values.size(), columns_));
    }
    std::string line;
    for (const double value : values) line += fmt::format("{}{:.17g}", line.empty() ? "" : ",", value);
    file_.add(line + '\n');
}

void CsvSeries::cutAfter(double time) {
    if (!root_) return;
    const Earlier found = readUntil(path_, time);
    file_.close();
    writeFileAtomically(path_, head_ + found.rows);
    file_ = AppendedFile(path_);
}

void clearTables(MPI_Comm comm, const fs::path& caseDir, const std::string& kind, std::optional<double> restart) {
    onRoot(comm, [&] {
        const fs::path all = caseDir / "postProcessing";
        for (const fs::path& folder : entries(all))
            if (fs::is_directory(folder)) clearFolder(folder, kind, restart);
        if (!restart) removeIfEmpty(all);
    });
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

CsvTable readCsv(const fs::path& path) {
    std::ifstream file(path);
    std::string line;
    CsvTable table;
    for (int number = 1; nextLine(file, line); ++number) {
        if (line.starts_with('#')) continue;
        if (table.columns.empty()) {
            table.columns = words(line);
            continue;
        }
        std::vector<double> row;
        if (const std::string fault = parseRow(line, table.columns.size(), row); !fault.empty())
            throw Failure(ExitCode::io, fmt::format("{}:{}: {}", path.string(), number, fault));
        table.rows.push_back(std::move(row));
    }
    if (table.columns.empty())
        throw Failure(ExitCode::io, fmt::format("{}: the file is missing or empty", path.string()));
    return table;
}

CsvTable readCsvSeries(const fs::path& caseDir, const std::string& observer, const std::string& file) {
    const fs::path folder = caseDir / "postProcessing" / observer, path = folder / (file + ".csv");
    if (fs::exists(path)) return readCsv(path);
    std::vector<std::string> known;
    for (const fs::path& there : entries(folder))
        if (there.extension() == ".csv") known.push_back(there.stem().string());
    throw Failure(ExitCode::io, fmt::format("{} is not there; this folder has {}.{}", path.string(),
                                            known.empty() ? "no table" : joinWords(known), didYouMean(file, known)));
}

}  // namespace corpuscle::io
