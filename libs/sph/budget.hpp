// Running budget of energy and momentum: what the forces of a scheme put in and take away, added up at every step in
// the scheme's own quadrature (docs/theory/conservation.md). With every particle's velocity u, that of walls and bodies
// included, the forces of a scheme do work at the rates
//
//     sum u.F = - dissipation - d(compression)/dt
//         of pairs: viscosity and pressure are adjoint to the rates of density
//     sum u.f = - d(elastic)/dt - dissipation in membranes            of membranes
//     walls + bodies + body force + images = dissipation of both + d(kinetic + elastic + compression)/dt + what the
//         solver leaves
//
// What is added up here are rates of the step; the energies themselves are functions of the state, and what both differ
// by is what the step makes or loses (observers/conservation.cpp). Every rank has its part and nothing is reduced until
// somebody looks.
#pragma once
#include <cstddef>
#include <vector>

#include "core/vec.hpp"

namespace corpuscle::sph {

struct Budget {
    enum Entry : std::size_t {
        ofWalls,                       // power of the walls on the fluid [W]
        ofBodyForce,                   // of the body force on fluid, nodes and bodies that yield
        ofBodies,                      // of bodies whose motion is given
        ofImages,                      // of periodic images that slide past each other
        viscous,                       // dissipated by the viscosity of the fluid: velocity . L velocity
        inMembranes,                   // dissipated by that of membranes
        kinetic,                       // velocity . mass d(velocity)/dt as the step has it
        elastic,                       // - velocity of nodes . elastic force
        compression,                   // - sum of V p div u
        ofSolver,                      // velocity . residual of the step's equations
        released,                      // elastic energy of what broke, no rate [J]
        bodyForce,                     // force [N], three numbers
        givenBodies = bodyForce + 3,   // force of bodies whose motion is given
        images = givenBodies + 3,      // momentum of what crosses the faces between images that slide [N s]
        wallTorque = images + 3,       // of all walls about the middle of the box [N m]
        forceTorque = wallTorque + 3,  // of the body force
        count = forceTorque + 3
    };
    // By entry; behind them, for each wall by its number, its force on the fluid [N], three numbers.
    using Values = std::vector<double>;
    static std::size_t wall(std::size_t number) { return count + 3 * number; }
    static Values zero(std::size_t walls) { return Values(wall(walls), 0.0); }

    bool kept = false;
    Values total;  // rates over time, of this rank
    // Where the quadrature needs them: rates at the end of the last step, and whether they are known.
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
    // Of a wall that exerts this force on the fluid at x, from the middle of the box.
    static void addWall(Values& rates, int number, const Vec3& velocity, const Vec3& x, const Vec3& force) {
        rates[ofWalls] += velocity.dot(force);
        add(rates, wall(static_cast<std::size_t>(number)), force);
        add(rates, wallTorque, x.cross(force));
    }
    // Of the body force on something of velocity u at x.
    static void addBodyForce(Values& rates, const Vec3& u, const Vec3& x, const Vec3& force) {
        rates[ofBodyForce] += u.dot(force);
        add(rates, bodyForce, force);
        add(rates, forceTorque, x.cross(force));
    }
};

}  // namespace corpuscle::sph
