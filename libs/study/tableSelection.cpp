#include "study/tableSelection.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/error.hpp"
#include "core/units.hpp"

namespace corpuscle::study {
namespace {

constexpr double tolerable = 0.01;  // fraction of an interval by which rows may deviate from even spacing

bool has(const io::CsvTable& table, const std::string& column) {
    return std::find(table.columns.begin(), table.columns.end(), column) != table.columns.end();
}

std::string numberText(double value) { return fmt::format("{:.6g}", value); }

// The column by which the rows of one time differ; empty: there is one row for each time.
std::string keyOf(const io::CsvTable& table) {
    const std::vector<double> times = table.column("time_s");
    if (std::adjacent_find(times.begin(), times.end()) == times.end()) return "";
    if (has(table, "cell")) return "cell";
    for (const std::string& column : table.columns)
        if (column != "time_s" && column != "strain") return column;
    return "";
}

// The column in which the range is given: that of -from or -to; else the strain, or the time in a flow without shear.
std::string alongOf(const io::CsvTable& table, const std::string& name, const std::optional<Moment>& from,
                    const std::optional<Moment>& to) {
    for (const auto& moment : {from, to})
        if (moment && !has(table, moment->column))
            throw Failure(ExitCode::usage, fmt::format("{} has no column '{}': give its range as a {}", name,
                                                       moment->column, moment->column == "strain" ? "time" : "strain"));
    if (from) return from->column;
    if (to) return to->column;
    if (!has(table, "strain")) return "time_s";
    const std::vector<double> strain = table.column("strain");
    return !strain.empty() && strain.back() != strain.front() ? "strain" : "time_s";
}

std::vector<std::string> columnsOf(const io::CsvTable& table, const std::string& name, const std::string& key,
                                   const std::vector<std::string>& wanted) {
    std::vector<std::string> columns;
    for (const std::string& column : table.columns)
        if (column != "time_s" && column != "strain" && column != key) columns.push_back(column);
    for (const std::string& column : wanted)
        if (std::find(columns.begin(), columns.end(), column) == columns.end())
            throw Failure(ExitCode::usage, fmt::format("found the column '{}'; {} has {}.{}", column, name,
                                                       joinWords(columns), didYouMean(column, columns)));
    return wanted.empty() ? columns : wanted;
}

// Adds the rows for which `isWanted` is true to the series, averaged over the cells at each time.
template <class IsWanted>
void addRows(TableSelection& s, const io::CsvTable& table, IsWanted&& isWanted) {
    const std::vector<double> along = table.column(s.along), time = table.column("time_s");
    const std::vector<double> places = s.isByPlace() ? table.column(s.key) : std::vector<double>(along.size());
    std::map<std::string, std::vector<double>> values;
    for (const std::string& column : s.columns) values[column] = table.column(column);
    std::map<double, long> rows;  // number of rows of each place at this time
    for (std::size_t row = 0; row < along.size(); ++row) {
        if (!isWanted(row)) continue;
        if (rows.empty() || time[row] != time[row - 1]) s.moments.push_back(along[row]), rows.clear();
        const long before = rows[places[row]]++;
        for (const std::string& column : s.columns) {
            std::vector<double>& series = s.series[places[row]][column];
            if (before == 0)
                series.push_back(values[column][row]);
            else  // mean over the cells
                series.back() += (values[column][row] - series.back()) / static_cast<double>(before + 1);
        }
    }
}

}  // namespace

Moment Moment::parse(const std::string& text) {
    constexpr std::string_view strain = " strain";
    const bool isStrain = text.ends_with(strain);
    const Quantity found = parseQuantity(isStrain ? text.substr(0, text.size() - strain.size()) : text);
    if (isStrain ? found.hasUnit : !found.hasUnit || found.dimension != unit::second)
        throw std::invalid_argument("neither a strain nor a time");
    return {isStrain ? "strain" : "time_s", found.value};
}

TableSelection selectFrom(const io::CsvTable& table, const std::string& name, const std::optional<Moment>& from,
                          const std::optional<Moment>& to, const std::vector<std::string>& columns, bool wholeRun) {
    TableSelection s;
    s.along = alongOf(table, name, from, to);
    s.key = keyOf(table);
    s.columns = columnsOf(table, name, s.key, columns);
    const std::vector<double> along = table.column(s.along), ends = table.column(to ? to->column : s.along);
    if (along.empty()) throw Failure(ExitCode::io, fmt::format("{} has no rows", name));
    const double end = to && to->column == s.along ? std::min(to->value, along.back()) : along.back();
    const double first = wholeRun ? along.front() : 0.5 * (along.front() + end);
    const double begin = from ? from->value : first, margin = 1e-9 * std::abs(along.back());
    addRows(s, table, [&](std::size_t row) {
        return along[row] >= begin - margin && (!to || ends[row] <= to->value * (1 + 1e-9));
    });
    if (s.moments.empty())
        throw Failure(ExitCode::usage, fmt::format("no row of {} lies there; its {} goes from {} to {}", name,
                                                   s.alongWord(), numberText(along.front()), numberText(along.back())));
    return s;
}

double requireEvenSpacing(TableSelection& s, const std::string& name) {
    const std::size_t times = s.moments.size();
    const double interval = times > 1 ? s.moments[1] - s.moments[0] : 0;
    for (std::size_t k = 1; k < times; ++k) {
        const double step = s.moments[k] - s.moments[k - 1];
        if (std::abs(step - interval) <= tolerable * interval) continue;
        if (k + 1 < times)
            throw Failure(
                ExitCode::usage,
                fmt::format("rows of {} are not evenly spaced: after {} {} the interval is {} in place of "
                            "{}; take a range in which it is the same throughout",
                            name, s.alongWord(), numberText(s.moments[k - 1]), numberText(step), numberText(interval)));
        for (auto& [place, columns] : s.series)
            for (auto& [column, series] : columns)
                if (series.size() == times) series.pop_back();
        s.moments.pop_back();
    }
    return interval;
}

io::CsvTable readTable(const std::filesystem::path& caseDir, const std::string& name) {
    const std::size_t slash = name.find('/');
    if (slash == std::string::npos || slash == 0 || slash + 1 == name.size())
        throw Failure(ExitCode::usage, fmt::format("found '{}'; write OBSERVER/FILE, as blood/suspension for "
                                                   "postProcessing/blood/suspension.csv",
                                                   name));
    return io::readCsvSeries(caseDir, name.substr(0, slash), name.substr(slash + 1));
}

}  // namespace corpuscle::study
