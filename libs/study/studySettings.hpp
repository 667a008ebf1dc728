// study.yaml: a parameter study. One case for each combination of values, all made from one template.
//
//     template: Ca0.02
//     parameters:
//       Ca: {key: constant/flow.yaml:/Ca, values: [0.02, 0.2, 3]}
//       spacing: {key: system/numerics.yaml:/spacing, values: [0.5 um, 0.4 um]}
//       edge: {key: system/mesh.yaml:/cells/0/edge, values: [0.525 um, 0.42 um], with: spacing}
//     set: [system/control.yaml:/endStrain=6]
//     results:
//       D12: {table: deformation/rbc, column: D12_extent, statistic: mean, from: 4 strain}
#pragma once
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "study/sampling.hpp"
#include "study/statistic.hpp"
#include "study/tableSelection.hpp"

namespace corpuscle::study {

// Values of a parameter: levels, or a range.
struct ParameterSettings {
    std::optional<std::string> key;                  // FILE:/path
    std::optional<std::vector<std::string>> keys;    // several, all set to the same value
    std::optional<std::vector<std::string>> values;  // each is YAML in one line
    std::optional<std::vector<std::string>> range, logRange;
    std::optional<long> count;        // of values in the range
    std::optional<std::string> with;  // the parameter whose choice of level it follows

    std::vector<std::string> allKeys() const;
    // Number of levels; 0: a continuous range.
    std::size_t levels() const;
    // The value for a number in [0, 1) (sampling.hpp), as it is written into the case.
    std::string value(double u) const;
    static const Schema<ParameterSettings>& schema();
};

struct ResultSettings {
    std::string table, column;  // OBSERVER/FILE
    Choice<Statistic> statistic;
    std::optional<std::string> from, to;  // "4 strain", "1 ms"

    std::optional<Moment> first() const, last() const;
    std::string meaning() const;  // "mean of D12_extent of deformation/rbc from 4 strain"
    static const Schema<ResultSettings>& schema();
};

struct StudySettings {
    std::string templateCase, cases;
    std::map<std::string, ParameterSettings> parameters;
    Choice<Sampling> sampling;
    std::vector<std::string> set;                      // FILE:/path=value, in all cases
    std::optional<std::vector<std::string>> programs;  // empty: those that the template needs
    std::optional<long> jobs;                          // empty: cores/ranks
    long ranks = 1;
    std::map<std::string, ResultSettings> results;

    static const Schema<StudySettings>& schema();
};

}  // namespace corpuscle::study
