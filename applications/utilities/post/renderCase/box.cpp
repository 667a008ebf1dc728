#include "box.hpp"

#include <fmt/format.h>

#include "boundary/wallShape.hpp"
#include "simulation/caseSettings.hpp"
#include "simulation/placesTable.hpp"

namespace corpuscle {

namespace {

// A dictionary as the last run used it, or as it stands in the case; empty if there is none.
std::optional<Node> usedOrWritten(Application& app, bool hasRun, const std::string& dictionary, Problems& problems) {
    if (hasRun && app.hasDictionary("used.yaml")) {
        const Node used = app.dictionary("used.yaml", problems);
        const Node* found = used.find(dictionary);
        return found ? std::optional<Node>(*found) : std::nullopt;
    }
    if (!app.hasDictionary(dictionary)) return std::nullopt;
    return app.dictionary(dictionary, problems);
}

}  // namespace

boundary::Walls readWalls(Application& app, bool hasRun, const particles::Box& box) {
    Problems problems;
    try {
        const std::optional<Node> flow = usedOrWritten(app, hasRun, "constant/flow.yaml", problems);
        const Node* const walls = flow ? flow->find("walls") : nullptr;
        if (!walls) return {};
        const auto shape = readChoice<boundary::WallShape>(*walls, problems);
        problems.throwIfAny();
        if (shape->planesAcross()) return {};
        shape->prepare(app.caseDirectory());
        return shape->place(box);
    } catch (const Failure& fault) {
        app.log().warning("the walls are not drawn: {}", fault.what());
        return {};
    }
}

std::optional<particles::Box> readBox(Application& app, bool hasRun) {
    Problems problems;
    const std::optional<Node> dictionary = usedOrWritten(app, hasRun, "system/mesh.yaml", problems);
    if (!dictionary) return std::nullopt;
    const Node& mesh = *dictionary;
    simulation::DomainSettings domain;
    if (const Node* found = mesh.find("domain"))
        domain = read<simulation::DomainSettings>(*found, problems);
    else if (problems.empty())
        return std::nullopt;
    try {
        problems.throwIfAny();
    } catch (const CaseError& error) {
        app.log().warning("the box is not drawn: {}", error.problems().front().text());
        return std::nullopt;
    }
    return particles::Box{-0.5 * domain.size, 0.5 * domain.size, domain.periodic};
}

PlacesByName readPlacesOfCells(Application& app) {
    const std::string dictionary = "system/mesh.yaml";
    if (!app.hasDictionary(dictionary)) return {};
    Problems problems;
    const Node mesh = app.dictionary(dictionary, problems);
    const Node* const cells = mesh.find("cells");
    PlacesByName found;
    for (std::size_t k = 0; cells && k < cells->items.size(); ++k) {
        const Node& cell = cells->items[k];
        const Node* const name = cell.find("name");
        if (!name) continue;
        std::vector<geometry::Place> places;
        if (const Node* const list = cell.find("places"))
            for (const Node& entry : list->items) {
                const auto place = read<simulation::PlaceSettings>(entry, problems);
                places.push_back({place.centre, place.axis, place.scale});
            }
        if (const Node* const table = cell.find("table"))
            places = simulation::readPlaces(app.caseDirectory(), table->scalar, table->mark,
                                            fmt::format("cells[{}].table", k), problems);
        if (!places.empty()) found[name->scalar] = std::move(places);
    }
    if (problems.empty()) return found;
    try {
        problems.throwIfAny();
    } catch (const CaseError& error) {
        app.log().warning("cells are drawn where their meshes stand: {}", error.problems().front().text());
    }
    return {};
}

}  // namespace corpuscle
