// Line tension of the rims of holes: the energy that the edge of a torn sheet has for each length,
//     E = gamma sum over the bonds of the rims of l
// symbol | key     | meaning                                                                          | unit
// gamma  | tension | 5 to 30 pN for a lipid bilayer; the cytoskeleton has none of its own             | N
// Under a tension sigma, a round hole of radius gamma/sigma is in equilibrium: a greater one opens, a smaller one
// closes. The border of a mesh that was made with one is not a rim.
#pragma once
#include <memory>

#include "core/settings.hpp"
#include "membrane/network.hpp"
#include "membrane/term.hpp"

namespace corpuscle::membrane {

struct Rim {
    double tension = 0;  // gamma, N
    std::unique_ptr<Term> makeTerm(Network& network) const;
    static const Schema<Rim>& schema();
};

}  // namespace corpuscle::membrane
