// Limits of the time step (docs/theory/timeStep.md), the smallest of which is taken. Those of velocity Verlet:
//
//     viscous      1/lambda, lambda the largest eigenvalue of the viscous operator per mass (power iterations): half of
//                  forward Euler's limit, because the scheme uses the extrapolated velocity
//     membrane     1/(lambda + lambda_m), lambda_m the largest eigenvalue of the membranes' own viscosity per mass of
//                  their nodes
//     viscosity    (power iterations); in the spring limit too lambda is this sum
//     acoustic     0.25 h/(c0 + |u|),  h = H_s/2
//     body force   0.25 sqrt(h/|f|)
//     spring       (omega dt/2)^2 + lambda dt = 1, omega^2 the largest eigenvalue of M^-1 K of the nodes on their
//                  network (power iterations)
//
// The last one is exact for a node with spring and viscous drag: with u* and x as above the scheme's characteristic
// equation is
//     (z - 1)^2 + omega^2 dt^2 z + lambda dt (z - 1)(1 + (z - 1)/(2z)) = 0,
// which leaves the unit circle at z = -1. Without springs it gives the viscous limit, without drag the well-known
// 2/omega. rkl2.hpp has three times the acoustic limit, the body-force limit and, in place of the viscous one, those of
// its stages and of an unsteady flow.
// Viscous and spring limits are multiplied by `safety`; taking both largest eigenvalues for one mode errs on the safe
// side.
#pragma once
#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace corpuscle::sph {

struct StepLimit {
    std::string name;
    double seconds = std::numeric_limits<double>::infinity();
    std::string cure = {};  // where it lets a run come no further; empty: a smaller step, a finer mesh
};

struct StepLimits {
    std::vector<StepLimit> all;  // with safety factors; those that the scene lacks are absent
    int stages = 0;              // that the step taken needs, of rkl2.hpp alone
    void add(std::string name, double seconds, std::string cure = {}) {
        all.push_back({std::move(name), seconds, std::move(cure)});
    }
    StepLimit binding() const {
        StepLimit least;
        for (const StepLimit& limit : all)
            if (limit.seconds < least.seconds) least = limit;
        return least;
    }
};

inline double acousticStep(double h, double speed) { return 0.25 * h / speed; }  // speed: c0 + |u|
inline double bodyForceStep(double h, double force) { return 0.25 * std::sqrt(h / force); }
inline double springStep(double lambda, double omega2) {
    return 2 / (std::sqrt(lambda * lambda + omega2) + lambda);  // no difference of near numbers where drag is strong
}

}  // namespace corpuscle::sph
