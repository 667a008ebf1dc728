// Harmonic three-point angle spring at each corner of each triangle
//     E = k/2 (theta - theta0)^2
// symbol | meaning                              | unit
// k      | angle constant                       | J (N m/rad)
// theta0 | corner angle in the stress-free mesh | rad
// On a hexagonal network of edge l it adds 3 sqrt(3)/2 k/l^2 to Gs and nothing to Ks (a dilation keeps all angles).
// The paper's 1e-20 J is about 1e-7 N/m at l = 0.4 um: negligible beside the paper's bonds. Angles do not resist
// bending.
#pragma once
#include "core/settings.hpp"
#include "membrane/angleLaw.hpp"
#include "membrane/harmonic.hpp"

namespace corpuscle::membrane {

struct HarmonicAngle : AngleLawOf<HarmonicAngle>, Harmonic {
    static const Schema<HarmonicAngle>& schema();
};

}  // namespace corpuscle::membrane
