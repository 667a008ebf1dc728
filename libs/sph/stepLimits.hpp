// Limits of the time step (docs/theory/timeStep.md), the smallest of which is taken. Those of velocity Verlet:
//
//     viscous              1/lambda, lambda the largest eigenvalue of the viscous operator per mass (power iterations):
//                          half of forward Euler's limit, because the scheme uses the extrapolated velocity
//     membrane viscosity   1/(lambda + lambda_m), lambda_m the largest eigenvalue of the membranes' own viscosity per
//                          mass of their nodes (power iterations); in the spring limit too lambda is this sum
//     acoustic             0.25 h/(c0 + |u|),  h = H_s/2
//     body force           0.25 sqrt(h/|f|)
//     spring               (omega dt/2)^2 + lambda dt = 1, omega^2 the largest eigenvalue of M^-1 K of the nodes on
//                          their network (power iterations)
//
// The spring limit is exact for a node with spring and viscous drag: with u* and x of velocityVerlet.hpp the
// characteristic equation of the scheme is
//     (z - 1)^2 + omega^2 dt^2 z + lambda dt (z - 1)(1 + (z - 1)/(2z)) = 0,
// a root of which leaves the unit circle at z = -1. Without springs this gives the viscous limit, without drag the
// well-known 2/omega. The scheme of rkl2.hpp has three times the acoustic limit, the body-force limit and, in place of
// the viscous one, limits from its number of stages and from an unsteady flow.
//
// Viscous and spring limits are multiplied by `safety`. Assuming that one mode has both largest eigenvalues errs on the
// safe side.
#pragma once
#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace corpuscle::sph {

struct StepLimit {
    std::string name;
    double seconds = std::numeric_limits<double>::infinity();
    std::string cure = {};  // what messages advise if this limit stops a run; empty: a smaller step, a finer mesh
};

struct StepLimits {
    std::vector<StepLimit> all;  // with safety factors; only limits that apply to the scene
    int stages = 0;              // number of stages that the step needs; rkl2.hpp only
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
    return 2 / (std::sqrt(lambda * lambda + omega2) + lambda);  // this form avoids cancellation where drag is strong
}

}  // namespace corpuscle::sph
