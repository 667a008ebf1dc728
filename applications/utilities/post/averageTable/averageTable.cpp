// averageTable: time averages of the columns of an observer's table, with standard errors from block averages
// (core/blockAverage.hpp).
//
// In a table with a row for each cell, values are averaged over the cells at each time, then over time. In a table with
// a row for each place (the observer `profile`), values are averaged over time at each place.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "core/application.hpp"
#include "core/blockAverage.hpp"
#include "core/error.hpp"
#include "study/tableSelection.hpp"

using namespace corpuscle;

namespace {

constexpr double rounding = 1e-9;  // relative to a mean: values that differ by less count as equal

Usage usage() {
    return {.options = {{"from", "TIME", "Where averaging starts, a time or a strain; half of the run without it."},
                        {"to", "TIME", "Where it ends, a time or a strain; the end of the run without it."},
                        {"columns", "NAMES", "Which columns, separated by commas; all without it."}},
            .arguments = {{"TABLE", "", "OBSERVER/FILE under postProcessing, without .csv."}},
            .samples = {"averageTable blood/suspension -from \"5 strain\"",
                        "averageTable blood/suspension -columns relativeViscosity -json"}};
}

study::Moment momentOf(const std::string& option, const std::string& text) {
    try {
        return study::Moment::parse(text);
    } catch (const std::invalid_argument&) {
        throw Failure(ExitCode::usage,
                      fmt::format("-{}: found '{}', which is no time and no strain; write \"0.2 s\" or "
                                  "\"5 strain\"",
                                  option, text));
    }
}

std::string numberText(double value) { return fmt::format("{:.6g}", value); }

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
        const auto moment = [&](const std::string& option) -> std::optional<study::Moment> {
            const auto text = app.value(option);
            return text ? std::optional(momentOf(option, *text)) : std::nullopt;
        };
        const std::optional<study::Moment> from = moment("from"), to = moment("to");
        const io::CsvTable table = study::readTable(app.caseDirectory(), name);
        study::TableSelection s = study::selectFrom(table, name, from, to, split(app.value("columns").value_or("")));
        const double interval = study::requireEvenSpacing(s, name);

        const std::string unit = s.along == "strain" ? "strain" : "time [s]";
        app.log().info("{}: {} {} to {}, {} times {} apart{}", name, unit, numberText(s.moments.front()),
                       numberText(s.moments.back()), s.moments.size(), numberText(interval),
                       s.key == "cell" ? "; means over the cells" : "");
        nlohmann::json result{{"table", name},
                              {"along", s.along},
                              {"from", s.moments.front()},
                              {"to", s.moments.back()},
                              {"times", s.moments.size()},
                              {"interval", interval},
                              {"averages", nlohmann::json::array()}};
        std::size_t width = 6, doubtful = 0, finite = 0;
        for (const std::string& column : s.columns) width = std::max(width, column.size());
        const bool isByPlace = s.isByPlace();
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
