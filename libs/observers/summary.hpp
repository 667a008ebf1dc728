// What an observer reports at the end of a run: figures for run.json, lines for the log.
#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace corpuscle::observers {

struct Summary {
    nlohmann::ordered_json figures;
    std::vector<std::string> lines;
};

}  // namespace corpuscle::observers
