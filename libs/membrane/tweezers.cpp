#include "membrane/tweezers.hpp"

#include <utility>

#include "core/registry.hpp"
#include "core/units.hpp"
#include "membrane/diagnostics.hpp"

namespace corpuscle::membrane {

namespace {

double extent(const std::vector<Vec3>& x, int axis) {
    const auto [low, high] =
        std::minmax_element(x.begin(), x.end(), [&](const Vec3& a, const Vec3& b) { return a[axis] < b[axis]; });
    return (*high)[axis] - (*low)[axis];
}

}  // namespace

const Schema<Tweezers>& Tweezers::schema() {
    static const Schema<Tweezers> s =
        Schema<Tweezers>("tweezers", "two beads pulled apart along x, at opposite ends of the cell")
            .quantities("forces", &Tweezers::forces, unit::newton, "on each bead, one stage each",
                        {.range = atLeast(0)})
            .quantity("contact", &Tweezers::contact, unit::metre, "diameter of a bead's contact area",
                      {.fallback = "2 um", .range = positive})
            .check([](const Tweezers& p, const Node& node, Problems& problems) {
                if (p.forces.empty()) {
                    problems.add(node.mark, node.path, "found no stage; 'forces' needs at least one value");
                }
            });
    return s;
}

Loads Tweezers::apply(int stage, Membrane& membrane) const {
    const Network& network = membrane.network();
    const std::vector<Vec3>& rest = membrane.initialPosition();
    const std::vector<double> area = vertexAreas(network, rest);
    Loads loads;
    loads.force.assign(rest.size(), Vec3::Zero());
    const auto [left, right] =
        std::minmax_element(rest.begin(), rest.end(), [](const Vec3& a, const Vec3& b) { return a[0] < b[0]; });
    std::vector<char> loaded(rest.size(), 0);
    for (const auto& [end, sign] : {std::pair{*left, -1.0}, {*right, 1.0}}) {
        double total = 0;
        const auto touches = [&, &pole = end](std::size_t n) { return (rest[n] - pole).norm() <= 0.5 * contact; };
        for (std::size_t n = 0; n < rest.size(); ++n) {
            total += touches(n) ? area[n] : 0;
        }
        for (std::size_t n = 0; n < rest.size(); ++n) {
            if (!touches(n)) {
                continue;
            }
            if (std::exchange(loaded[n], 1)) {
                throw Failure(ExitCode::invalidCase,
                              "the contact areas of the two beads meet: take a smaller 'contact' than " +
                                  formatQuantity(contact, unit::metre) + " in system/relax.yaml");
            }
            loads.force[n][0] = sign * forces[static_cast<std::size_t>(stage)] * area[n] / total;
        }
    }
    return loads;
}

std::string Tweezers::describe(int stage) const {
    return formatQuantity(forces[static_cast<std::size_t>(stage)], unit::newton);
}

std::vector<Protocol::Column> Tweezers::columns() const {
    return {{"force", "N", "force on each bead"},
            {"axialDiameter", "m", "extent along x, in which the beads are pulled"},
            {"transverseDiameter", "m", "extent along y, across it"}};
}

std::vector<double> Tweezers::measure(int stage, const Membrane& membrane) const {
    return {forces[static_cast<std::size_t>(stage)], extent(membrane.position, 0), extent(membrane.position, 1)};
}

CORPUSCLE_REGISTER(Protocol, Tweezers, "tweezers", "two beads pulled apart, as with optical tweezers");

}  // namespace corpuscle::membrane
