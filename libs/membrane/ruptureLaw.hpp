// Family of rupture criteria: which bonds break now. What a broken bond takes with it is network.hpp's business.
#pragma once
#include <span>
#include <vector>

#include "membrane/network.hpp"

namespace corpuscle::membrane {

struct BrokenBond {
    int bond;        // number in Network::allBonds()
    double stretch;  // l/l0 when it broke
    Vec3 place;      // its middle, m
};

class RuptureLaw {
  public:
    static constexpr const char* familyName = "rupture law";
    virtual ~RuptureLaw() = default;
    // Living bonds that break at these positions, in the order of their numbers.
    virtual std::vector<BrokenBond> select(const Network& network, std::span<const Vec3> x) const = 0;
};

}  // namespace corpuscle::membrane
