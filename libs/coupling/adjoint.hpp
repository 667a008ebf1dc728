// What the two steps with adjoint operators (sph/operators.hpp) have in common: the explicit step (adjointVerlet.hpp)
// and the implicit step (implicit/implicitStep.hpp).
#pragma once
#include <algorithm>
#include <optional>
#include <vector>

#include "coupling/noFlux.hpp"
#include "coupling/scene.hpp"
#include "sph/operators.hpp"

namespace corpuscle::coupling {

struct AdjointOptions {
    sph::OperatorForm form = sph::OperatorForm::corrected;
    std::optional<double> shifting{};  // C of transport.hpp: strength per unit of strain; empty: no shifting
    double densityRate = 0;            // C_rho of relaxDensities
    double backgroundPressure = 0;     // [Pa], of findPressures
    std::optional<DensityBalance> densityBalance{};
    long balanceInterval = 0;  // steps between two balances
    double largestBalance() const { return densityBalance ? densityBalance->largest() : 0; }
};

// Pressures of all owned particles from their densities, and the background pressure [Pa]. A constant pressure has no
// effect on an incompressible continuum. Particles, however, part where they are under tension, since the surface of a
// void between them bears none, and are pressed into voids where they are under pressure.
void findPressures(const Scene& scene, double background, particles::RealArray& pressure);

// Lets densities follow the number of particles, in a step of dt:
//     rho_i <- rho_i [1 + min(C_rho gammadot dt, 1/2) (sigma_i - 1)],   sigma_i = sum_j V_j W (sph/momentPair.hpp)
// The continuity equation takes no account of where particles are: where they part, the volume m/rho of each stays what
// it is, and a void between them, which exerts no pressure, may grow. With this source, the pressure falls where
// particles are sparse and rises where they are dense, until the fluid converges there at the rate C_rho gammadot
// (1 - sigma), gammadot the rate of the flow. It is the source by which incompressible SPH keeps the number density
// constant, spread over a time: Khayyer, Gotoh, J. Comput. Phys. 230 (2011) 3093. Fluid particles only; the density
// balance keeps the mean over each region.
template <class Real>
void relaxDensities(Scene& scene, const sph::Operators<Real>& operators, double rate, double dt) {
    if (rate == 0) return;
    particles::ParticleStore& s = scene.store();
    const double share = std::min(rate * scene.flow.rate * dt, 0.5);
    for (std::size_t i = 0; i < s.size(); ++i)
        if (s.kindOf(i) == particles::Kind::fluid) s.density[i] *= 1 + share * (operators.evenness(i) - 1);
}

// Places fluid particles that are behind a wall, or nearer to it than 0.05 dx, at that distance from it. gap(i): the
// distance of particle i from the nearest wall where forces were evaluated [m]; those beyond a spacing are left alone.
template <class Gap>
void keepWithinWalls(Scene& scene, Gap&& gap) {
    const boundary::Walls& walls = scene.model().walls;
    if (!walls.exist()) return;
    particles::ParticleStore& s = scene.store();
    const double least = NoFlux::leastDistanceInSpacings * scene.spacing;
    for (std::size_t i = 0; i < s.size(); ++i) {
        if (s.kindOf(i) != particles::Kind::fluid || gap(i) > scene.spacing) continue;
        const boundary::Wall& wall = walls.nearest(s.position(i));
        if (const double lack = least - wall.distance(s.position(i)); lack > 0)
            s.setPosition(i, s.position(i) + lack * wall.normal(s.position(i)));
    }
}

// Ends step `number`, of length dt [s]: applies the density balance if it is due, then breaks bonds. Returns the bonds
// that broke. Collective.
std::vector<RuptureEvent> endStep(Scene& scene, AdjointOptions& options, long number, double dt);

}  // namespace corpuscle::coupling
