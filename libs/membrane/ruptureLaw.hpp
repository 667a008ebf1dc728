// Family of rupture criteria, which select the bonds that break now. What is removed together with a broken bond is
// defined in network.hpp.
//
// A criterion also tells how far each living element, a bond or a triangle, is from breaking: its excess e is what the
// criterion limits, divided by the limit, less 1, so that it breaks where e > 0. Implicit steps end where the first e
// becomes 0 (implicit/breakSearch.hpp).
//
// A criterion of the sheet (strain, tension, damage) selects triangles; in each of them the bond with the greatest
// stretch breaks, and with this bond the two triangles to which it belongs.
#pragma once
#include <span>
#include <vector>

#include "membrane/network.hpp"

namespace corpuscle::membrane {

struct MembraneSettings;

struct BrokenBond {
    int bond;        // number in Network::allBonds()
    double stretch;  // l/l0 when it broke
    Vec3 place;      // its midpoint, m
};

// Input of a criterion, at the end of a step or at a time within it.
struct RuptureStep {
    const Network& network;
    const MembraneSettings& laws;    // of the membrane
    std::span<const Vec3> x;         // m
    double dt;                       // s, since the damage was last brought up to date
    std::span<const double> damage;  // D of each triangle, 0 to 1; empty unless the law keepsDamage()
};

class RuptureLaw {
  public:
    static constexpr const char* familyName = "rupture law";
    virtual ~RuptureLaw() = default;
    // Whether the law needs a damage of each triangle. The membrane stores it, not the law.
    virtual bool keepsDamage() const { return false; }
    // Adds to the damage what it has gained in now.dt.
    virtual void gather(const RuptureStep& /*now*/, std::span<double> /*damage*/) const {}
    // Living bonds that break now, in the order of their numbers; the damage is up to date.
    virtual std::vector<BrokenBond> select(const RuptureStep& now) const = 0;
    // The excess e of each living element. The damage is that before now.dt.
    virtual std::vector<double> excesses(const RuptureStep& now) const = 0;
};

// The most stretched bond of each of these whole triangles, in the order of bond numbers, each bond once.
std::vector<BrokenBond> mostStretchedBonds(const Network& network, std::span<const int> triangles,
                                           std::span<const Vec3> x);

}  // namespace corpuscle::membrane
