#include "simulation/placesTable.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <fstream>
#include <optional>

#include "core/atomicFile.hpp"
#include "io/checksum.hpp"
#include "io/polyData.hpp"
#include "io/textNumber.hpp"

namespace corpuscle::simulation {

using geometry::Place;

namespace {

constexpr std::size_t numbers = 7;  // x, y, z, axis, scale
constexpr std::array<const char*, numbers> names{"x", "y", "z", "axis_x", "axis_y", "axis_z", "scale"};
constexpr std::size_t scaleAt = 6;

struct Word {
    std::string text;
    int column;  // in its line, 1 and up
};

std::vector<Word> wordsOf(const std::string& line) {
    std::vector<Word> words;
    for (std::size_t begin = 0; begin <= line.size();) {
        const std::size_t end = std::min(line.find(',', begin), line.size());
        const std::size_t first = std::min(line.find_first_not_of(" \t\r", begin), end);
        std::size_t last = end;
        while (last > first && std::isspace(static_cast<unsigned char>(line[last - 1]))) --last;
        words.push_back({line.substr(first, last - first), static_cast<int>(first) + 1});
        begin = end + 1;
    }
    return words;
}

// Which of the numbers (`names`) a column contains, and its unit.
struct Column {
    std::size_t number;
    double unit = 1;
};
std::optional<Column> columnOf(const std::string& name) {
    for (std::size_t k = 0; k < numbers; ++k) {
        if (k >= 3 && name == names[k]) return Column{k};
        if (k >= 3 || !name.starts_with(std::string(names[k]) + "_")) continue;
        for (const auto& [unit, metres] : {std::pair("m", 1.0), {"mm", 1e-3}, {"um", 1e-6}, {"nm", 1e-9}})
            if (name.substr(2) == unit) return Column{k, metres};
    }
    return {};
}

class CsvPlaces {
  public:
    CsvPlaces(std::string file, Problems& problems) : file_(std::move(file)), problems_(problems) {}

    std::vector<Place> read(std::ifstream& text) {
        std::string line;
        for (; std::getline(text, line); ++number_) {
            if (line.find_first_not_of(" \t\r") == std::string::npos || line[line.find_first_not_of(" \t\r")] == '#')
                continue;
            const std::vector<Word> words = wordsOf(line);
            if (!hasHead_)
                readHead(words);
            else
                readRow(words);
        }
        return std::move(places_);
    }
    bool hasHead() const { return hasHead_; }

  private:
    void add(int column, const std::string& key, const std::string& message) {
        problems_.add({file_, number_, column}, key, message);
    }
    void readHead(const std::vector<Word>& words) {
        hasHead_ = true;
        std::array<int, numbers> times{};
        for (const Word& word : words) {
            const std::optional<Column> column = columnOf(word.text);
            columns_.push_back(column);
            if (!column)
                add(word.column, word.text,
                    "unknown column; there are x_um, y_um, z_um (also with _m, _mm, _nm), axis_x, axis_y, axis_z, "
                    "scale." +
                        didYouMean(word.text, {"x_um", "y_um", "z_um", "axis_x", "axis_y", "axis_z", "scale"}));
            else if (++times[column->number] == 2)
                add(word.column, word.text,
                    fmt::format("there are two columns for {}; keep one", names[column->number]));
        }
        const bool hasAxis = times[3] + times[4] + times[5] > 0;
        for (std::size_t k = 0; k < scaleAt; ++k)
            if (times[k] == 0 && (k < 3 || hasAxis))
                add(1, names[k],
                    k < 3 ? fmt::format("missing: the column {}_um, coordinate of the centres", names[k])
                          : fmt::format("missing: the column {}; an axis has three components", names[k]));
        isUsable_ = !problemsSince();
    }
    bool problemsSince() { return problems_.count() > before_; }
    void readRow(const std::vector<Word>& words) {
        if (!isUsable_) return;
        if (words.size() != columns_.size()) {
            add(1, "", fmt::format("found {} values; the first line names {} columns", words.size(), columns_.size()));
            return;
        }
        std::array<double, numbers> values{0, 0, 0, 0, 0, 1, 1};
        bool isRight = true;
        for (std::size_t k = 0; k < words.size(); ++k) {
            const std::optional<double> value = io::textToDouble(words[k].text);
            const Column& column = *columns_[k];
            if (!value || !std::isfinite(*value)) {
                isRight = false;
                add(words[k].column, names[column.number],
                    fmt::format("found '{}'; a finite number is needed", words[k].text));
            } else {
                values[column.number] = *value * column.unit;
            }
        }
        if (!isRight) return;
        Place place{{values[0], values[1], values[2]}, {values[3], values[4], values[5]}, values[scaleAt]};
        if (!(place.axis.norm() > 0)) add(1, "axis_x", "the axis is the zero vector; a direction is needed");
        if (!(place.scale > 0)) add(1, "scale", fmt::format("found {}; greater than 0 is needed", place.scale));
        places_.push_back(place);
    }

    std::string file_;
    Problems& problems_;
    std::size_t before_ = problems_.count();
    int number_ = 1;  // of the line
    bool hasHead_ = false, isUsable_ = false;
    std::vector<std::optional<Column>> columns_;
    std::vector<Place> places_;
};

std::vector<Place> readVtpPlaces(const std::filesystem::path& path) {
    const io::PolyData data = io::readVtp(path);
    const auto axis = data.point.vectors.find("axis");
    const auto scale = data.point.scalars.find("scale");
    std::vector<Place> places(data.points.size());
    for (std::size_t k = 0; k < places.size(); ++k) {
        places[k].centre = data.points[k];
        if (axis != data.point.vectors.end()) places[k].axis = axis->second[k];
        if (scale != data.point.scalars.end()) places[k].scale = scale->second[k];
        if (!(places[k].centre.allFinite() && places[k].axis.allFinite() && places[k].axis.norm() > 0 &&
              places[k].scale > 0 && std::isfinite(places[k].scale)))
            throw Failure(ExitCode::io, fmt::format("{}: point {} is not finite, or has no direction as axis, or no "
                                                    "scale greater than 0",
                                                    path.string(), k));
    }
    return places;
}

}  // namespace

std::vector<Place> readPlaces(const std::filesystem::path& caseDirectory, const std::string& file, const Mark& mark,
                              const std::string& key, Problems& problems) {
    const std::filesystem::path path = caseDirectory / file;
    const std::size_t before = problems.count();
    std::vector<Place> places;
    if (path.extension() == ".vtp") {
        try {
            places = readVtpPlaces(path);
        } catch (const Failure& fault) {
            problems.add(mark, key, fault.what());
        }
    } else if (path.extension() == ".csv") {
        std::ifstream text(path);
        std::error_code ignored;
        if (!text || !std::filesystem::is_regular_file(path, ignored)) {
            problems.add(mark, key,
                         fmt::format("found '{}', and there is no such file in the case. cellPack writes it, where "
                                     "system/pack.yaml says how many cells there are to be",
                                     file));
            return {};
        }
        places = CsvPlaces(file, problems).read(text);
    } else {
        problems.add(mark, key, fmt::format("found '{}'; a file that ends in .csv or .vtp is needed", file));
    }
    if (places.empty() && problems.count() == before)
        problems.add(mark, key,
                     fmt::format("{} has no places; remove the entry, or give it a line for each cell", file));
    return places;
}

void writePlaces(const std::filesystem::path& path, const std::vector<Place>& places) {
    if (path.extension() == ".vtp") {
        io::PolyData data;
        std::vector<Vec3>& axis = data.point.vectors["axis"];
        std::vector<double>& scale = data.point.scalars["scale"];
        for (const Place& place : places)
            data.points.push_back(place.centre), axis.push_back(place.axis), scale.push_back(place.scale);
        return io::writeVtp(path, data);
    }
    std::string text = "x_um,y_um,z_um,axis_x,axis_y,axis_z,scale\n";
    for (const Place& place : places)
        text += fmt::format("{:.12g},{:.12g},{:.12g},{:.12g},{:.12g},{:.12g},{:.12g}\n", place.centre[0] / 1e-6,
                            place.centre[1] / 1e-6, place.centre[2] / 1e-6, place.axis[0], place.axis[1], place.axis[2],
                            place.scale);
    writeFileAtomically(path, text);
}

// The checksum is that of the numbers as text, so that their last digits do not matter.
std::string describePlaces(const std::vector<Place>& places) {
    std::string text;
    const auto add = [&](double number) { text += fmt::format("{:.10g};", number + 0.0); };
    for (const Place& place : places) {
        const Vec3 axis = place.axis.normalized();
        for (int k = 0; k < 3; ++k) add(place.centre[k]);
        for (int k = 0; k < 3; ++k) add(axis[k]);
        add(place.scale);
    }
    return fmt::format("{} places, checksum {:016x}", places.size(), io::checksum(text));
}

}  // namespace corpuscle::simulation
