// Static equilibrium of a membrane: the positions where its energy less the work of the loads is least.
//
//     Pi(x) = E(x) - sum_n f_n . x_n - p V(x) + sum of terms(x)        dPi/dx = 0 for every free coordinate
//
// f: dead loads [N]; p: pressure inside over outside [Pa], which follows the surface; terms: energies of what the
// membrane meets (a pipette). Held coordinates keep their values.
//
// Newton's method with the exact stiffness (near a minimum it is positive definite, and convergence is quadratic) plus
// a shift s I as small as makes it positive definite; where that takes a large one, with each element's made positive
// semi-definite and the exact one of the pressure. The step solves (K + s I) d = residual by sparse LDL^T; global terms
// (area, volume) come in as rank-one parts by the Woodbury formula. A step is accepted when Pi falls by a fraction of
// what its slope promises, after halving it if need be; s grows where the matrix is not positive definite or no step is
// found, and falls with success. The shift also carries the six rigid motions, which nothing holds where loads are in
// equilibrium and no coordinate is held.
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
        double>::infinity();  // of a node in one step of the search, m: not to jump over thin things
};

struct EquilibriumOptions {
    double tolerance = 1e-6;
    double forceScale = 0;  // N; below tolerance times this every residual counts as zero
    int iterations = 200;
};

struct EquilibriumReport {
    bool converged = false;
    int iterations = 0;
    double residual = 0;   // largest component, N
    double potential = 0;  // Pi, J
};

// Moves membrane.position there, forces are those at the end. Throws Failure(invalidCase) for a load list of the wrong
// length and for pressure on an open membrane, Failure(numerics) where the energy is not finite at the start.
EquilibriumReport findEquilibrium(Membrane& membrane, const Loads& loads, const EquilibriumOptions& options);

}  // namespace corpuscle::membrane
