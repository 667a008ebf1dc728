// Viscosity of the membrane: a Newtonian sheet (Boussinesq 1913; L. E. Scriven, Chem. Eng. Sci. 12 (1960) 98), in
// addition to the elastic laws
//     tau = shear (2 D - tr D P) + dilatation tr D P
// symbol     | meaning                                                                   | unit
// tau        | viscous tension                                                           | N/m
// D          | rate of deformation within the surface;  P the surface's unit tensor      | 1/s
// shear      | resists change of shape; of red cells 5e-7 (Hochmuth, Hampel 1979)         | N s/m
// dilatation | resists change of area                                                    | N s/m
// On a triangle of constant D, with the edges a = x1 - x0, b = x2 - x0 and their metric g (2 x 2), D_kl = (dg_kl/dt)/2
// and
//     T = 2 shear g^-1 D g^-1 + (dilatation - shear) (g^-1 : D) g^-1
//     F_1 = -A (T_11 a + T_12 b),  F_2 = -A (T_12 a + T_22 b),  F_0 = -F_1 - F_2.
// The forces are linear in the velocities, with a symmetric matrix; they have no resultant force or torque and vanish
// for any rigid motion. The power -F.v = A tau:D is dissipated; in an orthonormal frame of the triangle
//     A tau:D = A (shear ((D_xx - D_yy)^2 + (2 D_xy)^2) + dilatation (D_xx + D_yy)^2),
// three squares of rates linear in v, from which the damping matrix C of F = -C v follows. A broken triangle has no
// viscous forces. With a sheet law this is a Kelvin-Voigt membrane, which recovers its shape in the time shear/Gs.
//
// Optional shear thinning (P. J. Carreau, Trans. Soc. Rheol. 16 (1972) 99; for red cells: Tran-Son-Tay, Sutera, Rao,
// Biophys. J. 46 (1984) 65, whose viscosity halves from 29 to 57 1/s), with the shear rate of the triangle,
// q = sqrt((D_xx - D_yy)^2 + (2 D_xy)^2):
//     shear (1 + (q/rate)^2)^((index - 1)/2)          in place of shear; proportional to q^(index - 1) from about 2
//                                                     rate on
// rate  | shear rate from which the membrane thins          | 1/s
// index | index of the power law beyond; 1: Newtonian       | 1
// The shear rate is computed from separate velocities u, those with which the nodes came to x, so that the forces stay
// linear in v and C stays as above.
#pragma once
#include <optional>

#include "core/settings.hpp"
#include "membrane/network.hpp"
#include "membrane/stiffness.hpp"

namespace corpuscle::membrane {

struct ShearThinning {
    double rate = 0, index = 1;

    double factor(double shearRate) const;  // of the viscosity
    static const Schema<ShearThinning>& schema();
};

// State of the nodes: positions x [m], and the velocities u [m/s] whose shear rates determine the viscosity.
struct SurfaceMotion {
    std::span<const Vec3> x, u;
};

struct SurfaceViscosity {
    double shear = 0, dilatation = 0;  // N s/m
    std::optional<ShearThinning> thinning = {};

    double shearAt(double shearRate) const { return thinning ? shear * thinning->factor(shearRate) : shear; }  // N s/m
    // Adds the forces for the velocities v [m/s] to f [N].
    void addForces(const Network& network, const SurfaceMotion& motion, std::span<const Vec3> v,
                   std::span<Vec3> f) const;
    // Adds C [N s/m], symmetric and positive semi-definite triangle by triangle.
    void addDamping(const Network& network, const SurfaceMotion& motion, Stiffness& damping) const;
    static const Schema<SurfaceViscosity>& schema();
};

}  // namespace corpuscle::membrane
