// Running budget of energy and momentum: what the forces of a scheme add and remove, summed up at every step by the
// scheme's own quadrature (docs/theory/conservation.md). With u the velocity of every particle, those of walls and
// bodies included, the forces of a scheme do work at the rates
//
//     forces of particle pairs, F:  sum u.F = - dissipation - d(compression)/dt
//         since forces of viscosity and pressure are adjoint to the rates of density
//     forces of membranes, f:       sum u.f = - d(elastic)/dt - dissipation in membranes
//     walls + bodies + body force + images = dissipation in fluid and membranes
//         + d(kinetic + elastic + compression)/dt + residual of the solver
//
// The sums here are of rates as the step has them; the energies themselves are functions of the state, and the
// difference is the energy that the step creates or loses (observers/conservation.cpp). Every rank has its own part,
// which is summed over ranks only when an observer reads the budget.
#pragma once
#include <cstddef>
#include <vector>

#include "core/vec.hpp"

namespace corpuscle::sph {

struct Budget {
    enum Entry : std::size_t {
        ofWalls,                       // power of the walls on the fluid [W]
        ofBodyForce,                   // of the body force on fluid, nodes and bodies that yield
        ofBodies,                      // of bodies whose motion is prescribed
        ofImages,                      // of periodic images that slide past each other
        viscous,                       // dissipated by the viscosity of the fluid: velocity . L velocity
        inMembranes,                   // dissipated by the viscosity of membranes
        kinetic,                       // velocity . mass d(velocity)/dt as the step has it
        elastic,                       // - velocity of nodes . elastic force
        compression,                   // - sum of V p div u
        ofSolver,                      // velocity . residual of the step's equations
        released,                      // elastic energy released by what broke; added as it is, not as a rate [J]
        bodyForce,                     // force [N], three numbers
        givenBodies = bodyForce + 3,   // force of bodies whose motion is prescribed
        images = givenBodies + 3,      // momentum of particles that cross faces between sliding images [N s]
        wallTorque = images + 3,       // of all walls about the middle of the box [N m]
        forceTorque = wallTorque + 3,  // of the body force
        count = forceTorque + 3
    };
    // The entries above, then for each wall, in the order of their numbers, its force on the fluid [N], three numbers.
    using Values = std::vector<double>;
    static std::size_t wall(std::size_t number) { return count + 3 * number; }
    static Values zero(std::size_t walls) { return Values(wall(walls), 0.0); }

    bool kept = false;
    Values total;  // rates over time, of this rank
    // Rates at the end of the last step, for a quadrature that needs them, and whether they are known.
    Values last;
    bool lastKnown = false;

    explicit Budget(std::size_t walls = 0) : total(zero(walls)), last(zero(walls)) {}
    void add(double seconds, const Values& rates) {
        for (std::size_t k = 0; k < total.size(); ++k) total[k] += seconds * rates[k];
    }
    static void add(Values& values, std::size_t first, const Vec3& v) {
        for (int k = 0; k < 3; ++k) values[first + static_cast<std::size_t>(k)] += v[k];
    }
    static Vec3 vector(const Values& values, std::size_t first) {
        return {values[first], values[first + 1], values[first + 2]};
    }
    // Adds the contribution of a wall that exerts this force on the fluid at x, relative to the middle of the box.
    static void addWall(Values& rates, int number, const Vec3& velocity, const Vec3& x, const Vec3& force) {
        rates[ofWalls] += velocity.dot(force);
        add(rates, wall(static_cast<std::size_t>(number)), force);
        add(rates, wallTorque, x.cross(force));
    }
    // Adds the contribution of a body force that acts at x, relative to the middle of the box, where the velocity is u.
    static void addBodyForce(Values& rates, const Vec3& u, const Vec3& x, const Vec3& force) {
        rates[ofBodyForce] += u.dot(force);
        add(rates, bodyForce, force);
        add(rates, forceTorque, x.cross(force));
    }
};

}  // namespace corpuscle::sph
