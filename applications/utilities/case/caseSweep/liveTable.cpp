#include "liveTable.hpp"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <map>

#include "core/runRecord.hpp"
#include "core/wallClock.hpp"

namespace corpuscle {

using study::CaseState;
using study::CaseStatus;

namespace {

std::size_t terminalLines() {
    winsize size{};
    return ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_row > 4 ? size.ws_row : 24;
}

std::size_t terminalColumns() {
    winsize size{};
    return ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 20 ? size.ws_col : 80;
}

std::string countsText(const std::vector<CaseStatus>& cases) {
    std::map<std::string, int> counts;
    for (const CaseStatus& one : cases) ++counts[nameOf(one.state)];
    std::string text;
    for (const auto& [state, count] : counts) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, state);
    return fmt::format("{} of {} cases: {}", "study", cases.size(), text);
}

std::vector<std::string> rowOf(const CaseStatus& one) {
    const bool hasBegun = one.state != CaseState::waiting && one.state != CaseState::elsewhere;
    return {one.what.name, nameOf(one.state), one.state == CaseState::done ? "" : one.program, one.progress,
            hasBegun || one.seconds > 0 ? formatDuration(one.seconds) : ""};
}

}  // namespace

LiveTable::LiveTable(Log& log, Output output)
    : log_(log), output_(output), isTerminal_(output == Output::text && isatty(STDOUT_FILENO) == 1) {}

void LiveTable::show(const std::vector<CaseStatus>& cases, bool changed) {
    if (!isTerminal_) return tell(cases);
    const auto now = std::chrono::steady_clock::now();
    if (!changed && now - drawn_ < std::chrono::milliseconds(500)) return;
    drawn_ = now;
    draw(cases);
}

void LiveTable::finish(const std::vector<CaseStatus>& cases) {
    if (!isTerminal_) return tell(cases);
    draw(cases);
}

// If there are more cases than lines, running and failed cases come first.
void LiveTable::draw(const std::vector<CaseStatus>& cases) {
    std::vector<const CaseStatus*> shown;
    shown.reserve(cases.size());
    for (const CaseStatus& one : cases) shown.push_back(&one);
    const std::size_t room = terminalLines() - 3;
    if (shown.size() > room) {
        const auto rank = [](const CaseStatus* one) {
            return one->state == CaseState::running   ? 0
                   : one->state == CaseState::failed  ? 1
                   : one->state == CaseState::waiting ? 2
                                                      : 3;
        };
        std::stable_sort(shown.begin(), shown.end(), [&](auto* a, auto* b) { return rank(a) < rank(b); });
        shown.resize(room);
    }
    std::vector<std::vector<std::string>> rows;
    rows.reserve(shown.size());
    for (const CaseStatus* one : shown) rows.push_back(rowOf(*one));
    std::vector<std::string> lines = alignedTable({"case", "state", "program", "progress", "run time"}, rows);
    lines.push_back(countsText(cases));
    std::string text = drawnLines_ > 0 ? fmt::format("\x1b[{}A\x1b[J", drawnLines_) : "";
    const std::size_t columns = terminalColumns();
    for (const std::string& line : lines) text += line.substr(0, columns - 1) + "\n";
    drawnLines_ = lines.size();
    std::fputs(text.c_str(), stdout);
    std::fflush(stdout);
}

void LiveTable::tell(const std::vector<CaseStatus>& cases) {
    told_.resize(cases.size());
    for (std::size_t k = 0; k < cases.size(); ++k) {
        const CaseStatus& one = cases[k];
        const std::string state = fmt::format("{} {}", nameOf(one.state), one.program);
        if (told_[k] == state) continue;
        const bool isFirst = told_[k].empty();
        told_[k] = state;
        if (one.state == CaseState::waiting) continue;
        std::string line = fmt::format("[{}/{}] {}: ", k + 1, cases.size(), one.what.name);
        switch (one.state) {
            case CaseState::running:
                line += one.program + " starts";
                break;
            case CaseState::done:
                line += isFirst ? "done before" : "done, " + formatDuration(one.seconds);
                break;
            case CaseState::failed:
                line += fmt::format("{}: {} ended with code {}", isFirst ? "failed before" : "failed", one.program,
                                    one.record.failed ? one.record.failed->code : 0);
                break;
            case CaseState::elsewhere:
                line += "another run of the study is at it";
                break;
            case CaseState::stopped:
                line += fmt::format("stopped in {}", one.program);
                break;
            case CaseState::waiting:
                break;
        }
        line = timestamp() + " " + line;
        if (output_ == Output::json)
            std::fputs((line + '\n').c_str(), stderr);
        else
            log_.info("{}", line);
    }
}

}  // namespace corpuscle
