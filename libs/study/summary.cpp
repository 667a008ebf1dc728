#include "study/summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/units.hpp"

namespace corpuscle::study {
namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
constexpr double logarithmicSpread = 30;

struct Number {
    double value = nothing;
    std::string unit;
    bool isNumber = false;
};

Number numberOf(const std::string& text) {
    try {
        parseQuantity(text);
    } catch (const std::invalid_argument&) {
        return {};
    }
    const std::size_t blank = text.find(' ');
    return {std::stod(text.substr(0, blank)), blank == std::string::npos ? "" : text.substr(blank + 1), true};
}

std::string cell(const std::string& text) {
    if (text.find_first_of(",\"\n#") == std::string::npos) return text;
    std::string quoted = "\"";
    for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
    return quoted + "\"";
}

std::string numberText(double value) { return std::isfinite(value) ? fmt::format("{:.12g}", value) : ""; }

ParameterColumn columnOf(const StudySettings& study, std::size_t k, const std::vector<CaseStatus>& cases) {
    const std::string& name = cases.front().what.values[k].first;
    ParameterColumn column{.name = name, .follows = study.parameters.at(name).with.has_value()};
    column.unit = numberOf(cases.front().what.values[k].second).unit;
    double least = std::numeric_limits<double>::infinity(), greatest = 0;
    for (const CaseStatus& one : cases) {
        const Number number = numberOf(one.what.values[k].second);
        column.isNumber = column.isNumber && number.isNumber && number.unit == column.unit;
        least = std::min(least, number.value), greatest = std::max(greatest, number.value);
    }
    if (!column.isNumber) column.unit.clear();
    column.isLogarithmic = column.isNumber && least > 0 && greatest >= logarithmicSpread * least;
    return column;
}

}  // namespace

std::string ParameterColumn::header() const {
    std::string text = name + (unit.empty() ? "" : "_");
    for (const char c : unit)
        if (c == '/')
            text += '_';
        else if (c != ' ' && c != '^' && c != '.' && c != '*')
            text += c;
    return text;
}

CaseResult resultOf(const ResultSettings& result, const std::filesystem::path& caseDir) {
    CaseResult found;
    try {
        const io::CsvTable table = readTable(caseDir, result.table);
        TableSelection selection = selectFrom(table, result.table, result.first(), result.last(), {result.column},
                                              result.statistic->isOfWholeRun());
        if (selection.isByPlace())
            throw Failure(ExitCode::usage, fmt::format("{} has several rows for each time, one for each {}; a result "
                                                       "is one number",
                                                       result.table, selection.key));
        if (result.statistic->needsEvenSpacing()) requireEvenSpacing(selection, result.table);
        std::vector<double> along, values;
        const std::vector<double>& series = selection.series.begin()->second.at(result.column);
        for (std::size_t i = 0; i < series.size(); ++i)
            if (std::isfinite(series[i])) along.push_back(selection.moments[i]), values.push_back(series[i]);
        if (values.empty()) throw Failure(ExitCode::io, fmt::format("{} has no numbers there", result.table));
        found.estimate = result.statistic->of(along, values);
        if (!std::isfinite(found.estimate.value))
            found.problem = fmt::format("no {} in {} to {}", result.statistic->text(), along.front(), along.back());
    } catch (const Failure& failure) {
        found.problem = failure.what();
    }
    return found;
}

Summary summarise(const StudySettings& study, const std::vector<CaseStatus>& cases,
                  const std::filesystem::path& casesFolder, KnownResults& known) {
    Summary summary;
    for (std::size_t k = 0; !cases.empty() && k < cases.front().what.values.size(); ++k)
        summary.parameters.push_back(columnOf(study, k, cases));
    for (const auto& [name, result] : study.results) summary.results.emplace_back(name, &result);
    for (const CaseStatus& one : cases) {
        SummaryRow row{.status = &one};
        for (const auto& [name, value] : one.what.values) {
            row.texts.push_back(value);
            row.numbers.push_back(numberOf(value).value);
        }
        row.results.resize(summary.results.size());
        if (one.state == CaseState::done) {
            const auto [results, isNew] = known.try_emplace(one.what.name);
            if (isNew)
                for (const auto& [name, result] : summary.results)
                    results->second.push_back(resultOf(*result, casesFolder / one.what.name));
            row.results = results->second;
        }
        summary.rows.push_back(std::move(row));
    }
    return summary;
}

std::string csvText(const Summary& summary, const std::string& title) {
    std::string text = fmt::format(
        "# {}\n# case: its folder; status: done, failed, ...; runTime_s: of all its programs "
        "[s]\n",
        title);
    std::string header = "case,status";
    for (const ParameterColumn& p : summary.parameters) {
        header += "," + p.header();
        if (!p.unit.empty()) text += fmt::format("# {}: {} [{}]\n", p.header(), p.name, p.unit);
    }
    for (const auto& [name, result] : summary.results) {
        header += "," + name;
        text += fmt::format("# {}: {}\n", name, result->meaning());
        if (!result->statistic->hasError()) continue;
        header += fmt::format(",{0}_error,{0}_reliable", name);
        text += fmt::format("# {0}_error: its standard error; {0}_reliable: 0 where that is a lower bound\n", name);
    }
    text += header + ",runTime_s\n";
    for (const SummaryRow& row : summary.rows) {
        text += fmt::format("{},{}", cell(row.status->what.name), nameOf(row.status->state));
        for (std::size_t k = 0; k < row.texts.size(); ++k)
            text += "," + (summary.parameters[k].isNumber ? numberText(row.numbers[k]) : cell(row.texts[k]));
        for (std::size_t k = 0; k < row.results.size(); ++k) {
            const Estimate& estimate = row.results[k].estimate;
            const bool isThere = std::isfinite(estimate.value);
            text += "," + numberText(estimate.value);
            if (summary.results[k].second->statistic->hasError())
                text +=
                    fmt::format(",{},{}", numberText(estimate.error), isThere ? (estimate.isReliable ? "1" : "0") : "");
        }
        text += fmt::format(",{:.1f}\n", row.status->seconds);
    }
    return text;
}

}  // namespace corpuscle::study
