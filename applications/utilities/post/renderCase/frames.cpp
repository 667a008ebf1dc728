#include "frames.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "io/vtkSeries.hpp"

namespace corpuscle {
namespace {

// Names of the files <folder>/<name><extension> that hold membranes.
std::vector<std::string> membranesIn(const std::filesystem::path& folder, const std::string& extension) {
    std::vector<std::string> names;
    std::error_code ignored;
    for (const auto& entry : std::filesystem::directory_iterator(folder, ignored)) {
        const std::string name = entry.path().stem().string();
        if (entry.path().extension() == extension && !io::isReservedStream(name)) names.push_back(name);
    }
    std::sort(names.begin(), names.end());
    return names;
}

// One stream of results; files are read when asked for and kept.
class Stream {
  public:
    Stream(const std::filesystem::path& caseDir, const std::string& name) {
        const auto index = caseDir / "results" / (name + ".pvd");
        if (std::filesystem::exists(index)) entries_ = io::readPvd(index);
        if (entries_.empty()) entries_ = {{0.0, caseDir / "0" / (name + ".vtp")}};
    }
    int count() const { return static_cast<int>(entries_.size()); }
    double time(int i) const { return entries_[static_cast<std::size_t>(i)].time; }
    const io::PolyData& at(int i) {
        const auto& file = entries_[static_cast<std::size_t>(i)].file;
        const auto found = read_.find(i);
        if (found != read_.end()) return found->second;
        return read_[i] = file.extension() == ".pvtp" ? io::readPvtp(file) : io::readVtp(file);
    }
    std::optional<double> field(int i, const std::string& name) {
        const auto& all = at(i).field;
        const auto found = all.find(name);
        return found == all.end() ? std::nullopt : std::optional(found->second);
    }
    std::optional<double> strain(int i) { return field(i, "strain"); }
    // Strain, or time where there is none.
    double progress(int i) { return strain(i).value_or(time(i)); }
    int nearestTime(double wanted) const {
        int best = 0;
        for (int i = 1; i < count(); ++i) {
            if (std::abs(time(i) - wanted) < std::abs(time(best) - wanted)) best = i;
        }
        return best;
    }
    // Progress grows with time, so a bisection reads few files.
    int nearestProgress(double wanted) {
        const int last = count() - 1;
        const double from = progress(0), to = progress(last), slack = 1e-6 * std::abs(to - from) + 1e-12;
        if (wanted < from - slack || wanted > to + slack) {
            throw Failure(ExitCode::usage, fmt::format("-times {:g}: the results reach from {:g} to {:g}{}.", wanted,
                                                       from, to, strain(0) ? "" : " s"));
        }
        int low = 0, high = last;
        while (high - low > 1) {
            const int middle = (low + high) / 2;
            (progress(middle) <= wanted ? low : high) = middle;
        }
        return std::abs(progress(low) - wanted) <= std::abs(progress(high) - wanted) ? low : high;
    }

  private:
    std::vector<io::SeriesEntry> entries_;
    std::map<int, io::PolyData> read_;
};

void removeBroken(io::PolyData& surface) {
    const auto found = surface.cell.integers.find("broken");
    if (found == surface.cell.integers.end()) return;
    const std::vector<std::int64_t> broken = found->second;
    auto keepWhole = [&](auto& values) {
        std::size_t kept = 0;
        for (std::size_t i = 0; i < broken.size(); ++i) {
            if (!broken[i]) values[kept++] = values[i];
        }
        values.resize(kept);
    };
    keepWhole(surface.triangles);
    for (auto& item : surface.cell.scalars) keepWhole(item.second);
    for (auto& item : surface.cell.vectors) keepWhole(item.second);
    for (auto& item : surface.cell.integers) keepWhole(item.second);
}

std::vector<int> chooseTimes(Stream& stream, const FrameChoice& choice) {
    std::vector<int> chosen;
    if (!choice.times.empty()) {
        for (const double wanted : choice.times) chosen.push_back(stream.nearestProgress(wanted));
        return chosen;
    }
    const double from = stream.time(0), to = stream.time(stream.count() - 1);
    for (int i = 0; i < choice.count; ++i) {
        const int next = stream.nearestTime(choice.count == 1 ? to : from + (to - from) * i / (choice.count - 1));
        if (chosen.empty() || chosen.back() != next) chosen.push_back(next);
    }
    return chosen;
}

}  // namespace

std::vector<Frame> readFrames(const std::filesystem::path& caseDir, const FrameChoice& choice) {
    auto names = membranesIn(caseDir / "results", ".pvd");
    if (names.empty()) names = membranesIn(caseDir / "0", ".vtp");
    if (names.empty()) {
        throw Failure(ExitCode::io, fmt::format("{}: there is no membrane in results/ or 0/; run membraneMesh first.",
                                                caseDir.string()));
    }
    if (!choice.membrane.empty()) {
        if (std::find(names.begin(), names.end(), choice.membrane) == names.end()) {
            throw Failure(ExitCode::usage,
                          fmt::format("-membrane {}: there is no such membrane; there are: {}.{}", choice.membrane,
                                      joinWords(names), didYouMean(choice.membrane, names)));
        }
        names = {choice.membrane};
    }

    std::map<std::string, Stream> streams;
    for (const auto& name : names) streams.emplace(name, Stream(caseDir, name));
    std::optional<Stream> fluid;
    if (choice.fluid) fluid.emplace(caseDir, "fluid");

    std::vector<Frame> frames;
    Stream& leading = streams.at(names.front());
    for (const int i : chooseTimes(leading, choice)) {
        Frame frame;
        frame.time = leading.time(i);
        frame.strain = leading.strain(i);
        frame.stage = leading.field(i, "stage");
        for (auto& [name, stream] : streams) {
            frame.surfaces[name] = stream.at(stream.nearestTime(frame.time));
            removeBroken(frame.surfaces[name]);
        }
        if (fluid) frame.fluid = fluid->at(fluid->nearestTime(frame.time));
        frames.push_back(std::move(frame));
    }
    return frames;
}

}  // namespace corpuscle
