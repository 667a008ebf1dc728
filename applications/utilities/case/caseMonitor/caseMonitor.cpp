// caseMonitor: the progress of a run while it runs, the time left, what limits the time step, and a curve of results.
//
// Reads run.json, which the solver writes every few seconds, and the tables of the observers. The run is not disturbed;
// it may be on another machine that shares the folder.
//
// Sample runs:
//     caseMonitor
//     caseMonitor -case myCell -column D12_inertia
//     caseMonitor -once -json
#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <iostream>
#include <thread>

#include "core/application.hpp"
#include "core/error.hpp"
#include "core/log.hpp"
#include "core/units.hpp"
#include "core/wallClock.hpp"
#include "plot.hpp"
#include "runStatus.hpp"
#include "study/tableSelection.hpp"

using namespace corpuscle;
namespace fs = std::filesystem;

namespace {

constexpr int plotLines = 8, mostColumns = 118;

struct Curve {
    std::string table, column;  // "deformation/rbc", "D12_extent"
};

int terminalColumns() {
    winsize size{};
    const int columns =
        ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 20 ? size.ws_col - 1 : mostColumns;
    return std::min(columns, mostColumns);
}

bool hasUnicode() {
    for (const char* name : {"LC_ALL", "LC_CTYPE", "LANG"})
        if (const char* value = std::getenv(name); value && *value) {
            std::string text(value);
            std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
            return text.find("utf-8") != std::string::npos || text.find("utf8") != std::string::npos;
        }
    return false;
}

// OBSERVER/FILE of each table, in the order of the observers in system/observers.yaml.
std::vector<std::string> tablesOf(const fs::path& caseDir) {
    std::vector<std::string> names;
    std::error_code ignored;
    for (const auto& folder : fs::directory_iterator(caseDir / "postProcessing", ignored))
        for (const auto& file : fs::directory_iterator(folder.path(), ignored))
            if (file.path().extension() == ".csv")
                names.push_back(folder.path().filename().string() + "/" + file.path().stem().string());
    std::sort(names.begin(), names.end());
    std::vector<std::string> order;
    std::ifstream observers(caseDir / "system" / "observers.yaml");
    for (std::string line; std::getline(observers, line);)
        if (const std::size_t colon = line.find(':'); colon != std::string::npos && line[0] != '#' && line[0] != ' ')
            order.push_back(line.substr(0, colon));
    std::stable_sort(names.begin(), names.end(), [&](const std::string& a, const std::string& b) {
        const auto rank = [&](const std::string& name) {
            return std::find(order.begin(), order.end(), name.substr(0, name.find('/')));
        };
        return rank(a) < rank(b);
    });
    return names;
}

bool isPlace(const std::string& column) { return column == "time_s" || column == "strain" || column == "cell"; }

// The curve that -table and -column name; by default the first column of a table of cells, otherwise of any table.
Curve curveOf(const Application& app, const fs::path& caseDir) {
    const auto wanted = app.value("column");
    const std::vector<std::string> tables = app.has("table") ? std::vector{*app.value("table")} : tablesOf(caseDir);
    std::vector<std::string> columns;
    Curve first;
    bool isOfCells = false;
    for (const std::string& name : tables) {
        const io::CsvTable table = study::readTable(caseDir, name);
        if (wanted && std::find(table.columns.begin(), table.columns.end(), *wanted) != table.columns.end())
            return {name, *wanted};
        columns.insert(columns.end(), table.columns.begin(), table.columns.end());
        const auto data = std::find_if_not(table.columns.begin(), table.columns.end(), isPlace);
        const bool hasCells = std::find(table.columns.begin(), table.columns.end(), "cell") != table.columns.end();
        if (data == table.columns.end() || table.rows.empty() || (!first.table.empty() && (isOfCells || !hasCells)))
            continue;
        first = {name, *data}, isOfCells = hasCells;
    }
    if (wanted)
        throw Failure(ExitCode::usage,
                      fmt::format("-column {}: no table of {} has it.{}", *wanted,
                                  app.value("table").value_or("postProcessing"), didYouMean(*wanted, columns)));
    return first;
}

std::string numberText(const nlohmann::ordered_json& value, Dimension dimension, int digits) {
    return value.is_number() ? formatQuantity(value.get<double>(), dimension, digits) : "?";
}

std::string barText(double share, int columns) {
    const int width = std::clamp(columns - 40, 10, 50), full = static_cast<int>(std::lround(share * width));
    return "[" + std::string(static_cast<std::size_t>(std::clamp(full, 0, width)), '#') +
           std::string(static_cast<std::size_t>(std::clamp(width - full, 0, width)), '-') + "]";
}

std::string clockIn(double seconds) {
    const std::time_t then = std::time(nullptr) + static_cast<std::time_t>(seconds);
    std::tm local{};
    localtime_r(&then, &local);
    char text[32];
    std::strftime(text, sizeof text, seconds < 20 * 3600 ? "%H:%M" : "%a %H:%M", &local);
    return text;
}

void addProgress(std::vector<std::string>& lines, const RunStatus& status, int columns) {
    if (!status.record.contains("progress")) {
        if (status.isRunning()) lines.emplace_back("the first step is being made");
        return;
    }
    const auto& progress = status.record["progress"];
    const auto number = [&](const char* key) {
        return progress.contains(key) && progress[key].is_number() ? progress[key].get<double>() : std::nan("");
    };
    const double share = number("fraction");
    std::string line = fmt::format("{} {:.1f} %", barText(share, columns), 100 * share);
    if (progress.contains("strain")) line += fmt::format("   strain {:.4g}", number("strain"));
    lines.push_back(
        line + fmt::format("   t {}   step {:.0f}", numberText(progress["time_s"], unit::second, 4), number("step")));
    line = fmt::format("step of {}, set by '{}'; {:.3g} steps/s", numberText(progress["dt_s"], unit::second, 3),
                       progress.value("limit", "?"), number("stepsPerSecond"));
    if (const double left = number("secondsLeft"); status.isRunning() && std::isfinite(left))
        line += fmt::format("; {} left, until about {}", formatDuration(left), clockIn(left));
    lines.push_back(line);
}

void addCurve(std::vector<std::string>& lines, const fs::path& caseDir, const Curve& curve, int columns) {
    if (curve.table.empty()) return;
    const study::TableSelection selection = study::selectFrom(study::readTable(caseDir, curve.table), curve.table,
                                                              std::nullopt, std::nullopt, {curve.column}, true);
    if (selection.isByPlace() || selection.series.empty()) {
        lines.push_back(fmt::format("{} of {} has a row for each place: no curve", curve.column, curve.table));
        return;
    }
    const std::vector<double>& values = selection.series.begin()->second.at(curve.column);
    const auto plot = plotText(selection.moments, values, columns, plotLines, hasUnicode());
    if (plot.empty()) return;
    lines.push_back(fmt::format("{} of {} over {}{}, last {:.5g}", curve.column, curve.table, selection.along,
                                selection.key == "cell" ? ", mean of the cells" : "", values.back()));
    lines.insert(lines.end(), plot.begin(), plot.end());
}

std::vector<std::string> screen(const Application& app, const fs::path& caseDir, const RunStatus& status) {
    const int columns = terminalColumns();
    const auto& record = status.record;
    const long ranks = record.value("ranks", 1L);
    std::vector<std::string> lines;
    lines.push_back(fmt::format("{}: {} {}{}, begun {}", fs::absolute(caseDir).lexically_normal().string(),
                                record.value("application", "?"), status.state,
                                ranks > 1 ? fmt::format(" on {} ranks", ranks) : "", record.value("start", "?")));
    if (!status.isRunning() && !status.reason.empty()) lines.push_back("reason: " + status.reason);
    addProgress(lines, status, columns);
    if (record.contains("warnings") && record["warnings"].is_array() && !record["warnings"].empty())
        lines.push_back(fmt::format("{} warning{}, the last: {}", record["warnings"].size(),
                                    record["warnings"].size() == 1 ? "" : "s", record["warnings"].back().dump()));
    try {
        addCurve(lines, caseDir, curveOf(app, caseDir), columns);
    } catch (const Failure& fault) {
        if (fault.code() == ExitCode::usage) throw;
        lines.emplace_back(fault.what());  // the table does not exist yet
    }
    return lines;
}

ExitCode codeOf(const RunStatus& status) {
    return status.state == "failed" || status.state == "killed" ? ExitCode::numerics
           : status.state == "stopped"                          ? ExitCode::stopped
                                                                : ExitCode::done;
}

void watch(const Application& app, const fs::path& caseDir, double interval) {
    std::size_t drawn = 0;
    for (;;) {
        const RunStatus status = RunStatus::of(caseDir);
        const std::vector<std::string> lines = screen(app, caseDir, status);
        std::string text = drawn > 0 ? fmt::format("\x1b[{}A\x1b[J", drawn) : "";
        for (const std::string& line : lines) text += line + "\n";
        drawn = lines.size();
        std::fputs(text.c_str(), stdout);
        std::fflush(stdout);
        if (!status.isRunning()) return;
        std::this_thread::sleep_for(std::chrono::duration<double>(interval));
    }
}

}  // namespace

int main(int argc, char* argv[]) {
    Application app(
        "caseMonitor", "Shows how far the run of a case is: progress, time left, limits, a curve.", argc, argv,
        {.options = {{"table", "OBSERVER/FILE", "the table of the curve (deformation/rbc)"},
                     {"column", "NAME", "its column (default: the first one of a table of cells)"},
                     {"every", "SECONDS", "how often it looks on a terminal (default 2)"},
                     {"once", "", "look once; without a terminal it always does"}},
         .samples = {"caseMonitor", "caseMonitor -case myCell -column D12_inertia", "caseMonitor -once -json"}});
    return app.run([&] {
        if (!app.communicator().isRoot()) return ExitCode::done;
        const fs::path caseDir = app.caseDirectory();
        const long interval = app.integer("every", 1).value_or(2);
        if (app.json()) {
            const RunStatus status = RunStatus::of(caseDir);
            nlohmann::ordered_json all{{"state", status.state}, {"reason", status.reason}};
            if (status.record.contains("progress")) all["progress"] = status.record["progress"];
            std::cout << all.dump(2) << '\n';
            return codeOf(status);
        }
        if (!app.has("once") && isatty(STDOUT_FILENO) == 1) {
            watch(app, caseDir, static_cast<double>(interval));
            return codeOf(RunStatus::of(caseDir));
        }
        const RunStatus status = RunStatus::of(caseDir);
        for (const std::string& line : screen(app, caseDir, status)) std::cout << line << '\n';
        return codeOf(status);
    });
}
