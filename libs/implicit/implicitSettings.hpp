// Settings of the implicit step in a case.
#pragma once
#include <string>

#include "core/settings.hpp"

namespace corpuscle::implicit {

struct ImplicitSettings {
    double step = 0.05;       // strain per step
    double tolerance = 1e-3;  // of the velocity, in the energy norm
    double error = 1e-3;      // of positions, per unit of strain (stepControl.hpp)
    double bondStrain = 0.1;  // largest change of a bond's length in one step, relative
    std::string method = "midpoint", preconditioner = "automatic";
    static const Schema<ImplicitSettings>& schema();
};

}  // namespace corpuscle::implicit
