#include "simulation/startFiles.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "core/writable.hpp"
#include "io/publish.hpp"
#include "simulation/placesTable.hpp"

namespace corpuscle::simulation {

namespace {

using Settings = std::map<std::string, std::string>;

// A number to ten digits, so that "11 um" and "0.011 mm" are the same; other words as they are.
std::string rounded(const std::string& text) {
    double number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc()) return text;
    return fmt::format("{:.10g}{}", number + 0.0, std::string(end, text.data() + text.size()));  // + 0.0: no "-0"
}

// Adds all settings below a node by their full keys; a list of values is one text.
void flatten(const Node& node, const std::string& key, Settings& settings) {
    if (node.kind == Node::Kind::table) {
        for (const auto& [name, value] : node.entries) flatten(value, fmt::format("{}.{}", key, name), settings);
    } else if (node.kind == Node::Kind::list) {
        std::vector<std::string> values;
        for (const Node& item : node.items) values.push_back(rounded(item.scalar));
        settings[key] = fmt::format("[{}]", joinWords(values));
    } else {
        settings[key] = node.quoted ? node.scalar : rounded(node.scalar);
    }
}

// A cell or rigid body of system/mesh.yaml, with its key there.
struct Surface {
    const SurfaceSettings* settings = nullptr;
    std::string kind, key;  // "cell", "cells[0]"
    explicit operator bool() const { return settings; }
};

Surface surfaceNamed(const Case& input, const std::string& name) {
    const auto find = [&](const auto& all, const char* kind, const char* list) {
        for (std::size_t i = 0; i < all.size(); ++i)
            if (all[i].name == name) return Surface{&all[i], kind, fmt::format("{}[{}]", list, i)};
        return Surface{};
    };
    const Surface cell = find(input.mesh.cells, "cell", "cells");
    return cell ? cell : find(input.mesh.bodies, "body", "bodies");
}

void addSurface(SurfaceSettings surface, const std::string& key, Settings& settings) {
    surface.axis.normalize();
    surface.edgeLength = {surface.edge, false};  // a length in dx has no meaning without the spacing
    flatten(write(surface), key, settings);
    // A file of the same name may hold another surface.
    if (surface.shape->triangulation())
        settings[key + ".shape.file"] +=
            fmt::format(" with {:.10g} m^2 and {:.10g} m^3", surface.shape->area(), surface.shape->volume());
}

// Whether to skip a key: a cell or body that one side lacks altogether is reported once, by its name.
bool isDetailOfMissing(const std::string& key, const Settings& without) {
    const std::size_t end = key.find("].");
    return (key.starts_with("mesh.cells[") || key.starts_with("mesh.bodies[")) && end != std::string::npos &&
           !key.ends_with("].name") && !without.contains(key.substr(0, end) + "].name");
}

void compare(const Case& input, const std::string& name, const Settings& found, Problems& problems) {
    const std::string file = "0/" + name + ".vtp";
    const Surface surface = surfaceNamed(input, name);
    const std::string cure = surface ? "run membraneMesh and particleFill again" : "run particleFill again";
    const Settings wanted = startSettings(input, name);
    if (found.empty()) {
        problems.add({file, 0, 0}, "", "does not say for which settings it was made; " + cure);
        return;
    }
    const auto valueIn = [](const Settings& settings, const std::string& key) {
        const auto at = settings.find(key);
        return at == settings.end() ? std::string("nothing") : at->second;
    };
    Settings all = wanted;
    all.insert(found.begin(), found.end());
    for (const auto& [key, ignored] : all) {
        const std::string here = valueIn(wanted, key), there = valueIn(found, key);
        if (here == there || isDetailOfMissing(key, wanted) || isDetailOfMissing(key, found)) continue;
        const std::size_t dot = key.find('.');
        const std::string dictionary = key.substr(0, dot), below = key.substr(dot + 1);
        const bool ofSurface = dictionary == "cell" || dictionary == "body";
        problems.add({"system/" + (ofSurface ? "mesh" : dictionary) + ".yaml", 0, 0},
                     ofSurface ? surface.key + "." + below : below,
                     fmt::format("the case says {}, but {} was made for {}; {}", here, file, there, cure));
    }
}

}  // namespace

std::filesystem::path startFile(const Case& input, const std::string& name) {
    return input.directory / "0" / (name + ".vtp");
}

std::map<std::string, std::string> startSettings(const Case& input, const std::string& name) {
    Settings settings;
    if (const Surface surface = surfaceNamed(input, name)) {
        addSurface(*surface.settings, surface.kind, settings);
        settings.erase(surface.kind + ".name");
        return settings;
    }
    const MeshSettings& mesh = input.mesh;
    const Node fill = write(mesh.fill), numerics = write(input.numerics);
    flatten(write(mesh.domain), "mesh.domain", settings);
    for (std::size_t i = 0; i < mesh.cells.size(); ++i) {
        addSurface(mesh.cells[i], fmt::format("mesh.cells[{}]", i), settings);
        if (mesh.cells[i].isPlacedByList())
            settings[fmt::format("mesh.cells[{}].places", i)] = describePlaces(mesh.cells[i].placed);
    }
    for (std::size_t i = 0; i < mesh.bodies.size(); ++i)
        addSurface(mesh.bodies[i], fmt::format("mesh.bodies[{}]", i), settings);
    flatten(*fill.find("jitter"), "mesh.fill.jitter", settings);
    if (*mesh.fill.jitter > 0) flatten(*fill.find("seed"), "mesh.fill.seed", settings);
    flatten(*numerics.find("spacing"), "numerics.spacing", settings);
    if (!mesh.cells.empty()) flatten(*numerics.find("coupling"), "numerics.coupling", settings);
    const bool relaxed = !mesh.cells.empty() && !input.numerics.isImmersed();
    if (relaxed) flatten(*fill.find("relaxation"), "mesh.fill.relaxation", settings);
    if (relaxed && mesh.fill.relaxation > 0) {  // the kernel evens out the particles
        settings["numerics.kernel.type"] = input.numerics.kernel.name;
        settings["numerics.kernel.support"] = fmt::format("{:.10g} dx", input.support() / input.spacing());
    } else if (input.wallLayers() > 0) {
        settings["numerics.kernel.support"] = fmt::format("{} layers of wall particles", input.wallLayers());
    }
    return settings;
}

void requireStartWritable(const Communicator& communicator, const Case& input) {
    std::vector<std::filesystem::path> files{io::temporaryName(startFile(input, "fluid"))};
    for (const CellSettings& cell : input.mesh.cells) files.push_back(io::temporaryName(startFile(input, cell.name)));
    for (const BodyPlaceSettings& body : input.mesh.bodies)
        files.push_back(io::temporaryName(startFile(input, body.name)));
    requireWritable(communicator, files);
}

void writeStart(const Case& input, const std::string& name, io::PolyData data) {
    const std::filesystem::path file = startFile(input, name);
    io::makeFolder(file.parent_path());
    data.field = {{"TimeValue", 0}, {"strain", 0}};
    data.texts = startSettings(input, name);
    io::writeVtp(file, data);
}

io::PolyData readStart(const Case& input, const std::string& name) {
    const std::filesystem::path file = startFile(input, name);
    const std::string writer = surfaceNamed(input, name) ? "membraneMesh" : "particleFill";
    if (!std::filesystem::exists(file))
        throw Failure(ExitCode::io, file.string() + " is missing: run " + writer + " first");
    io::PolyData data = io::readVtp(file);
    if (surfaceNamed(input, name) && data.triangles.empty())
        throw Failure(ExitCode::io, file.string() + " holds no triangles: run " + writer + " again");
    if (!data.verified && !data.texts.empty())
        throw Failure(ExitCode::io,
                      file.string() +
                          " has no checksum: it was written by another program, or by an earlier version; run " +
                          writer + " again");
    Problems problems;
    compare(input, name, data.texts, problems);
    input.throwIfAny(problems);
    return data;
}

}  // namespace corpuscle::simulation
