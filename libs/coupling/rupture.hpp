// Rupture of a membrane at the end of a step.
#pragma once
#include <functional>
#include <vector>

#include "membrane/membrane.hpp"
#include "sph/budget.hpp"

namespace corpuscle::coupling {

// Bonds of one cell that broke in one step.
struct RuptureEvent {
    int cell;  // its number, from 1
    std::vector<membrane::BrokenBond> bonds;
};

// Weakens the membrane and breaks its bonds as its rupture law says, at the end of a step of dt [s]. budget: to which
// the energy that this releases is added; null: none. beforeBreaks is called before the first bond breaks.
RuptureEvent rupture(membrane::Membrane& membrane, double dt, sph::Budget* budget,
                     const std::function<void()>& beforeBreaks = {});

}  // namespace corpuscle::coupling
