// Moduli and anisotropy of an actual network, in addition to the closed form for a hexagonal one.
//
// A homogeneous small strain eps in the tangent plane stretches a bond of direction n by l n.eps.n (affine motion,
// Cauchy-Born). Over a neighbourhood of area A, where each bond belongs half to each of its two triangles, the energy
// per area is
//     W = 1/2 sum_b w_b (n.eps.n)^2,   w_b = E''(l0) l0^2/(2 A)
// With M_m = sum_b w_b exp(i m phi_b), where phi_b is the direction of the bond in the plane:
//     Ks = M_0/4      Gs(psi) = (M_0 + Re M_4 e^(-4 i psi))/8      (shear along psi; mean M_0/8)
//     axial stiffness C_nnnn(psi) = 3/8 M_0 + 1/2 Re M_2 e^(-2 i psi) + 1/8 Re M_4 e^(-4 i psi)      (mean Ks + Gs)
// Ks = 2 Gs for every network of bonds (Cauchy's relation). The neighbourhood of a triangle consists of this triangle
// and all triangles that share a node with it, laid flat in its plane.
//
// These moduli are upper bounds: nodes of an irregular network deviate from the affine motion, which makes the network
// softer, the more so the more irregular it is; on a regular lattice the bound is exact. A relaxed modulus would need a
// periodic flat sheet, which a closed mesh does not provide. A triangle law adds its own isotropic Gs and Ks to those
// of the bonds, exactly. Angle, area and bending laws are not included.
#pragma once
#include <string>

#include "membrane/membraneSettings.hpp"

namespace corpuscle::membrane {

struct NetworkModuli {
    SurfaceModuli closedForm;        // hexagonal network with the mean rest length, and triangle law, N/m
    double area = 0, shear = 0;      // means over the surface, N/m
    double deviation = 0;            // of Gs over the surface: standard deviation relative to the mean
    double lowest = 0, highest = 0;  // of the local mean shear modulus, N/m
    double shearAnisotropy = 1;      // mean over the surface of (least/greatest Gs over the directions); 1: isotropic
    double axialAnisotropy = 1;      // the same for C_nnnn
    double worstShearAnisotropy = 1, worstAxialAnisotropy = 1;  // least over the surface
};

// Moduli of the whole triangles in the stress-free state; zero if no whole triangle is left.
NetworkModuli measureModuli(const Network& network, const MembraneSettings& laws);

// A few lines for logs and checkCase.
std::string describe(const NetworkModuli& moduli);
// Constants of the in-plane laws and their moduli in closed form, for bonds of this length [m].
std::string describeConstants(const MembraneSettings& laws, double edge);

}  // namespace corpuscle::membrane
