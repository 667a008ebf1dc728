// Family of rupture criteria: which bonds break now. What a broken bond takes with it is network.hpp's business.
//
// A criterion of the sheet (strain, tension) finds triangles; of each its bond with the greatest stretch breaks, and with it the two
// triangles that it belongs to.
#pragma once
#include <span>
#include <vector>

#include "membrane/network.hpp"

namespace corpuscle::membrane {

struct MembraneSettings;

struct BrokenBond {
    int bond;        // number in Network::allBonds()
    double stretch;  // l/l0 when it broke
    Vec3 place;      // its middle, m
};

class RuptureLaw {
  public:
    static constexpr const char* familyName = "rupture law";
    virtual ~RuptureLaw() = default;
    // Living bonds that break at these positions, in the order of their numbers; laws: those of the membrane.
    virtual std::vector<BrokenBond> select(const Network& network, const MembraneSettings& laws,
                                           std::span<const Vec3> x) const = 0;
};

// Of each of these whole triangles the bond that is stretched most, in the order of their numbers, each once.
std::vector<BrokenBond> mostStretchedBonds(const Network& network, std::span<const int> triangles,
                                           std::span<const Vec3> x);

}  // namespace corpuscle::membrane
