// Family of rupture criteria: which bonds break now. What a broken bond takes with it is network.hpp's business.
//
// A criterion of the sheet (strain, tension, damage) finds triangles; of each its bond with the greatest stretch
// breaks, and with it the two triangles that it belongs to.
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

// What a criterion has to go by at the end of a step.
struct RuptureStep {
    const Network& network;
    const MembraneSettings& laws;  // of the membrane
    std::span<const Vec3> x;       // m
    double dt;                     // s, since it looked last
    std::span<double>
        damage;  // D of each triangle, 0 to 1, for the law to bring up to date; empty unless it keepsDamage()
};

class RuptureLaw {
  public:
    static constexpr const char* familyName = "rupture law";
    virtual ~RuptureLaw() = default;
    // Whether the law remembers a damage of each triangle: state of the membrane, not of the law.
    virtual bool keepsDamage() const { return false; }
    // Living bonds that break now, in the order of their numbers.
    virtual std::vector<BrokenBond> select(const RuptureStep& now) const = 0;
};

// Of each of these whole triangles the bond that is stretched most, in the order of their numbers, each once.
std::vector<BrokenBond> mostStretchedBonds(const Network& network, std::span<const int> triangles,
                                           std::span<const Vec3> x);

}  // namespace corpuscle::membrane
