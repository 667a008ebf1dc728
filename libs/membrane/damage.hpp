// Rupture by damage that gathers with strain and time. Each whole triangle has a damage D, 0 at the start; its areal
// strain e = A/A0 - 1 adds to it, it never heals, and the sheet gives way where D reaches 1:
//
//     dD/dt = 1/tau (<e - e0>/ec)^n,      <y> = max(y, 0)
//
// symbol | key      | meaning                                                      | unit
// e0     | onset    | areal strain that the sheet bears for ever                   | -
// ec     | scale    | strain beyond the onset under which the sheet lasts tau      | -
// tau    | time     | time to failure at e0 + ec                                   | s
// n      | exponent | how steeply damage grows with strain                         | -
// At constant strain the time to failure is tau (ec/<e - e0>)^n. Two limits are the threshold of arealStrain.hpp: tau
// -> 0, at e0; n -> infinity, at e0 + ec. Each step adds its dt times the rate at its end, so that in these limits the
// same bonds break at the same step as by the threshold; otherwise the time to failure is late by up to a step at
// constant strain.
//
// Areal strain drives, since lysis is the bilayer's: the bilayer bears shear as a liquid does, and gives way to
// dilation, sooner the greater it is. Red cells lyse at an areal strain of 2 to 4 % (Evans, Waugh and Melnik, Biophys.
// J. 16:585, 1976; recalled); models that open pores by areal strain meet measured haemolysis of devices better than
// power laws of stress (Dirkes and Behr, arXiv:2601.19994; abstract read). The form is the accumulation of damage that
// fatigue and power laws of haemolysis share; tau and n of a red cell's membrane have not been measured in a way that
// we know: they are the case's assumption.
#pragma once
#include "core/settings.hpp"
#include "membrane/ruptureLaw.hpp"

namespace corpuscle::membrane {

struct Damage : RuptureLaw {
    double onset = 0, scale = 0, time = 0, exponent = 1;  // e0, ec, tau [s], n

    double rate(double strain) const;  // dD/dt, 1/s
    bool keepsDamage() const override { return true; }
    std::vector<BrokenBond> select(const RuptureStep& now) const override;
    static const Schema<Damage>& schema();
};

}  // namespace corpuscle::membrane
