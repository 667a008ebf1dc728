// Viscosity of the membrane: a Newtonian sheet (Boussinesq 1913; L. E. Scriven, Chem. Eng. Sci. 12 (1960) 98), beside the elastic laws
//     tau = shear (2 D - tr D P) + dilatation tr D P
// symbol     | meaning                                                                   | unit
// tau        | tension by viscosity                                                      | N/m
// D          | rate of deformation within the surface;  P the surface's unit tensor      | 1/s
// shear      | resists change of shape; of red cells 5e-7 (Hochmuth, Hampel 1979)         | N s/m
// dilatation | resists change of area                                                    | N s/m
// On a triangle of constant D, with the edges a = x1 - x0, b = x2 - x0, their metric g (2 x 2) and its rate, D_kl = (dg_kl/dt)/2 and
//     T = 2 shear g^-1 D g^-1 + (dilatation - shear) (g^-1 : D) g^-1
//     F_1 = -A (T_11 a + T_12 b),  F_2 = -A (T_12 a + T_22 b),  F_0 = -F_1 - F_2.
// Linear in the velocities, symmetric, without force or torque on the whole, zero for any rigid motion; the power -F.v = A tau:D is what
// is dissipated: in an orthonormal frame of the triangle
//     A tau:D = A (shear ((D_xx - D_yy)^2 + (2 D_xy)^2) + dilatation (D_xx + D_yy)^2),
// three squares of rates linear in v, whence the damping matrix C of F = -C v. A broken triangle has none. Kelvin's and Voigt's membrane with a sheet law: it creeps back in the time shear/Gs.
#pragma once
#include "core/settings.hpp"
#include "membrane/network.hpp"
#include "membrane/stiffness.hpp"

namespace corpuscle::membrane {

struct SurfaceViscosity {
    double shear = 0, dilatation = 0;  // N s/m

    // Adds to f [N] for the velocities v [m/s] at x [m].
    void addForces(const Network& network, std::span<const Vec3> x, std::span<const Vec3> v, std::span<Vec3> f) const;
    // Adds C [N s/m] at x [m], exact, symmetric and positive semi-definite triangle by triangle.
    void addDamping(const Network& network, std::span<const Vec3> x, Stiffness& damping) const;
    static const Schema<SurfaceViscosity>& schema();
};

}  // namespace corpuscle::membrane
