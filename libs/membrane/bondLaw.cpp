#include "membrane/bondLaw.hpp"

namespace corpuscle::membrane {

double BondLaw::weight(const Network& network, const Bond& bond) const {
    if (!scaled) {
        return 1;
    }
    double area = 0;
    for (const int t : network.bondTriangles(bond.number)) {
        area += t < 0 ? 0 : network.restAreas()[t];
    }
    return 2 / std::sqrt(3.0) * area / (bond.rest * bond.rest);
}

Weights BondLaw::weights(const Network& network) const {
    Weights all;
    for (const Bond& bond : network.allBonds()) {
        all.values.push_back(weight(network, bond));
    }
    return all;
}

}  // namespace corpuscle::membrane
