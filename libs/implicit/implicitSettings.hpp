// Settings of the implicit step, as a case gives them.
#pragma once
#include <string>

#include "core/settings.hpp"

namespace corpuscle::implicit {

struct ImplicitSettings {
    double step = 0.05;       // strain a step
    double tolerance = 1e-3;  // of the velocity, in the norm of energy
    double error = 1e-3;      // of places, per unit of strain (stepControl.hpp)
    double bondStrain = 0.1;  // of one step
    std::string method = "midpoint", preconditioner = "automatic";
    static const Schema<ImplicitSettings>& schema();
};

}  // namespace corpuscle::implicit
