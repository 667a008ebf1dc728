// report.html of a study: one self-contained page, for screens of any width. It has plots of each result over each
// parameter (by gnuplot), the table of all cases, which a click on a column's head sorts, and the end of the log of
// each case that failed.
#pragma once
#include <filesystem>
#include <string>

#include "study/summary.hpp"

namespace corpuscle::study {

struct ReportText {
    std::string title;                  // name of the study
    std::string templateCase;           // as it is written in the study
    std::vector<std::string> settings;  // FILE:/path=value, set in all cases
    std::string version;                // of Corpuscle
    std::string date;
};

// Without gnuplot the page has no plots, and says so. `scratch`: a folder for the files of gnuplot.
std::string reportPage(const Summary& summary, const ReportText& text, const std::filesystem::path& scratch,
                       const Environment& environment);

}  // namespace corpuscle::study
