// renderCase: pictures of a case's cells and fluid, without a display. The sample runs below are its guide.
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdio>
#include <sstream>

#include "box.hpp"
#include "core/application.hpp"
#include "core/error.hpp"
#include "frames.hpp"
#include "movie.hpp"
#include "picture.hpp"
#include "planes.hpp"

using namespace corpuscle;

namespace {

const View& viewNamed(const std::string& name) {
    std::vector<std::string> names;
    for (const View& view : views()) {
        if (view.name == name) return view;
        names.push_back(view.name);
    }
    throw Failure(ExitCode::usage, fmt::format("-view {}: there is no such view; there are: {}.{}", name,
                                               joinWords(names), didYouMean(name, names)));
}

// Reads "1600" or "1600x500".
void parseSize(const std::string& text, PictureOptions& options) {
    char end = 0;
    const int read = std::sscanf(text.c_str(), "%dx%d%c", &options.width, &options.height, &end);
    const bool good =
        (read == 2 || (read == 1 && text.find('x') == std::string::npos)) && options.width > 0 && options.height >= 0;
    if (!good || options.width > 10000 || options.height > 10000) {
        throw Failure(
            ExitCode::usage,
            fmt::format("-size {}: WIDTH or WIDTHxHEIGHT in pixels is expected, at most 10000 each (like 1600x500).",
                        text));
    }
}

std::vector<std::string> itemsOf(const std::string& text) {
    std::vector<std::string> items;
    std::string item;
    for (std::istringstream all(text); std::getline(all, item, ',');) {
        item.erase(0, item.find_first_not_of(' '));
        item.erase(item.find_last_not_of(' ') + 1);
        items.push_back(item);
    }
    return items;
}

// Reads one item of -time, -strain, -stage or -times.
Wanted parseWanted(const std::string& option, Wanted::Kind kind, const std::string& item) {
    using Kind = Wanted::Kind;
    Wanted wanted{kind, 0, fmt::format("{} {}", option, item)};
    if (item == "first" || item == "latest") {
        wanted.kind = item == "first" ? Kind::first : Kind::latest;
        return wanted;
    }
    const bool ofTime = kind == Kind::time;
    const auto expected = [&](const std::string& reason) {
        const char* what = ofTime                 ? "times with units (like '2 ms, 4 ms')"
                           : kind == Kind::strain ? "strains (like 0,2,4,6)"
                           : kind == Kind::stage  ? "numbers of stages (like 0,3,6)"
                                                  : "strains (like 0,2,4,6) or times with units (like '2 ms, 4 ms')";
        return Failure(ExitCode::usage,
                       fmt::format("{}: {}; {}, 'first' or 'latest' are expected.", wanted.option, reason, what));
    };
    Quantity quantity;
    try {
        quantity = parseQuantity(item);
    } catch (const std::invalid_argument& error) {
        throw expected(error.what());
    }
    wanted.value = quantity.value;
    if (quantity.hasUnit && quantity.dimension != unit::second) throw expected(fmt::format("'{}' is no time", item));
    if (quantity.hasUnit && kind != Kind::time && kind != Kind::progress)
        throw expected(fmt::format("'{}' has a unit", item));
    if (!quantity.hasUnit && ofTime && quantity.value != 0) throw expected(fmt::format("'{}' has no unit", item));
    if (!std::isfinite(wanted.value)) throw expected(fmt::format("'{}' is not finite", item));
    if (quantity.hasUnit) wanted.kind = Kind::time;
    return wanted;
}

// Whether each time has a picture of its own, as a file or as part of a movie.
bool isSeries(const Application& app) { return app.has("series") || app.has("movie"); }

FrameChoice choiceOf(const Application& app) {
    using Kind = Wanted::Kind;
    FrameChoice choice;
    choice.membrane = app.value("membrane").value_or("");
    std::vector<std::string> given;
    const std::pair<const char*, Kind> lists[] = {
        {"time", Kind::time}, {"strain", Kind::strain}, {"stage", Kind::stage}, {"times", Kind::progress}};
    for (const auto& [name, kind] : lists) {
        const auto text = app.value(name);
        if (!text) continue;
        const std::string option = std::string("-") + name;
        given.push_back(option);
        for (const std::string& item : itemsOf(*text)) choice.wanted.push_back(parseWanted(option, kind, item));
        if (choice.wanted.empty()) throw Failure(ExitCode::usage, option + ": nothing is given.");
    }
    if (app.has("count")) given.emplace_back("-count");
    if (given.size() > 1)
        throw Failure(ExitCode::usage, fmt::format("{} are given; one of them is enough.", joinWords(given, " and ")));
    choice.count = static_cast<int>(app.integer("count", 1).value_or(isSeries(app) ? 0 : 4));
    return choice;
}

// The planes of fluid, cut and seeds. `fluid`: a plane of fluid is shown.
AskedPlanes planesOf(const Application& app, bool fluid, const View& view) {
    AskedPlanes asked{fluid, view.sliceAxis, {}, {}, {}, 0};
    const std::pair<const char*, std::optional<AskedPlane>*> planes[] = {
        {"slice", &asked.slice}, {"cut", &asked.cut}, {"seeds", &asked.seeds}};
    for (const auto& [name, plane] : planes)
        if (const auto text = app.value(name)) *plane = parsePlane(std::string("-") + name, *text);
    constexpr long mostLines = 1000;
    const long count = app.integer("streamlines", 1).value_or(0);
    if (count > mostLines)
        throw Failure(ExitCode::usage, fmt::format("-streamlines {}: at most {} lines are drawn.", count, mostLines));
    if (asked.seeds && count == 0) throw Failure(ExitCode::usage, "-seeds: of how many lines? Give -streamlines too.");
    asked.streamlines = static_cast<int>(count);
    return asked;
}

// Adds the fluid in a plane and streamlines to each frame.
void addFluid(const Results& results, const PictureOptions& options, const Planes& planes, std::vector<Frame>& frames) {
    if (!planes.slice && !planes.seeds) return;
    for (Frame& frame : frames) {
        const io::PolyData fluid = results.fluidAt(frame.time);
        if (planes.slice)
            frame.slice = sampleSlice(fluid, options.box, *planes.slice, options.fluidField, options.arrows);
        if (planes.seeds)
            frame.streamlines = streamlinesOf(fluid, options.box, options.walls, *planes.seeds, options.fluidField);
    }
}

// Whether a plane of fluid is shown. Throws Failure(usage) where there is no fluid, or nothing to cut.
bool showsSlice(const Application& app, const Results& results, const PictureOptions& options) {
    bool sliced = false;
    for (const char* option : {"fluid", "slice", "arrows"}) sliced = sliced || app.has(option);
    const bool lines = app.has("streamlines");
    if (!lines) {
        sliced = sliced || results.surfaces().empty();
        for (const char* option : {"fluidField", "fluidRange"}) sliced = sliced || app.has(option);
    }
    if ((sliced || lines) && !results.hasFluid())
        throw Failure(ExitCode::usage, fmt::format("{}: the case has no fluid, neither results/fluid.pvd nor "
                                                   "0/fluid.vtp.",
                                                   sliced ? "-fluid" : "-streamlines"));
    if (app.has("cut") && results.surfaces().empty() && !options.walls.exist())
        throw Failure(ExitCode::usage, "-cut: the case has neither cells nor bodies nor a vessel to cut.");
    return sliced;
}

PictureOptions optionsOf(const Application& app) {
    PictureOptions options;
    options.view = viewNamed(app.value("view").value_or("tilted"));
    options.field = app.value("field").value_or("none");
    options.fluidField = app.value("fluidField").value_or(app.has("streamlines") ? "speed" : "u");
    if (const auto text = app.value("range")) options.fieldRange = parseRange("-range", *text);
    if (const auto text = app.value("fluidRange")) options.fluidRange = parseRange("-fluidRange", *text);
    if (options.fieldRange && options.field == "none")
        throw Failure(ExitCode::usage, "-range: of which array? Give -field too.");
    options.arrows = app.has("arrows");
    options.mesh = app.has("mesh");
    options.labelTime = app.has("time");
    const std::string frame = app.value("frame").value_or("box");
    const std::vector<std::string> frames{"box", "cells"};
    if (frame != "box" && frame != "cells")
        throw Failure(ExitCode::usage, fmt::format("-frame {}: there is no such frame; there are: {}.{}", frame,
                                                   joinWords(frames), didYouMean(frame, frames)));
    options.frameCells = frame == "cells";
    if (const auto size = app.value("size")) parseSize(*size, options);
    return options;
}

Usage usage() {
    return {
        .options = {{"time", "T,...",
                     "times to show, with units ('2 ms, 4 ms', first, latest); the nearest results are taken"},
                    {"strain", "S,...", "strains to show (0,2,4,6, first, latest)"},
                    {"stage", "N,...", "stages of membraneRelax to show"},
                    {"times", "S,...", "strains, or stages, as numbers; times with units"},
                    {"count", "N", "number of panels at equal distances without these four (default 4)"},
                    {"field", "NAME",
                     "colour by an array: areaStrain, tension1, stretch, broken, hole, id, ... or none (default)"},
                    {"range", "LOW,HIGH", "of its colours, in SI or with a unit (default: of all panels)"},
                    {"view", "NAME", "tilted, in perspective (default); xz, the shear plane; xy, yz, iso"},
                    {"frame", "NAME", "box: the whole box (default), or cells: as far as these reach, without the box"},
                    {"mesh", "", "draw the edges of the triangles"},
                    {"membrane", "NAME", "one cell or body (default: all)"},
                    {"cut", "AXIS[=POS]", "removes what lies in front of that plane from cells, bodies and walls"},
                    {"fluid", "", "also the fluid in a plane, interpolated from its particles"},
                    {"slice", "AXIS[=POS]", "that plane (default: the shear plane through the cells; 'y=2 um')"},
                    {"streamlines", "N", "N lines along the velocity at that time (not the paths of particles)"},
                    {"seeds", "AXIS[=POS]", "the section from which they start (default: x, at a periodic face)"},
                    {"fluidField", "NAME",
                     "u, v, w, speed, pressure, ...: what plane (default u) and lines (speed) show"},
                    {"fluidRange", "LOW,HIGH", "of its colours"},
                    {"arrows", "", "velocity in that plane"},
                    {"series", "", "a file for each time, with the same camera and colours (default: all times)"},
                    {"movie", "FILE", "the same as a movie: an MP4 file, by ffmpeg"},
                    {"fps", "N", "pictures of it in a second (default 10)"},
                    {"size", "WxH", "pixels, or the width alone (default: by the number of panels, at most 1600)"},
                    {"output", "FILE", "PNG file (default postProcessing/renderCase.png in the case)"}},
        .samples = {"renderCase -case rbcShear/Ca0.02",
                    "renderCase -strain 0,2,4,6 -field areaStrain -output areaStrain.png",
                    "renderCase -time '2 ms, latest' -fluid -arrows", "renderCase -view xz -frame cells -mesh",
                    "renderCase -series -fluid -fluidField pressure -output film/frame.png",
                    "renderCase -streamlines 30 -cut y -strain latest",
                    "renderCase -movie postProcessing/cell.mp4 -fluid -view xz"}};
}

nlohmann::json jsonOf(const Scale& scale) {
    return {{"title", scale.title}, {"low", scale.range.low}, {"high", scale.range.high}};
}

nlohmann::json jsonOf(const Plane& plane) { return {{"axis", plane.axisName()}, {"position", plane.position}}; }

// Positions are contiguous across periodic faces.
nlohmann::json jsonOf(const Streamline& line) {
    const auto list = [](const Vec3& x) { return nlohmann::json{x[0], x[1], x[2]}; };
    Vec3 low = line.points.front(), high = low;
    for (const Vec3& x : line.points) low = low.cwiseMin(x), high = high.cwiseMax(x);
    return {{"seed", list(line.points[line.seed])},
            {"from", list(line.points.front())},
            {"to", list(line.points.back())},
            {"low", list(low)},
            {"high", list(high)},
            {"length", line.length()},
            {"upstream", line.upstream ? nameOf(*line.upstream) : "seed"},
            {"downstream", nameOf(line.downstream)}};
}

nlohmann::json report(const std::filesystem::path& output, std::span<const Frame> frames, const Plan& plan,
                      const Picture& picture) {
    nlohmann::json panels = nlohmann::json::array(), places = nlohmann::json::array();
    for (std::size_t i = 0; i < frames.size(); ++i) {
        const Panel& p = picture.panels[i];
        panels.push_back({{"time", frames[i].time}, {"x", p.x}, {"y", p.y}, {"width", p.width}, {"height", p.height}});
        if (frames[i].strain) panels.back()["strain"] = *frames[i].strain;
        for (const DrawnLine& line : frames[i].streamlines) panels.back()["streamlines"].push_back(jsonOf(line.course));
    }
    for (const Place& p : picture.places)
        places.push_back({{"what", p.what},
                          {"x", p.x},
                          {"y", picture.height - p.y - p.height},
                          {"width", p.width},
                          {"height", p.height}});
    nlohmann::json all{{"output", output.string()}, {"width", picture.width},
                       {"height", picture.height},  {"metresPerPixel", picture.metresPerPixel},
                       {"panels", panels},          {"places", places}};
    if (plan.field) all["field"] = jsonOf(*plan.field);
    if (plan.fluid) {
        all["fluid"] = jsonOf(*plan.fluid);
        if (frames.front().slice) all["fluid"].update(jsonOf(frames.front().slice->plane));
    }
    if (plan.cut) {
        all["cut"] = jsonOf(plan.cut->plane);
        all["cut"]["removed"] = plan.cut->removesUpper ? "above" : "below";
    }
    return all;
}

std::filesystem::path numbered(const std::filesystem::path& output, std::size_t i) {
    return output.parent_path() / fmt::format("{}_{:04}.png", output.stem().string(), i);
}

}  // namespace

int main(int argc, char* argv[]) {
    Application app("renderCase", "Pictures of a case's cells and fluid, without a display.", argc, argv, usage());
    return app.run([&] {
        // 1. What the user asks for.
        FrameChoice choice = choiceOf(app);
        PictureOptions options = optionsOf(app);
        choice.keepBroken = options.field == "broken";
        const std::filesystem::path output =
            app.value("output").value_or(app.path("postProcessing/renderCase.png").string());
        if (app.has("movie") && (app.has("output") || app.has("series")))
            throw Failure(ExitCode::usage, "-movie names its file; -output and -series are for pictures.");
        if (app.has("fps") && !app.has("movie"))
            throw Failure(ExitCode::usage, "-fps: of which movie? Give -movie too.");
        std::optional<Movie> movie;
        if (app.has("movie") && app.communicator().isRoot())
            movie.emplace(*app.value("movie"), app.integer("fps", 1).value_or(10));
        if (output.extension() != ".png")
            throw Failure(ExitCode::usage,
                          fmt::format("-output {}: a PNG file is written; its name ends in .png.", output.string()));

        // 2. What the case has.
        const Results results(app.caseDirectory());
        options.box = readBox(app, results.hasRun());
        if (options.box) {
            options.walls = readWalls(app, results.hasRun(), *options.box);
            if (!options.walls.exist()) options.view = turnedForWalls(options.view, options.box->periodic);
        }
        const PlacesByName places = results.hasRun() ? PlacesByName() : readPlacesOfCells(app);
        if (!app.communicator().isRoot()) return ExitCode::done;
        std::vector<Frame> frames = results.frames(choice, options.box, places);
        const bool sliced = showsSlice(app, results, options);
        const Planes planes = placePlanes(planesOf(app, sliced, options.view), frames, options.box);
        options.cut = planes.cut;
        addFluid(results, options, planes, frames);

        // 3. One picture for all times, or one for each time.
        const Plan plan = makePlan(frames, options);
        const std::size_t each = isSeries(app) ? 1 : frames.size();
        nlohmann::json reports = nlohmann::json::array();
        for (std::size_t i = 0; i < frames.size(); i += each) {
            const auto file = movie ? movie->picture(i) : app.has("series") ? numbered(output, i) : output;
            const std::span<const Frame> shown(frames.data() + i, each);
            const Picture picture = drawPicture(plan, shown, file);
            reports.push_back(report(movie ? *app.value("movie") : file.string(), shown, plan, picture));
            if (!movie)
                app.log().info("{}: {} panel{}, {} x {} pixels", file.string(), each, each == 1 ? "" : "s",
                               picture.width, picture.height);
            else if (i == 0)
                app.log().info("{} pictures of {} x {} pixels", frames.size(), picture.width, picture.height);
        }
        if (movie) {
            movie->write();
            app.log().info(
                "{}: {} pictures, {:.3g} s", *app.value("movie"), frames.size(),
                static_cast<double>(frames.size()) / static_cast<double>(app.integer("fps", 1).value_or(10)));
        }
        if (app.json()) fmt::print("{}\n", (isSeries(app) ? reports : reports[0]).dump(2));
        return ExitCode::done;
    });
}
