// Family of rupture criteria, which select the bonds that break now. What is removed together with a broken bond is
// defined in network.hpp.
//
// A criterion also tells how far each living element, a bond or a triangle, is from breaking: its excess e is what the
// criterion limits, divided by the limit, less 1, so that it breaks where e > 0 (of a law that weakens the sheet first:
// the growth of damage at each node, divided by what a step may add, less 1). Implicit steps end where the first e
// becomes 0 (implicit/breakSearch.hpp).
//
// A criterion of the sheet (strain, tension, damage) selects triangles; in each of them the bond with the greatest
// stretch breaks, and with this bond the two triangles to which it belongs.
#pragma once
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "membrane/network.hpp"
#include "membrane/term.hpp"

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
    std::span<const double> damage;  // of each triangle or node, 0 to 1; empty unless the law keeps damage
    // The laws of the membrane as it was made, neither broken nor weakened; empty unless the law weakens().
    std::span<const std::unique_ptr<Term>> wholeTerms;
};

class RuptureLaw {
  public:
    static constexpr const char* familyName = "rupture law";
    virtual ~RuptureLaw() = default;
    // Where the law needs a damage. The membrane stores it, not the law.
    enum class DamageOf { nothing, triangles, nodes };
    virtual DamageOf damageOf() const { return DamageOf::nothing; }
    // Adds to the damage what it has gained in now.dt.
    virtual void gather(const RuptureStep& /*now*/, std::span<double> /*damage*/) const {}
    std::size_t damageSize(const Network& network) const;
    // Whether shares() are ever less than 1.
    virtual bool weakens() const { return false; }
    // Share of its energy that each triangle keeps with this damage (network.hpp); empty: all of it.
    virtual std::vector<double> shares(const Network& /*network*/, std::span<const double> /*damage*/) const {
        return {};
    }
    // Living bonds that break now, in the order of their numbers; the damage is up to date.
    virtual std::vector<BrokenBond> select(const RuptureStep& now) const = 0;
    // Broken bonds that hold again.
    virtual std::vector<int> resealed(const RuptureStep& /*now*/) const { return {}; }
    // The excess e of each living element. The damage is that before now.dt.
    virtual std::vector<double> excesses(const RuptureStep& now) const = 0;
    // The greatest e with which a step may end, if that of the first break need not be met closely.
    virtual double tolerance() const { return 0; }
    // Length of the tears on the stress-free surface: their energy over the fracture energy [m]; 0 for a law without
    // one.
    virtual double tearLength(const Network& /*network*/, std::span<const double> /*damage*/) const { return 0; }
    // Length on the stress-free surface that the edges of the mesh must resolve: they are at most this part of it [m];
    // empty: none.
    static constexpr double edgeOfResolvedLength = 0.5;
    virtual std::optional<double> resolvedLength() const { return {}; }
};

// The most stretched bond of each of these whole triangles, in the order of bond numbers, each bond once.
std::vector<BrokenBond> mostStretchedBonds(const Network& network, std::span<const int> triangles,
                                           std::span<const Vec3> x);

}  // namespace corpuscle::membrane
