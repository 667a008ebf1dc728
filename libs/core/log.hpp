// What a program tells its user: on the terminal and, when opened, in the file log.<application> of the case. Only the
// root speaks. -quiet silences info on the terminal (the file keeps it); warnings and errors always show, on stderr. A
// log that can no longer be written does not end a run: it is a warning, once.
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

    // Starts the file, or goes on at its end after the line `continuation`; what was said before is in it too. A file
    // that cannot be written is a warning.
    void open(const std::filesystem::path& file, const std::string& continuation = {});
    // In the file only, once it is open: what the terminal has been told in another way.
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
