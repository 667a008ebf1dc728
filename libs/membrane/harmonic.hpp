// Harmonic function of one internal coordinate q about its rest value q0:  E = k/2 (q - q0)^2.
#pragma once

namespace corpuscle::membrane {

struct Harmonic {
    double k = 0;
    double energy(double q, double q0) const { return 0.5 * k * (q - q0) * (q - q0); }
    double derivative(double q, double q0) const { return k * (q - q0); }
    double secondDerivative(double, double) const { return k; }
};

}  // namespace corpuscle::membrane
