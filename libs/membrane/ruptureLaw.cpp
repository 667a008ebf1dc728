#include "membrane/ruptureLaw.hpp"

#include <algorithm>
#include <stdexcept>

namespace corpuscle::membrane {

std::size_t RuptureLaw::damageSize(const Network& network) const {
    switch (damageOf()) {
        case DamageOf::nothing:
            return 0;
        case DamageOf::triangles:
            return network.triangles().size();
        case DamageOf::nodes:
            return network.nodeCount();
    }
    throw std::logic_error("RuptureLaw::damageSize: unknown place of the damage");
}

std::vector<BrokenBond> mostStretchedBonds(const Network& network, std::span<const int> triangles,
                                           std::span<const Vec3> x) {
    std::vector<BrokenBond> broken;
    for (const int triangle : triangles) {
        BrokenBond most{-1, 0, Vec3::Zero()};
        for (const int number : network.triangleBonds(triangle)) {
            const Bond& bond = network.allBonds()[number];
            const Vec3 &a = x[bond.node[0]], &b = x[bond.node[1]];
            if (const double stretch = (b - a).norm() / bond.rest; stretch > most.stretch) {
                most = {number, stretch, 0.5 * (a + b)};
            }
        }
        broken.push_back(most);
    }
    std::sort(broken.begin(), broken.end(), [](const BrokenBond& a, const BrokenBond& b) { return a.bond < b.bond; });
    broken.erase(std::unique(broken.begin(), broken.end(),
                             [](const BrokenBond& a, const BrokenBond& b) { return a.bond == b.bond; }),
                 broken.end());
    return broken;
}

}  // namespace corpuscle::membrane
