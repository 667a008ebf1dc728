// Position and motion of a rigid body, and its integration in time.
//
//     m dU/dt = F,   dL/dt = T,   L = R I R^T Omega,   dR/dt = Omega x R
//
// Velocity Verlet: half a kick of U and L, a drift, half a kick with the new force and torque. In the drift L is
// constant in the space frame; the rotation is that of the free top, split into rotations about the principal axes
// (Dullweber, Leimkuhler and McLachlan, J. Chem. Phys. 107:5840, 1997):
//     R <- R exp(dt/2 w1) exp(dt/2 w2) exp(dt w3) exp(dt/2 w2) exp(dt/2 w1),
//         w_k = L_k/I_k about axis k, L_k in the body frame
// The scheme is of second order, symplectic and reversible; |L| and the norm of the quaternion are conserved to
// rounding.
#pragma once
#include "bodies/solid.hpp"
#include "sph/rigidGroups.hpp"

namespace corpuscle::bodies {

using sph::RigidMotion;
using sph::Wrench;

struct RigidState {
    Vec3 centre = Vec3::Zero();                  // of mass, not wrapped into the box [m]
    Eigen::Quaterniond orientation{1, 0, 0, 0};  // rotation from the body frame to space
    RigidMotion motion;                          // U [m/s] and Omega [1/s], in the space frame

    Mat3 rotation() const { return orientation.toRotationMatrix(); }
    Vec3 angularMomentum(const Solid& solid) const;
    void setAngularMomentum(const Solid& solid, const Vec3& L);
};

// U += dt F/m, L += dt T.
void kick(RigidState& state, const Solid& solid, const Wrench& wrench, double dt);
// Moves centre and orientation of a body without force and torque.
void drift(RigidState& state, const Solid& solid, double dt);
// Moves centre and orientation of a body with prescribed, constant U and Omega.
void drive(RigidState& state, double dt);

}  // namespace corpuscle::bodies
