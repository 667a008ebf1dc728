// Rupture by damage that accumulates with strain and time. Each whole triangle has a damage D, 0 at the start, to which
// its areal strain e = A/A0 - 1 adds and which never decreases. The sheet breaks where D reaches 1:
//
//     dD/dt = 1/tau (<e - e0>/ec)^n,      <y> = max(y, 0)
//
// symbol | key      | meaning                                                      | unit
// e0     | onset    | areal strain that the sheet bears indefinitely               | -
// ec     | scale    | strain beyond the onset at which the sheet lasts for tau     | -
// tau    | time     | time to failure at e0 + ec                                   | s
// n      | exponent | how steeply damage grows with strain                         | -
// At constant strain the time to failure is tau (ec/<e - e0>)^n. In two limits the law becomes the threshold of
// arealStrain.hpp: at e0 for tau -> 0, and at e0 + ec for n -> infinity. Each step adds its dt times the rate at its
// end, so that in these limits the same bonds break at the same step as with the threshold; otherwise, at constant
// strain, failure comes late by up to one step.
//
// Areal strain drives the damage, since lysis is a failure of the bilayer: the bilayer responds to shear like a liquid,
// and fails under dilation, the sooner the greater the dilation. Red cells lyse at an areal strain of 2 to 4 % (Evans,
// Waugh and Melnik, Biophys. J. 16:585, 1976; cited from memory); models in which areal strain opens pores agree better
// with the haemolysis measured in devices than power laws of stress do (Dirkes and Behr, arXiv:2601.19994; only the
// abstract was read). The accumulation of damage has the form that models of fatigue and power laws of haemolysis
// share. We know of no measurement of tau and n for the membrane of a red cell: they are assumptions of the case.
#pragma once
#include "core/settings.hpp"
#include "membrane/ruptureLaw.hpp"

namespace corpuscle::membrane {

struct Damage : RuptureLaw {
    double onset = 0, scale = 0, time = 0, exponent = 1;  // e0, ec, tau [s], n

    double rate(double strain) const;  // dD/dt, 1/s
    DamageOf damageOf() const override { return DamageOf::triangles; }
    void gather(const RuptureStep& now, std::span<double> damage) const override;
    std::vector<BrokenBond> select(const RuptureStep& now) const override;
    std::vector<double> excesses(const RuptureStep& now) const override;
    static const Schema<Damage>& schema();

  private:
    double after(const RuptureStep& now, int triangle) const;  // D after now.dt, without the bound 1
};

}  // namespace corpuscle::membrane
