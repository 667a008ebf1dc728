#include "membrane/aspiration.hpp"

#include <algorithm>

#include "core/registry.hpp"
#include "core/units.hpp"

namespace corpuscle::membrane {

const Schema<Aspiration>& Aspiration::schema() {
    static const Schema<Aspiration> s =
        Schema<Aspiration>("aspiration", "a micropipette along z that sucks the membrane in")
            .quantities("pressures", &Aspiration::pressures, unit::pascal, "suction, one stage each",
                        {.range = positive})
            .quantity("radius", &Aspiration::radius, unit::metre, "inner radius of the pipette", {.range = positive})
            .quantity("wall", &Aspiration::wall, unit::metre, "thickness of its wall, whose end is round",
                      {.range = positive})
            .quantity("softness", &Aspiration::softness, unit::metre,
                      "how deep nodes lie in the glass at the largest suction; a fiftieth of the radius when absent",
                      {.range = positive})
            .check([](const Aspiration& p, const Node& node, Problems& problems) {
                if (p.pressures.empty()) {
                    problems.add(node.mark, node.path, "found no stage; 'pressures' needs at least one value");
                }
                if (p.softness && *p.softness > 0.25 * p.wall) {
                    const Node* at = node.find("softness");
                    problems.add(at->mark, at->path,
                                 "found " + formatQuantity(*p.softness, unit::metre) +
                                     ", which lets nodes through the glass; at most a quarter of the wall, " +
                                     formatQuantity(0.25 * p.wall, unit::metre));
                }
            });
    return s;
}

Pipette Aspiration::pipette(const Membrane& membrane) const {
    const double mouth = Pipette::touching(membrane.initialPosition(), radius, wall);
    if (!std::isfinite(mouth)) {
        throw Failure(ExitCode::invalidCase,
                      "the membrane '" + membrane.name + "' has no node under the wall of a pipette of radius " +
                          formatQuantity(radius, unit::metre) + " and wall " + formatQuantity(wall, unit::metre) +
                          ": it would be swallowed whole, or its mesh is too coarse; take a smaller radius, a thicker "
                          "wall or a finer edge in system/relax.yaml");
    }
    if (const double edge = membrane.network().meanBondLength(); wall < edge) {
        throw Failure(ExitCode::invalidCase, "a pipette's wall of " + formatQuantity(wall, unit::metre) +
                                                 " slips between the nodes of '" + membrane.name + "', " +
                                                 formatQuantity(edge, unit::metre) +
                                                 " apart: take a thicker wall or a finer edge in system/relax.yaml");
    }
    return {.radius = radius,
            .wall = wall,
            .mouth = mouth,
            .contactPressure = *std::max_element(pressures.begin(), pressures.end()),
            .depth = softness.value_or(std::min(radius / 50, wall / 4))};
}

Loads Aspiration::apply(int stage, Membrane& membrane) const {
    const Network& network = membrane.network();
    const Pipette glass = pipette(membrane);
    Loads loads;
    loads.longestStep = 0.25 * wall;
    loads.terms.push_back(pipetteContact(network, glass));
    loads.terms.push_back(
        pipetteSuction(network, membrane.initialPosition(), glass, pressures[static_cast<std::size_t>(stage)]));
    if (network.isOpen()) {
        for (const char atBorder : borderNodes(network)) {
            loads.held.push_back({false, false, atBorder != 0});
        }
    }
    return loads;
}

std::string Aspiration::describe(int stage) const {
    return formatQuantity(pressures[static_cast<std::size_t>(stage)], unit::pascal);
}

std::vector<Protocol::Column> Aspiration::columns() const {
    return {{"suction", "Pa", "pressure outside less that in the pipette"},
            {"length", "m", "length of the tongue, from the mouth of the pipette to its tip"},
            {"lengthOverRadius", "", "this length over the inner radius of the pipette"}};
}

std::vector<double> Aspiration::measure(int stage, const Membrane& membrane) const {
    const Pipette glass = pipette(membrane);
    const auto& x = membrane.position;
    for (const Bond& bond : membrane.network().bonds()) {
        if (glass.crosses(x[bond.node[0]], x[bond.node[1]])) {
            throw Failure(ExitCode::numerics, "the membrane went through the wall of the pipette at " +
                                                  describe(stage) +
                                                  ": take smaller steps between the pressures, or a thicker wall");
        }
    }
    double top = glass.mouth;
    for (const Vec3& p : x) {
        top = glass.isInside(p) ? std::max(top, p[2]) : top;
    }
    const double length = top - glass.mouth;
    return {pressures[static_cast<std::size_t>(stage)], length, length / radius};
}

CORPUSCLE_REGISTER(Protocol, Aspiration, "aspiration", "a micropipette that sucks the membrane in");

}  // namespace corpuscle::membrane
