// averageTable: means over time of the columns of an observer's table, with standard errors by blocks
// (core/blockAverage.hpp).
//
// A table with a row for each cell gives the mean over the cells at each time, then over time. A table with a row for
// each place (the observer `profile`) gives the mean over time at each place.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "core/application.hpp"
#include "core/blockAverage.hpp"
#include "core/error.hpp"
#include "core/units.hpp"
#include "io/csvSeries.hpp"

using namespace corpuscle;

namespace {

constexpr double tolerable = 0.01;  // part of an interval by which rows may be off even steps
constexpr double rounding = 1e-9;   // of a mean: values that differ by less are the same

Usage usage() {
    return {.options = {{"from", "TIME", "Where averaging starts, a time or a strain; half of the run without it."},
                        {"to", "TIME", "Where it ends, a time or a strain; the end of the run without it."},
                        {"columns", "NAMES", "Which columns, separated by commas; all without it."}},
            .arguments = {{"TABLE", "", "OBSERVER/FILE under postProcessing, without .csv."}},
            .samples = {"averageTable blood/suspension -from \"5 strain\"",
                        "averageTable blood/suspension -columns relativeViscosity -json"}};
}

// A place in a run, in the column that it is given in.
struct Moment {
    std::string column;
    double value;
};

Moment momentOf(const std::string& option, const std::string& text) {
    constexpr std::string_view strain = " strain";
    const bool isStrain = text.ends_with(strain);
    Quantity found;
    bool isRight = true;
    try {
        found = parseQuantity(isStrain ? text.substr(0, text.size() - strain.size()) : text);
    } catch (const std::invalid_argument&) {
        isRight = false;
    }
    if (!isRight || (isStrain ? found.hasUnit : !found.hasUnit || found.dimension != unit::second))
        throw Failure(ExitCode::usage,
                      fmt::format("-{}: found '{}', which is no time and no strain; write \"0.2 s\" or "
                                  "\"5 strain\"",
                                  option, text));
    return {isStrain ? "strain" : "time_s", found.value};
}

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

// What is averaged: rows by place ("": all of them, cells together), the series of each column.
using Series = std::map<double, std::map<std::string, std::vector<double>>>;

struct Selection {
    Series series;
    std::vector<std::string> columns;
    double from = 0, to = 0, interval = 0;  // in the column `along`
    std::string along, key;
    std::size_t times = 0;

    const char* alongWord() const { return along == "strain" ? "strain" : "time"; }
};

// The column in which the range is said: that of -from or -to, else the strain, unless a flow without shear has none.
std::string alongOf(const io::CsvTable& table, const std::string& name, const std::optional<Moment>& from,
                    const std::optional<Moment>& to) {
    for (const auto& moment : {from, to})
        if (moment && !has(table, moment->column))
            throw Failure(ExitCode::usage, fmt::format("{} has no column '{}': give -from and -to as a {}", name,
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
            throw Failure(ExitCode::usage, fmt::format("-columns: found '{}'; {} has {}.{}", column, name,
                                                       joinWords(columns), didYouMean(column, columns)));
    return wanted.empty() ? columns : wanted;
}

// Adds the rows that `isWanted` to the series, cells of one time together. Returns the times, in the column `along`.
template <class IsWanted>
std::vector<double> addRows(Selection& s, const io::CsvTable& table, IsWanted&& isWanted) {
    const std::vector<double> along = table.column(s.along), time = table.column("time_s");
    const bool isByPlace = !s.key.empty() && s.key != "cell";
    const std::vector<double> places = isByPlace ? table.column(s.key) : std::vector<double>(along.size());
    std::map<std::string, std::vector<double>> values;
    for (const std::string& column : s.columns) values[column] = table.column(column);
    std::vector<double> moments;
    std::map<double, long> rows;  // of a place at this time
    for (std::size_t row = 0; row < along.size(); ++row) {
        if (!isWanted(row)) continue;
        if (rows.empty() || time[row] != time[row - 1]) moments.push_back(along[row]), rows.clear();
        const long before = rows[places[row]]++;
        for (const std::string& column : s.columns) {
            std::vector<double>& series = s.series[places[row]][column];
            if (before == 0)
                series.push_back(values[column][row]);
            else  // mean over the cells
                series.back() += (values[column][row] - series.back()) / static_cast<double>(before + 1);
        }
    }
    return moments;
}

// Blocks are of equal lengths in time. A row that does not fit at the end is that of the end of the run: it is left
// out.
void setInterval(Selection& s, const std::string& name, const std::vector<double>& moments) {
    s.times = moments.size(), s.from = moments.front(), s.to = moments.back();
    s.interval = moments.size() > 1 ? moments[1] - moments[0] : 0;
    for (std::size_t k = 1; k < moments.size(); ++k) {
        const double step = moments[k] - moments[k - 1];
        if (std::abs(step - s.interval) <= tolerable * s.interval) continue;
        if (k + 1 < moments.size())
            throw Failure(
                ExitCode::usage,
                fmt::format("rows of {} are not evenly spaced: after {} {} the interval is {} in place of "
                            "{}; take -from and -to so that it is the same throughout",
                            name, s.alongWord(), numberText(moments[k - 1]), numberText(step), numberText(s.interval)));
        for (auto& [place, columns] : s.series)
            for (auto& [column, series] : columns)
                if (series.size() == s.times) series.pop_back();
        --s.times, s.to = moments[k - 1];
    }
}

Selection select(const io::CsvTable& table, const std::string& name, const std::optional<Moment>& from,
                 const std::optional<Moment>& to, const std::vector<std::string>& wanted) {
    Selection s;
    s.along = alongOf(table, name, from, to);
    s.key = keyOf(table);
    s.columns = columnsOf(table, name, s.key, wanted);
    const std::vector<double> along = table.column(s.along), ends = table.column(to ? to->column : s.along);
    if (along.empty()) throw Failure(ExitCode::io, fmt::format("{} has no rows", name));
    const double end = to && to->column == s.along ? std::min(to->value, along.back()) : along.back();
    const double begin = from ? from->value : 0.5 * (along.front() + end), margin = 1e-9 * std::abs(along.back());
    const std::vector<double> moments = addRows(s, table, [&](std::size_t row) {
        return along[row] >= begin - margin && (!to || ends[row] <= to->value * (1 + 1e-9));
    });
    if (moments.empty())
        throw Failure(ExitCode::usage, fmt::format("no row of {} lies there; its {} goes from {} to {}", name,
                                                   s.alongWord(), numberText(along.front()), numberText(along.back())));
    setInterval(s, name, moments);
    return s;
}

std::vector<std::string> split(const std::string& text) {
    std::vector<std::string> words;
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t end = std::min(text.find(',', begin), text.size());
        if (end > begin) words.push_back(text.substr(begin, end - begin));
        begin = end + 1;
    }
    return words;
}

}  // namespace

int main(int argc, char* argv[]) {
    Application app("averageTable", "Means over time of an observer's table, with standard errors.", argc, argv,
                    usage());
    return app.run([&] {
        if (!app.communicator().isRoot()) return ExitCode::done;
        const std::string name = app.arguments()[0];
        const std::size_t slash = name.find('/');
        if (slash == std::string::npos || slash == 0 || slash + 1 == name.size())
            throw Failure(ExitCode::usage, fmt::format("found '{}'; write OBSERVER/FILE, as blood/suspension for "
                                                       "postProcessing/blood/suspension.csv",
                                                       name));
        const auto moment = [&](const std::string& option) -> std::optional<Moment> {
            const auto text = app.value(option);
            return text ? std::optional(momentOf(option, *text)) : std::nullopt;
        };
        const std::optional<Moment> from = moment("from"), to = moment("to");
        const io::CsvTable table =
            io::readCsvSeries(app.caseDirectory(), name.substr(0, slash), name.substr(slash + 1));
        const Selection s = select(table, name, from, to, split(app.value("columns").value_or("")));

        const std::string unit = s.along == "strain" ? "strain" : "time [s]";
        app.log().info("{}: {} {} to {}, {} times {} apart{}", name, unit, numberText(s.from), numberText(s.to),
                       s.times, numberText(s.interval), s.key == "cell" ? "; means over the cells" : "");
        nlohmann::json result{{"table", name},
                              {"along", s.along},
                              {"from", s.from},
                              {"to", s.to},
                              {"times", s.times},
                              {"interval", s.interval},
                              {"averages", nlohmann::json::array()}};
        std::size_t width = 6, doubtful = 0, finite = 0;
        for (const std::string& column : s.columns) width = std::max(width, column.size());
        const bool isByPlace = !s.key.empty() && s.key != "cell";
        app.log().info("{}{:<{}}  {:>13}  {:>14}  {:>18}", isByPlace ? fmt::format("{:<13}  ", s.key) : "", "column",
                       width, "mean", "standard error", "independent values");
        for (const auto& [place, columns] : s.series)
            for (const std::string& column : s.columns) {
                std::vector<double> series = columns.at(column);
                const std::size_t all = series.size();
                std::erase_if(series, [](double value) { return !std::isfinite(value); });
                if (series.empty()) continue;
                ++finite;
                const BlockAverage average = blockAverage(series);
                const bool isConstant = average.error <= rounding * std::abs(average.mean);
                const bool isReliable = (average.isReliable || isConstant) && series.size() == all;
                doubtful += isReliable ? 0 : 1;
                app.log().info("{}{:<{}}  {:>13.6g}  {:>14.3g}  {:>18.1f}{}",
                               isByPlace ? fmt::format("{:<13.6g}  ", place) : "", column, width, average.mean,
                               average.error, average.independent, isReliable ? "" : "  *");
                nlohmann::json one{{"column", column},
                                   {"mean", average.mean},
                                   {"standardError", average.error},
                                   {"independentValues", average.independent},
                                   {"isReliable", isReliable}};
                if (isByPlace) one[s.key] = place;
                result["averages"].push_back(one);
            }
        if (finite == 0) throw Failure(ExitCode::io, fmt::format("{} has no finite numbers there", name));
        if (doubtful > 0)
            app.log().warning(
                "* the standard error of {} of {} means is a lower bound: values depend on each other over more than "
                "an "
                "eighth of the time that is averaged, or drift, or are missing at some times; start later, or run "
                "longer",
                doubtful, finite);
        if (app.json()) fmt::print("{}\n", result.dump(2));
        return ExitCode::done;
    });
}
