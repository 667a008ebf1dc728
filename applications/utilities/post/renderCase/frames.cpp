#include "frames.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/units.hpp"
#include "interpolation.hpp"
#include "io/vtkSeries.hpp"

namespace corpuscle {
namespace {

namespace fs = std::filesystem;

// Names of the surfaces in files <folder>/<name><extension>.
std::vector<std::string> surfacesIn(const fs::path& folder, const std::string& extension) {
    std::vector<std::string> names;
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(folder, ignored)) {
        const std::string name = entry.path().stem().string();
        if (entry.path().extension() == extension && !name.starts_with('.') && !io::isReservedStream(name))
            names.push_back(name);
    }
    std::sort(names.begin(), names.end());
    return names;
}

// One stream of results. Files are read on demand and kept.
class Stream {
  public:
    Stream(const fs::path& caseDir, const std::string& name) {
        const auto index = caseDir / "results" / (name + ".pvd");
        if (fs::exists(index)) entries_ = io::readPvd(index);
        if (entries_.empty()) entries_ = {{0.0, caseDir / "0" / (name + ".vtp")}};
    }
    int count() const { return static_cast<int>(entries_.size()); }
    int last() const { return count() - 1; }
    double time(int i) const { return entries_[static_cast<std::size_t>(i)].time; }
    const fs::path& file(int i) const { return entries_[static_cast<std::size_t>(i)].file; }
    const io::PolyData& at(int i) {
        const auto found = read_.find(i);
        return found != read_.end() ? found->second : read_[i] = read(i);
    }
    io::PolyData read(int i) const {
        io::PolyData data = file(i).extension() == ".pvtp" ? io::readPvtp(file(i)) : io::readVtp(file(i));
        for (std::size_t p = 0; p < data.points.size(); ++p) {
            if (!data.points[p].allFinite())
                throw Failure(ExitCode::io, fmt::format("{}: point {} has no finite position.", file(i).string(), p));
        }
        return data;
    }
    std::optional<double> field(int i, const std::string& name) {
        const auto& all = at(i).field;
        const auto found = all.find(name);
        return found == all.end() ? std::nullopt : std::optional(found->second);
    }
    // In a flow without a shear rate the strain is 0 at all times, which counts as no strain.
    bool hasStrain() {
        const auto end = field(last(), "strain");
        return end && (*end != 0 || time(last()) == 0);
    }
    std::optional<double> strain(int i) { return hasStrain() ? field(i, "strain") : std::nullopt; }
    std::optional<double> stage(int i) { return field(i, "stage"); }

    int nearestTime(double wanted) const {
        return nearest(wanted, [&](int i) { return time(i); });
    }
    // Values increase with time, so that bisection reads few files.
    template <class Value>
    int nearest(double wanted, Value&& value) const {
        int low = 0, high = last();
        while (high - low > 1) {
            const int middle = (low + high) / 2;
            (value(middle) <= wanted ? low : high) = middle;
        }
        return std::abs(value(low) - wanted) <= std::abs(value(high) - wanted) ? low : high;
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

// Moves each cell of the stream; a surface without the array `cell` counts as one cell.
void moveIntoBox(io::PolyData& surface, const particles::Box& box) {
    const auto numbers = surface.point.integers.find("cell");
    const auto cellOf = [&](std::size_t p) {
        return numbers == surface.point.integers.end() ? std::int64_t{0} : numbers->second[p];
    };
    std::map<std::int64_t, std::pair<Vec3, double>> means;  // sum and number of the cell's points
    for (std::size_t p = 0; p < surface.points.size(); ++p) {
        auto& [sum, count] = means.try_emplace(cellOf(p), Vec3(Vec3::Zero()), 0.0).first->second;
        sum += surface.points[p], ++count;
    }
    const Periodicity periodicity = periodicityOf(surface, box);
    std::map<std::int64_t, Periodicity::Image> images;
    for (const auto& [cell, points] : means) {
        const Vec3 mean = points.first / points.second, there = periodicity.wrap(mean);
        images[cell] = {there - mean, periodicity.slideOf(mean, there)};
    }
    const auto velocity = surface.point.vectors.find("velocity");
    for (std::size_t p = 0; p < surface.points.size(); ++p) {
        const Periodicity::Image& image = images.at(cellOf(p));
        surface.points[p] += image.shift;
        if (velocity != surface.point.vectors.end()) velocity->second[p] += image.slide;
    }
}

// Copies of one mesh at each place, as cells of one stream. Arrays in 0/ describe the stress-free state and are the
// same for each copy.
io::PolyData placed(const io::PolyData& mesh, const std::vector<geometry::Place>& places) {
    io::PolyData all, one = mesh;
    all.field = mesh.field;
    std::int64_t number = 0;
    for (const geometry::Place& place : places) {
        one.points = place.of(mesh.points);
        one.point.integers["cell"].assign(mesh.points.size(), ++number);
        one.cell.integers["cell"].assign(mesh.triangles.size(), number);
        io::append(all, one);
    }
    return all;
}

int entryOf(Stream& stream, Wanted wanted) {
    using Kind = Wanted::Kind;
    const int last = stream.last();
    if (wanted.kind == Kind::first) return 0;
    if (wanted.kind == Kind::latest) return last;
    const bool isProgress = wanted.kind == Kind::progress;
    if (isProgress) wanted.kind = stream.hasStrain() ? Kind::strain : stream.stage(last) ? Kind::stage : Kind::time;
    const bool ofTime = wanted.kind == Kind::time;
    if (ofTime && isProgress && wanted.value != 0)
        throw Failure(ExitCode::usage, fmt::format("{}: has no unit, and these results have neither strain nor stages; "
                                                   "give times with units, between {} and {}.",
                                                   wanted.option, formatQuantity(stream.time(0), unit::second),
                                                   formatQuantity(stream.time(last), unit::second)));
    if (wanted.kind == Kind::strain && !stream.hasStrain()) {
        throw Failure(ExitCode::usage,
                      fmt::format("{}: these results have no strain, since the case has no shear rate; {} instead.",
                                  wanted.option,
                                  stream.stage(last) ? "give -stage"
                                                     : fmt::format("give -time between {} and {}",
                                                                   formatQuantity(stream.time(0), unit::second),
                                                                   formatQuantity(stream.time(last), unit::second))));
    }
    if (wanted.kind == Kind::stage && !stream.stage(last)) {
        throw Failure(ExitCode::usage,
                      fmt::format("{}: these results have no stages; give -time or -strain instead.", wanted.option));
    }
    const auto value = [&](int i) {
        return ofTime ? stream.time(i) : wanted.kind == Kind::strain ? *stream.strain(i) : *stream.stage(i);
    };
    const double from = value(0), to = value(last), slack = 1e-4 * std::abs(to - from) + (ofTime ? 0 : 1e-12);
    if (wanted.value < from - slack || wanted.value > to + slack) {
        const auto words = [&](double v) { return ofTime ? formatQuantity(v, unit::second) : fmt::format("{:g}", v); };
        throw Failure(ExitCode::usage,
                      fmt::format("{}: the results reach from {} to {}.", wanted.option, words(from), words(to)));
    }
    return stream.nearest(wanted.value, value);
}

std::vector<int> chooseTimes(Stream& stream, const FrameChoice& choice) {
    std::vector<int> chosen;
    if (!choice.wanted.empty()) {
        for (const Wanted& wanted : choice.wanted) chosen.push_back(entryOf(stream, wanted));
        return chosen;
    }
    if (choice.count == 0) {
        for (int i = 0; i < stream.count(); ++i) chosen.push_back(i);
        return chosen;
    }
    const double from = stream.time(0), to = stream.time(stream.last());
    for (int i = 0; i < choice.count; ++i) {
        const int next = stream.nearestTime(choice.count == 1 ? to : from + (to - from) * i / (choice.count - 1));
        if (chosen.empty() || chosen.back() != next) chosen.push_back(next);
    }
    return chosen;
}

}  // namespace

Results::Results(const fs::path& caseDir) : caseDir_(caseDir) {
    if (!fs::is_directory(caseDir))
        throw Failure(ExitCode::io, fmt::format("{}: there is no such directory; is -case right?", caseDir.string()));
    surfaces_ = surfacesIn(caseDir / "results", ".pvd");
    hasRun_ = !surfaces_.empty() || fs::exists(caseDir / "results" / "fluid.pvd");
    if (!hasRun_) surfaces_ = surfacesIn(caseDir / "0", ".vtp");
    hasFluid_ = fs::exists(caseDir / "results" / "fluid.pvd") || fs::exists(caseDir / "0" / "fluid.vtp");
    if (surfaces_.empty() && !hasFluid_) {
        throw Failure(ExitCode::io,
                      fmt::format("{}: there is nothing to draw, neither results/*.pvd nor 0/*.vtp; run membraneMesh "
                                  "and particleFill, or membraneRelax, first.",
                                  caseDir.string()));
    }
}

std::vector<Frame> Results::frames(const FrameChoice& choice, const std::optional<particles::Box>& box,
                                   const PlacesByName& places) const {
    std::vector<std::string> names = surfaces_;
    if (!choice.membrane.empty()) {
        if (std::find(names.begin(), names.end(), choice.membrane) == names.end()) {
            throw Failure(ExitCode::usage,
                          fmt::format("-membrane {}: there is no such cell or body; there {}.{}", choice.membrane,
                                      names.empty() ? "are none" : "are: " + joinWords(names),
                                      didYouMean(choice.membrane, names)));
        }
        names = {choice.membrane};
    }
    std::map<std::string, Stream> streams;
    for (const auto& name : names) streams.emplace(name, Stream(caseDir_, name));
    std::optional<Stream> fluid;
    if (names.empty()) fluid.emplace(caseDir_, "fluid");

    std::vector<Frame> frames;
    Stream& leading = names.empty() ? *fluid : streams.at(names.front());
    for (const int i : chooseTimes(leading, choice)) {
        Frame frame;
        frame.time = leading.time(i);
        frame.strain = leading.strain(i);
        frame.stage = leading.stage(i);
        for (auto& [name, stream] : streams) {
            io::PolyData& surface = frame.surfaces[name] = stream.at(stream.nearestTime(frame.time));
            if (!choice.keepBroken) removeBroken(surface);
            if (const auto found = places.find(name); !hasRun_ && found != places.end())
                surface = placed(surface, found->second);
            if (box) moveIntoBox(surface, *box);
        }
        frames.push_back(std::move(frame));
    }
    return frames;
}

io::PolyData Results::fluidAt(double time) const {
    const Stream stream(caseDir_, "fluid");
    return stream.read(stream.nearestTime(time));
}

}  // namespace corpuscle
