// Results of a study: one row for each case, as in summary.csv.
#pragma once
#include <map>
#include <string>
#include <vector>

#include "study/sweep.hpp"

namespace corpuscle::study {

// A parameter as a column: numbers where all its values are numbers in the same unit, else text.
struct ParameterColumn {
    std::string name, unit = {};  // unit as it is written in the study, "1/s"
    bool isNumber = true;
    bool isLogarithmic = false;  // spread over a factor of 30 or more
    bool follows = false;        // it follows another parameter
    std::string header() const;  // "rate_1_s"
};

// A result of a case, or why there is none.
struct CaseResult {
    Estimate estimate;
    std::string problem;
};

struct SummaryRow {
    const CaseStatus* status;
    std::vector<std::string> texts = {};   // of the parameters
    std::vector<double> numbers = {};      // the same, in their unit; NaN for text
    std::vector<CaseResult> results = {};  // of cases that are done
};

struct Summary {
    std::vector<ParameterColumn> parameters;
    std::vector<std::pair<std::string, const ResultSettings*>> results;
    std::vector<SummaryRow> rows;
};

// Results of cases that are done, by case name, so that their tables are read only once.
using KnownResults = std::map<std::string, std::vector<CaseResult>>;

// The Summary refers to `study` and `cases`. Where a table lacks what a result asks for, `problem` of the result says
// so.
Summary summarise(const StudySettings& study, const std::vector<CaseStatus>& cases,
                  const std::filesystem::path& casesFolder, KnownResults& known);

// One result of one case.
CaseResult resultOf(const ResultSettings& result, const std::filesystem::path& caseDir);

std::string csvText(const Summary& summary, const std::string& title);

}  // namespace corpuscle::study
