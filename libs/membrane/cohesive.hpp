// Rupture by a tear that costs energy: the sheet weakens gradually where its energy in tension is greatest, and a tear
// costs the same fracture energy for each length on every mesh that resolves its length (gradientDamage.hpp).
//
// symbol | key            | meaning                                                                            | unit
// G      | fractureEnergy | energy for each length of tear                                                     | J/m
// l      | length         | length over which the sheet is weakened on both sides of a tear                    | m
// tau    | resealing      | time in which the damage of a sheet that is no longer in tension decreases by 1/e  | s
// A bond breaks, and a hole begins or grows, where its triangles keep less than 1 % of their energy in tension; the
// tension is then lost already, so that nothing jumps. With `resealing`, damage decreases as exp(-t/tau) wherever the
// energy in tension does not hold it up, and a broken bond holds again when its triangles keep a quarter: the lips of a
// hole have come together again. Without it, tears stay.
//
// Bonds, triangles, corner angles and the local area are weakened: bonds and the local area in tension only, so that
// the lips of a tear that closes press on each other. Bending stays until the triangle breaks; the constraints of the
// whole area and volume are switched off when the first one does.
//
// G and l together are the strength (gradientDamage.hpp): psi_c = 3 G/(16 l) is the energy in tension, for each
// stress-free area, at which damage begins. G and tau of the membrane of a red cell are assumptions of the case: we
// know of no measurement. The rim of a hole can have a line tension besides (rim.hpp).
//
// Damage that grows is an event of an implicit step, which ends where a node has gained between 0.2 and 0.4. Once the
// cell has lost bonds, as many nodes as 5 % of these may gain more (implicit/breakSearch.hpp).
//
// A hole that has closed stays one of a cell that was open: its volume, area and the sides of the fluid are not held
// again (network.hpp).
#pragma once
#include <optional>

#include "core/settings.hpp"
#include "membrane/ruptureLaw.hpp"

namespace corpuscle::membrane {

struct Cohesive : RuptureLaw {
    double fractureEnergy = 0, length = 0;  // G [J/m], l [m]
    std::optional<double> resealing{};      // tau, s

    DamageOf damageOf() const override { return DamageOf::nodes; }
    bool weakens() const override { return true; }
    void gather(const RuptureStep& now, std::span<double> damage) const override;
    std::vector<double> shares(const Network& network, std::span<const double> damage) const override;
    std::vector<BrokenBond> select(const RuptureStep& now) const override;
    std::vector<int> resealed(const RuptureStep& now) const override;
    std::vector<double> excesses(const RuptureStep& now) const override;
    double tolerance() const override { return 1; }
    double tearLength(const Network& network, std::span<const double> damage) const override;
    std::optional<double> resolvedLength() const override { return length; }
    static const Schema<Cohesive>& schema();
};

}  // namespace corpuscle::membrane
