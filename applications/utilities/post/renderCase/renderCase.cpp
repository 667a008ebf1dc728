// renderCase: pictures of a case's cells, without a display. The sample runs below are its guide.
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cstdio>
#include <sstream>

#include "core/application.hpp"
#include "core/error.hpp"
#include "frames.hpp"
#include "picture.hpp"

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

// "1600" or "1600x500"
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

std::vector<double> parseTimes(const std::string& text) {
    std::vector<double> times;
    std::string word;
    for (std::istringstream words(text); std::getline(words, word, ',');) {
        char* end = nullptr;
        times.push_back(std::strtod(word.c_str(), &end));
        if (word.empty() || *end)
            throw Failure(
                ExitCode::usage,
                fmt::format("-times {}: '{}' is no number; strains are expected (like 0,2,4,6).", text, word));
    }
    return times;
}

Usage usage() {
    return {.options = {{"times", "S,...",
                         "strains to show, the nearest results are taken (default: -count equally spaced)"},
                        {"count", "N", "number of panels without -times (default 4)"},
                        {"field", "NAME", "colour by areaStrain, tension1, ... or none (default)"},
                        {"view", "NAME", "xz, the shear plane (default), xy, yz or iso"},
                        {"size", "WxH", "pixels, or the width alone (default 1600)"},
                        {"membrane", "NAME", "one membrane (default: all)"},
                        {"fluid", "", "also a slab of fluid through the cells' centre, coloured by velocity"},
                        {"output", "FILE", "PNG file (default postProcessing/renderCase.png in the case)"}},
            .samples = {"renderCase -case rbcShear/Ca0.02",
                        "renderCase -times 0,2,4,6 -field areaStrain -output areaStrain.png",
                        "renderCase -view iso -fluid -times 6 -size 900"}};
}

nlohmann::json report(const std::filesystem::path& output, const std::vector<Frame>& frames, const Picture& picture) {
    nlohmann::json panels = nlohmann::json::array();
    for (std::size_t i = 0; i < frames.size(); ++i) {
        const Panel& p = picture.panels[i];
        panels.push_back({{"time", frames[i].time}, {"x", p.x}, {"y", p.y}, {"width", p.width}, {"height", p.height}});
        if (frames[i].strain) panels.back()["strain"] = *frames[i].strain;
    }
    return {{"output", output.string()},
            {"width", picture.width},
            {"height", picture.height},
            {"metresPerPixel", picture.metresPerPixel},
            {"panels", panels}};
}

}  // namespace

int main(int argc, char* argv[]) {
    Application app("renderCase", "Pictures of a case's cells, without a display.", argc, argv, usage());
    return app.run([&] {
        FrameChoice choice;
        choice.membrane = app.value("membrane").value_or("");
        choice.times = parseTimes(app.value("times").value_or(""));
        choice.count = static_cast<int>(app.integer("count", 1).value_or(4));
        choice.fluid = app.has("fluid");
        PictureOptions options;
        options.view = viewNamed(app.value("view").value_or("xz"));
        options.field = app.value("field").value_or("none");
        parseSize(app.value("size").value_or("1600"), options);
        const std::filesystem::path output =
            app.value("output").value_or(app.path("postProcessing/renderCase.png").string());
        if (!app.communicator().isRoot()) return ExitCode::done;

        const std::vector<Frame> frames = readFrames(app.caseDirectory(), choice);
        const Picture picture = drawPicture(frames, options, output);

        if (app.json()) fmt::print("{}\n", report(output, frames, picture).dump(2));
        app.log().info("{}: {} panels, {} x {} pixels", output.string(), frames.size(), picture.width, picture.height);
        return ExitCode::done;
    });
}
