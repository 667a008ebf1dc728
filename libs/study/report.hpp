// report.html of a study: one page without anything outside it, for screens of any width. Plots of each result over
// each parameter (by gnuplot), the table of all cases, which sorts by a click, and the log's end of each case that
// failed.
#pragma once
#include <filesystem>
#include <string>

#include "study/summary.hpp"

namespace corpuscle::study {

struct ReportText {
    std::string title;                  // name of the study
    std::string templateCase;           // as it is written in the study
    std::vector<std::string> settings;  // FILE:/path=value of all cases
    std::string version;                // of Corpuscle
    std::string date;
};

// Plots are left out, and the page says so, where gnuplot is missing. `scratch`: a folder for its files.
std::string reportPage(const Summary& summary, const ReportText& text, const std::filesystem::path& scratch,
                       const Environment& environment);

}  // namespace corpuscle::study
