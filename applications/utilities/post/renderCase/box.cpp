#include "box.hpp"

#include <fmt/format.h>

#include "simulation/caseSettings.hpp"

namespace corpuscle {

std::optional<particles::Box> readBox(Application& app, bool hasRun) {
    const std::string dictionary = "system/mesh.yaml";
    Problems problems;
    Node mesh;
    if (hasRun && app.hasDictionary("used.yaml")) {
        const Node used = app.dictionary("used.yaml", problems);
        const Node* found = used.find(dictionary);
        if (!found) return std::nullopt;
        mesh = *found;
    } else {
        if (!app.hasDictionary(dictionary)) return std::nullopt;
        mesh = app.dictionary(dictionary, problems);
    }
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

}  // namespace corpuscle
