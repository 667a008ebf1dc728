// Groups of particles that move as rigid bodies: what the fluid needs to know of them. A group has 6 unknowns; P
// spreads them over its particles, and the transpose of P gathers the forces on the particles:
//
//     P   : (U, Omega) -> u_j = U + Omega x r_j                          r_j: position relative to the group's centre
//     P^T : f_j        -> F = sum_j f_j,  T = sum_j s_j x f_j - D Omega
//
// s_j is the point of the surface nearest to particle j: momentum that viscosity transfers from the fluid to a particle
// below the surface acts at the surface. D corrects for the form of the viscous operator: the pairs of fluidPair.hpp
// transmit the traction mu du/dn, which has the divergence but not the moment of mu (grad u + grad u^T).n. On a surface
// in rigid motion the missing part has no resultant, and its moment is exactly
//     mu int_S r x (grad u . n) dS = -mu int_V curl u dV = -2 mu V Omega,   V the volume of the body.
// For example, the torque on a sphere that rotates in fluid at rest is 16/3 pi mu a^3 Omega from mu du/dn, and
// 8 pi mu a^3 Omega from the full traction. In other words: fluid that rotates rigidly with the body exerts no torque,
// but its pairs with the body's particles add up to D Omega, which is subtracted. D is computed as that sum over the
// particles (bodies/body.hpp), and tends to 2 mu V as the kernel's reach becomes small compared with the body; at H_s =
// 0.4 a it is 9 % smaller, and with 2 mu V in its place a free sphere rotates 3 % too slowly.
//
// An implicit solver for velocities needs no more than this: the unknowns of the fluid and 6 for each group, P, P^T,
// and `response`.
#pragma once
#include <mpi.h>

#include <Eigen/Geometry>
#include <functional>
#include <vector>

#include "particles/particleStore.hpp"

namespace corpuscle::sph {

struct RigidMotion {  // of the group's centre and about it: velocities [m/s, 1/s] or accelerations [m/s^2, 1/s^2]
    Vec3 linear = Vec3::Zero(), angular = Vec3::Zero();
    Vec3 at(const Vec3& arm) const { return linear + angular.cross(arm); }
};

struct Wrench {  // force [N] and torque about the centre [N m]
    Vec3 force = Vec3::Zero(), torque = Vec3::Zero();
};

struct RigidGroups {
    // A particle of this rank that belongs to a group.
    struct Member {
        int particle, group;
        double depth;          // below the surface, at least 0 [m]
        Vec3 arm, surfaceArm;  // particle and nearest point of the surface, relative to the group's centre [m]
    };
    // A fluid particle of this rank within the kernel's reach of a body's surface; one entry for each body in reach.
    struct Near {
        int particle, group;
        // weight of the body/distance from its surface [1/m]; the weights of all bodies in reach sum to 1
        double inverseDistance;
        Vec3 arm;
    };
    std::vector<Member> members;
    std::vector<Near> near;
    std::vector<RigidMotion> motion;   // of each group, at which forces are evaluated
    std::vector<Wrench> wrenches;      // of the fluid on each group at the last evaluation, the same on all ranks
    std::vector<Mat3> rotationalDrag;  // D of each group, in the axes of space [N m s]
    // Accelerations of the groups under given forces, the same on all ranks; 0 for groups of prescribed motion.
    std::function<std::vector<RigidMotion>(const std::vector<Wrench>&)> response;

    // P: velocities of the members of this rank.
    void spread(const std::vector<RigidMotion>& motions, double* u, double* v, double* w) const;
    // P^T of the forces mass x acceleration, for groups that move with `motions`; the same on all ranks. Collective.
    std::vector<Wrench> gather(const std::vector<RigidMotion>& motions, const double* ax, const double* ay,
                               const double* az, const double* mass, MPI_Comm comm) const;
};

}  // namespace corpuscle::sph
