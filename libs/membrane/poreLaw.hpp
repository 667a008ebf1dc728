// Family of pore laws: how much of a membrane is open to a solute in pores that are far smaller than a triangle.
//
// A law gives the share of the present area that would be pores at rest, phi_eq, from the present shape; the pores
// follow with a time of their own:
//     dphi/dt = (phi_eq - phi)/tau,    tau: opening where phi_eq > phi, resealing otherwise (0: at once)
// The pores are holes of one radius through a layer, each with a resistance of its length and of its two mouths. The
// flux of the solute per area of the membrane, from inside to outside, is that of diffusion and of the flow through the
// pores together (steady, in one dimension; Patlak):
//     J = alpha c_in - beta c_out,    alpha = W q e^Pe/(e^Pe - 1),    beta = W q/(e^Pe - 1),    Pe = W q/P
//     P = phi/(L/(Phi Kd D) + pi r/(2 D)),    Phi Kd = (1 - l)^2 (1 - 2.104 l + 2.09 l^3 - 0.95 l^5),    l = rs/r
//     q = phi dp/(8 mu L/r^2 + 3 pi mu/r),    W = Phi (2 - Phi) (1 - 2/3 l^2 - 0.163 l^3),    Phi = (1 - l)^2
// symbol | meaning                                                                    | unit
// phi    | share of the membrane's present area that is pores                         | -
// r, L   | radius and length of a pore                                                | m
// rs, D  | radius of the solute's molecules, its diffusivity in the fluid             | m, m^2/s
// P      | permeability by diffusion alone; q: velocity of the fluid through the membrane, by dp/L and by Sampson's
//        | resistance of the two mouths                                               | m/s
// Phi    | steric partition, Kd: hindered diffusion in the pore, W: share of the solute that goes with the flow
// dp, mu | pressure inside less that outside, viscosity of the fluid outside           | Pa, Pa s
// Sources: Phi Kd, E. M. Renkin, J. Gen. Physiol. 38 (1954) 225, for l < 0.6; W, J. L. Anderson and J. A. Quinn,
// Biophys. J. 14 (1974) 130, for l < 0.4; mouths of a pore in diffusion, 1/(4 D r) each; in flow, R. A. Sampson, Phil.
// Trans. A 182 (1891) 449; both in series with the pore, Z. Dagan, S. Weinbaum, R. Pfeffer, J. Fluid Mech. 115 (1982)
// 505, who find the sum right to 1 %.
#pragma once
#include <span>
#include <vector>

#include "core/settings.hpp"
#include "membrane/network.hpp"

namespace corpuscle::membrane {

struct MembraneSettings;

// What passes through the pores.
struct PoreSolute {
    double radius = 0, diffusivity = 0;  // rs [m], D [m^2/s]
    double viscosity = 0;                // mu [Pa s]
};

// J = outward c_in - inward c_out.
struct PoreFlux {
    double outward = 0, inward = 0;  // alpha, beta [m/s]
};

class PoreLaw {
  public:
    static constexpr const char* familyName = "pore law";
    virtual ~PoreLaw() = default;

    double radius = 0, length = 0;      // of a pore [m]
    double opening = 0, resealing = 0;  // times [s]

    // phi_eq of each node with nodes at x; 0 for nodes of no whole triangle.
    virtual std::vector<double> atRest(const Network& network, const MembraneSettings& laws,
                                       std::span<const Vec3> x) const = 0;
    // phi after dt [s].
    double after(double share, double atRest, double dt) const;

    double permeability(double share, const PoreSolute& solute) const;   // P [m/s]
    double flow(double share, double pressure, double viscosity) const;  // q [m/s]
    PoreFlux flux(double share, double pressure, const PoreSolute& solute) const;

    // The keys of every law.
    static const Schema<PoreLaw>& schema();
};

// Mean over the whole triangles of each node, weighted with their present areas, of values of all triangles; 0 without
// a whole triangle.
std::vector<double> nodeMeans(const Network& network, std::span<const double> ofTriangles, std::span<const Vec3> x);

}  // namespace corpuscle::membrane
