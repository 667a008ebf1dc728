// Static equilibrium of a membrane: the positions that minimise its energy minus the work of the loads.
//
//     Pi(x) = E(x) - sum_n f_n . x_n - p V(x) + sum of terms(x)        dPi/dx = 0 for every free coordinate
//
// f: dead loads [N]; p: pressure inside minus outside [Pa], a follower load; terms: energies of objects that act on the
// membrane (a pipette). Held coordinates keep their values.
//
// Newton's method uses the exact stiffness K (near a minimum it is positive definite, and convergence is quadratic)
// plus the smallest shift s I that makes the matrix positive definite. Where this takes a large shift, the stiffness of
// each element is made positive semi-definite instead, while that of the pressure stays exact. The step d solves
// (K + s I) d = residual by sparse LDL^T; global terms (area, volume) enter as rank-one parts by the Woodbury formula.
// A step is accepted when Pi falls by a given fraction of the decrease that its slope predicts, if need be after
// halving the step; s grows where the matrix is not positive definite or no step is found, and falls with success. The
// shift also controls the six rigid motions, which nothing resists where the loads are in equilibrium and no coordinate
// is held.
//
// Convergence: largest residual component <= tolerance times the greater of the largest load component and
// `forceScale`.
#pragma once
#include <array>
#include <limits>
#include <memory>
#include <vector>

#include "membrane/membrane.hpp"

namespace corpuscle::membrane {

struct Loads {
    std::vector<Vec3> force;                     // per node, N; empty: none
    double pressure = 0;                         // Pa
    std::vector<std::array<bool, 3>> held = {};  // per node; empty: all free
    std::vector<std::shared_ptr<const Term>> terms = {};
    double longestStep = std::numeric_limits<
        double>::infinity();  // of a node in one search step, m; keeps nodes from jumping over thin objects
};

struct EquilibriumOptions {
    double tolerance = 1e-6;
    double forceScale = 0;  // N; residuals below tolerance times this count as zero
    int iterations = 200;
};

struct EquilibriumReport {
    bool converged = false;
    int iterations = 0;
    double residual = 0;   // largest component, N
    double potential = 0;  // Pi, J
};

// Moves membrane.position to the equilibrium; membrane.force then holds the forces at this position. Throws
// Failure(invalidCase) for a load list of the wrong length and for pressure on an open membrane, Failure(numerics)
// where the energy is not finite at the start.
EquilibriumReport findEquilibrium(Membrane& membrane, const Loads& loads, const EquilibriumOptions& options);

}  // namespace corpuscle::membrane
