// What a program tells its user: on the terminal and, when opened, in the file log.<application> of the case. Only the
// root writes. -quiet silences info on the terminal (the file keeps it); warnings and errors always show, on stderr. A
// log file that can no longer be written does not end a run; it gives one warning.
#pragma once
#include <fmt/core.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace corpuscle {

class Log {
  public:
    Log(bool isRoot, bool quiet) : isRoot_(isRoot), quiet_(quiet) {}

    // Starts a new file or, if a line `continuation` is given, appends that line to the old file and continues it.
    // Messages from before the call are written to it too. A file that cannot be written gives a warning.
    void open(const std::filesystem::path& file, const std::string& continuation = {});
    // Writes only to the file, once it is open: text that the terminal has already shown in another way.
    void note(const std::string& text);

    template <class... A>
    void info(fmt::format_string<A...> format, A&&... values) {
        if (isRoot_) infoLine(fmt::format(format, std::forward<A>(values)...));
    }
    template <class... A>
    void warning(fmt::format_string<A...> format, A&&... values) {
        if (isRoot_) warningLine(fmt::format(format, std::forward<A>(values)...));
    }
    template <class... A>
    void error(fmt::format_string<A...> format, A&&... values) {
        if (isRoot_) errorLine(fmt::format(format, std::forward<A>(values)...));
    }
    // Columns aligned; numbers to the right.
    void table(const std::vector<std::string>& header, const std::vector<std::vector<std::string>>& rows);

    const std::vector<std::string>& warnings() const { return warnings_; }  // for run.json

  private:
    void infoLine(const std::string& line);
    void warningLine(const std::string& line);
    void errorLine(const std::string& line);
    void keep(const std::string& line);

    bool isRoot_, quiet_;
    std::filesystem::path path_;
    std::ofstream file_;
    std::string beforeFile_;
    std::vector<std::string> warnings_;
};

// The lines of an aligned table.
std::vector<std::string> alignedTable(const std::vector<std::string>& header,
                                      const std::vector<std::vector<std::string>>& rows);

}  // namespace corpuscle
