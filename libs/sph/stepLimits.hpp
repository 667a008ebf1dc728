// Limits of the time step of velocity Verlet (docs/theory/timeStep.md), the smallest of which is taken:
//
//     viscous      1/lambda, lambda the largest eigenvalue of the viscous operator per mass (power iterations): half of
//                  forward Euler's limit, because the scheme uses the extrapolated velocity
//     acoustic     0.25 h/(c0 + |u|),  h = H_s/2
//     body force   0.25 sqrt(h/|f|)
//     spring       0.4 sqrt(m/k) for the stiffest node (k: largest eigenvalue of the network's stiffness)
//     drag         mu dx/k, for an overdamped node
#pragma once
#include <limits>
#include <string>
#include <vector>

namespace corpuscle::sph {

struct StepLimit {
    std::string name;
    double seconds = std::numeric_limits<double>::infinity();
};

struct StepLimits {
    std::vector<StepLimit> all;  // with safety factors; those that the scene lacks are absent
    void add(std::string name, double seconds) { all.push_back({std::move(name), seconds}); }
    StepLimit binding() const {
        StepLimit least;
        for (const StepLimit& limit : all)
            if (limit.seconds < least.seconds) least = limit;
        return least;
    }
};

}  // namespace corpuscle::sph
