#include "observers/observer.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "observers/summary.hpp"

namespace corpuscle::observers {

const Schema<ObserverSettings>& ObserverSettings::schema() {
    static const Schema<ObserverSettings> s =
        Schema<ObserverSettings>("observer", "when to look")
            .interval("every", &ObserverSettings::every, "between two looks: strain, time or steps",
                      {.range = positive});
    return s;
}

const std::vector<io::Column>& timeColumns() {
    static const std::vector<io::Column> columns{
        {"time", "s", "time since the start of the flow"},
        {"strain", "", "shear since the start of the flow; 0 in a flow without a shear rate"}};
    return columns;
}

void addVector(std::vector<io::Column>& columns, const std::string& name, const std::string& unit,
               const std::string& meaning) {
    for (const char component : {'x', 'y', 'z'})
        columns.push_back({fmt::format("{}_{}", name, component), unit, fmt::format("{} {}", component, meaning)});
}

SceneParts SceneParts::of(const Scene& scene) {
    SceneParts parts;
    for (const coupling::CellType& type : scene.cells.types()) {
        parts.cells.push_back(type.name);
        parts.viscousMembranes = parts.viscousMembranes || type.settings.viscosity.has_value();
        parts.rupture = parts.rupture || static_cast<bool>(type.settings.rupture);
    }
    if (scene.bodies)
        for (const bodies::Body& body : scene.bodies->all()) {
            parts.bodies.push_back(body.name);
            parts.givenBodies = parts.givenBodies || !body.behaviour->yields();
        }
    for (const boundary::Wall& wall : scene.flow.walls) parts.walls.push_back(wall.name);
    parts.shear = scene.flow.shearRate != 0;
    parts.bodyForce = !scene.flow.bodyForce.isZero();
    parts.budget = scene.budget.kept;
    parts.slidingImages = scene.system->periodicity().slides();
    parts.conductance = scene.flow.conductance.has_value();
    return parts;
}

SceneParts SceneParts::all() {
    return {{"<cell>"}, {"<body>"}, {"<wall>"}, true, true, true, true, true, true, true, true};
}

std::optional<Summary> Observation::summary(const Scene&, const Time&) { return {}; }

void Observation::restore(std::span<const double> saved) {
    const std::size_t expected = state().size();
    if (saved.size() != expected)
        throw Failure(
            ExitCode::io,
            fmt::format("the checkpoint holds {} numbers of this observer, {} are expected; it belongs to other "
                        "cells. Remove the observer, or start from the case's first time",
                        saved.size(), expected));
    setState(saved);
}

std::string Observer::needsCells(const Subject& subject) {
    if (subject.cells) return {};
    return "this observer looks at cells, and the case has none; remove it, or give cells in system/mesh.yaml";
}

}  // namespace corpuscle::observers
