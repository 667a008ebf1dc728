#include "membrane/inflation.hpp"

#include "core/registry.hpp"
#include "core/units.hpp"
#include "membrane/surface.hpp"

namespace corpuscle::membrane {

const Schema<Inflation>& Inflation::schema() {
    static const Schema<Inflation> s =
        Schema<Inflation>("inflation", "a pressure difference over a closed membrane")
            .quantities("pressures", &Inflation::pressures, unit::pascal, "inside over outside, one stage each")
            .check([](const Inflation& p, const Node& node, Problems& problems) {
                if (p.pressures.empty()) {
                    problems.add(node.mark, node.path, "found no stage; 'pressures' needs at least one value");
                }
            });
    return s;
}

Loads Inflation::apply(int stage, Membrane&) const {
    Loads loads;
    loads.pressure = pressures[static_cast<std::size_t>(stage)];
    return loads;
}

std::string Inflation::describe(int stage) const {
    return formatQuantity(pressures[static_cast<std::size_t>(stage)], unit::pascal);
}

std::vector<Protocol::Column> Inflation::columns() const {
    return {{"pressure", "Pa", "pressure inside less that outside"},
            {"radius", "m", "radius of the sphere of the enclosed volume"},
            {"stretch", "", "this radius over that of the stress-free volume"}};
}

std::vector<double> Inflation::measure(int stage, const Membrane& membrane) const {
    const double radius = radiusOfSphere(membrane.volume());
    return {pressures[static_cast<std::size_t>(stage)], radius,
            radius / radiusOfSphere(enclosedVolume(membrane.network().stressFree(), membrane.network().triangles()))};
}

CORPUSCLE_REGISTER(Protocol, Inflation, "inflation", "a pressure difference over a closed membrane");

}  // namespace corpuscle::membrane
