#include "core/log.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>

#include "core/writeFailure.hpp"

namespace corpuscle {

void Log::open(const std::filesystem::path& file, const std::string& continuation) {
    if (!isRoot_) return;
    if (file_.is_open()) file_.close();
    path_ = file;
    errno = 0;
    file_.open(file, continuation.empty() ? std::ios::trunc : std::ios::app);
    if (!file_) {
        warningLine(fmt::format("{}; the log goes to the terminal only", writeFailure(path_, errno).what()));
        return;
    }
    if (!continuation.empty()) file_ << (file_.tellp() > 0 ? "\n" : "") << continuation << '\n';
    file_ << beforeFile_ << std::flush;
    beforeFile_.clear();
}

void Log::keep(const std::string& line) {
    if (file_.is_open())
        note(line + '\n');
    else if (path_.empty())
        beforeFile_ += line + '\n';
}

void Log::note(const std::string& text) {
    if (!file_.is_open()) return;
    errno = 0;
    file_ << text << std::flush;
    if (file_) return;
    const int reason = errno;
    file_.close();
    file_.clear();
    warningLine(fmt::format("{}; from here on the log goes to the terminal only", writeFailure(path_, reason).what()));
}

void Log::infoLine(const std::string& line) {
    if (!quiet_) {
        std::fputs((line + '\n').c_str(), stdout);
        std::fflush(stdout);
    }
    keep(line);
}

void Log::warningLine(const std::string& line) {
    warnings_.push_back(line);
    std::fputs(("warning: " + line + '\n').c_str(), stderr);
    keep("warning: " + line);
}

void Log::errorLine(const std::string& line) {
    std::fputs(("error: " + line + '\n').c_str(), stderr);
    keep("error: " + line);
}

void Log::table(const std::vector<std::string>& header, const std::vector<std::vector<std::string>>& rows) {
    if (!isRoot_) return;
    for (const std::string& line : alignedTable(header, rows)) infoLine(line);
}

namespace {

// Number of characters, not of bytes, in UTF-8.
std::size_t width(const std::string& text) {
    return static_cast<std::size_t>(
        std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}

bool startsAsNumber(const std::string& text) {
    return !text.empty() && (text[0] == '-' || text[0] == '+' || (text[0] >= '0' && text[0] <= '9'));
}

}  // namespace

std::vector<std::string> alignedTable(const std::vector<std::string>& header,
                                      const std::vector<std::vector<std::string>>& rows) {
    std::vector<std::size_t> widths(header.size());
    std::vector<bool> right(header.size(), !rows.empty());
    for (std::size_t c = 0; c < header.size(); ++c) {
        widths[c] = width(header[c]);
        for (const auto& row : rows) {
            widths[c] = std::max(widths[c], width(row.at(c)));
            if (!row[c].empty() && !startsAsNumber(row[c])) right[c] = false;
        }
    }
    const auto line = [&](const std::vector<std::string>& cells) {
        std::string text;
        for (std::size_t c = 0; c < cells.size(); ++c) {
            const std::string padding(widths[c] - width(cells[c]), ' ');
            text += (c ? "  " : "") + (right[c] ? padding + cells[c] : cells[c] + padding);
        }
        return text.substr(0, text.find_last_not_of(' ') + 1);
    };
    std::vector<std::string> lines{line(header)};
    for (const auto& row : rows) lines.push_back(line(row));
    return lines;
}

}  // namespace corpuscle
