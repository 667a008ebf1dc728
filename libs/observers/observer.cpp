#include "observers/observer.hpp"

#include <fmt/format.h>

#include "observers/summary.hpp"

namespace corpuscle::observers {

const Schema<ObserverSettings>& ObserverSettings::schema() {
    static const Schema<ObserverSettings> s =
        Schema<ObserverSettings>("observer", "when to look")
            .interval("every", &ObserverSettings::every, "between two looks: strain, time or steps",
                      {.range = positive});
    return s;
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
