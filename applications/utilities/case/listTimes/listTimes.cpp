// listTimes: the times for which a case has results and checkpoints.
//
// The strain at each time is interpolated linearly in the tables of observers, which contain time and strain.
//
// Sample runs:
//     listTimes
//     listTimes -latest -json
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <map>
#include <nlohmann/json.hpp>

#include "core/application.hpp"
#include "core/error.hpp"
#include "core/units.hpp"
#include "io/checkpointFile.hpp"
#include "io/csvSeries.hpp"
#include "io/vtkSeries.hpp"

using namespace corpuscle;
namespace fs = std::filesystem;

namespace {

struct Moment {
    std::vector<std::string> streams;
    std::vector<int> checkpoints;  // their numbers
};

// Times that agree up to rounding are treated as one.
class Moments {
  public:
    Moment& at(double time) {
        const double margin = 1e-9 * std::abs(time);
        const auto near = all_.lower_bound(time - margin);
        return near != all_.end() && near->first <= time + margin ? near->second : all_[time];
    }
    const std::map<double, Moment>& all() const { return all_; }

  private:
    std::map<double, Moment> all_;
};

Moments momentsOf(const fs::path& caseDir) {
    Moments moments;
    std::vector<fs::path> indices;
    if (fs::is_directory(caseDir / "results"))
        for (const auto& entry : fs::directory_iterator(caseDir / "results"))
            if (entry.path().extension() == ".pvd") indices.push_back(entry.path());
    std::sort(indices.begin(), indices.end());
    for (const fs::path& index : indices)
        for (const io::SeriesEntry& entry : io::readPvd(index))
            moments.at(entry.time).streams.push_back(index.stem().string());
    for (const io::CheckpointInfo& checkpoint : io::listCheckpoints(caseDir))
        moments.at(checkpoint.time).checkpoints.push_back(checkpoint.number);
    return moments;
}

// Strain as a function of time, from the table with the most rows.
std::map<double, double> strainsOf(const fs::path& caseDir) {
    std::map<double, double> strains;
    if (!fs::is_directory(caseDir / "postProcessing")) return strains;
    for (const auto& entry : fs::recursive_directory_iterator(caseDir / "postProcessing")) {
        if (entry.path().extension() != ".csv") continue;
        try {
            const io::CsvTable table = io::readCsv(entry.path());
            const std::vector<double> times = table.column("time_s"), strain = table.column("strain");
            std::map<double, double> found;
            for (std::size_t i = 0; i < times.size(); ++i) found[times[i]] = strain[i];
            if (found.size() > strains.size()) strains = std::move(found);
        } catch (const Failure&) {
            continue;  // a table of another kind, without time or strain
        }
    }
    return strains;
}

double strainAt(const std::map<double, double>& strains, double time) {
    const auto above = strains.lower_bound(time);
    if (above != strains.end() && above->first == time) return above->second;
    if (above == strains.begin() || above == strains.end()) {
        const bool isEnd = above == strains.end() && !strains.empty() && time <= strains.rbegin()->first * (1 + 1e-9);
        return isEnd ? strains.rbegin()->second : std::nan("");
    }
    const auto below = std::prev(above);
    return below->second + (time - below->first) / (above->first - below->first) * (above->second - below->second);
}

std::string checkpointsText(const std::vector<int>& numbers) {
    std::string text;
    for (const int number : numbers) text += fmt::format("{}{:06}", text.empty() ? "" : ", ", number);
    return text;
}

}  // namespace

int main(int argc, char* argv[]) {
    Application app(
        "listTimes", "Shows the times of which a case has results and checkpoints.", argc, argv,
        {.options = {{"latest", "", "The last time only."}}, .samples = {"listTimes", "listTimes -latest"}});
    return app.run([&] {
        if (!app.communicator().isRoot()) return ExitCode::done;
        const fs::path caseDir = app.caseDirectory();
        if (!fs::is_directory(caseDir))
            throw Failure(ExitCode::io, fmt::format("{}: there is no such directory.", caseDir.string()));
        const Moments moments = momentsOf(caseDir);
        if (moments.all().empty())
            throw Failure(ExitCode::io,
                          fmt::format("{} has neither results nor checkpoints: run its solver first (is -case "
                                      "right?).",
                                      caseDir.string()));
        const std::map<double, double> strains = strainsOf(caseDir);
        const bool hasStrain =
            std::any_of(strains.begin(), strains.end(), [](const auto& one) { return one.second != 0; });
        nlohmann::ordered_json json = nlohmann::ordered_json::array();
        std::vector<std::vector<std::string>> rows;
        for (auto one = app.has("latest") ? std::prev(moments.all().end()) : moments.all().begin();
             one != moments.all().end(); ++one) {
            const auto& [time, moment] = *one;
            const double strain = hasStrain ? strainAt(strains, time) : std::nan("");
            rows.push_back({formatQuantity(time, unit::second, 9),
                            std::isfinite(strain) ? fmt::format("{:.5g}", strain) : "", joinWords(moment.streams),
                            checkpointsText(moment.checkpoints)});
            json.push_back({{"time_s", time}, {"results", moment.streams}, {"checkpoints", moment.checkpoints}});
            if (std::isfinite(strain)) json.back()["strain"] = strain;
        }
        if (app.json())
            std::cout << json.dump(2) << '\n';
        else
            for (const std::string& line : alignedTable({"time", "strain", "results", "checkpoint"}, rows))
                std::cout << line << '\n';
        return ExitCode::done;
    });
}
