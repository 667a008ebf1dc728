// Transport of a solute relative to the fluid that carries it (sph/solute.hpp): diffusion within the fluid
// (sph/diffusion.hpp), and passage through the pores of membranes (membrane/poreLaw.hpp). Around a node with pores
//
//     dm = A (alpha c_in - beta c_out)/(1 + 2 k dx min(alpha, beta)/D) dt
//     c_in = sum_j w_j q_j / sum_j w_j V_j over fluid in the cell, c_out outside
// symbol | meaning                                                                                          | unit
// dm     | mass of the solute that leaves the cell there                                                    | kg
// A      | area of the node                                                                                 | m^2
// alpha, beta | speeds of passage with the pores, and the pressure difference, of the node (PoreFlux)       | m/s
// w      | W(|x_j - x|/R), Wendland C2, R = 2 dx                                                            | -
// q, V   | mass of the solute that a fluid particle carries, its volume m/rho0                              | kg, m^3
// k      | 0.45, fitted to diffusion out of spheres (tests/coupling/soluteTransport.cpp): the solute is not
//        | taken at the membrane but from the layer R beside it, where c_in differs from the concentration at
//        | the membrane by k dx J/D; 0 without diffusion. A continuous layer would give
//        | k dx = int w z dz + int S (1 - S) dz = 0.586 dx, with the part S of w that is nearer than z      | -
// What leaves is taken from the particles inside in proportion to w q, and given to those outside in proportion to w V,
// and the other way round for what enters; so no particle can have less than nothing, and nothing is lost. A node
// without fluid on both sides within R passes nothing. The pressure difference is that which the elastic forces of the
// membrane hold (membrane/diagnostics.hpp). A torn cell has no open pores: it loses its solute through its holes.
//
// A step is divided into equal parts so that no particle passes on more than half of what it has. The volume of the
// fluid that flows through pores is not taken from the cell.
//
// Fluid that has left a torn cell keeps to its side: its solute goes where it goes, but does not diffuse into the fluid
// outside.
#pragma once
#include <vector>

#include "coupling/holderSums.hpp"
#include "sph/diffusion.hpp"

namespace corpuscle::coupling {

class SoluteTransport {
  public:
    static constexpr double radiusInSpacings = 2;

    // Distance from its brick up to which a rank needs cells with pores [m].
    static double margin(double spacing, double skin) { return radiusInSpacings * spacing + skin; }

    // model: of a fluid with a solute.
    SoluteTransport(const sph::FluidModel& model, const particles::ParticleSystem& system);

    // Moves the solute for dt [s], at the present positions and membrane forces, to which pores open or reseal first;
    // lists must be up to date. rest: time from these positions to the end of the step, for `arrive` [s]. Throws
    // Failure(numerics), on all ranks, if the step would take far too many parts. Collective.
    void advance(Cells& cells, particles::ParticleSystem& system, double dt, double rest = 0);
    // Lets pores open or reseal up to the end of the step.
    void arrive(Cells& cells);

    double concentration(const particles::ParticleStore& s, std::size_t i) const { return s.solute[i] / volume(s, i); }
    double volume(const particles::ParticleStore& s, std::size_t i) const {  // m/rho0 [m^3]
        return (s.optional().mass ? s.mass[i] : mass_) / density_;
    }
    const sph::Solute& solute() const { return solute_; }
    long mostParts() const { return mostParts_; }  // of any step so far

  private:
    struct Near {
        int particle;
        double weight;
        bool inside;
    };
    struct Node {
        std::size_t row;                 // among the nodes of the held cells
        std::size_t first, last;         // in near_
        double outward = 0, inward = 0;  // A alpha, A beta [m^3/s]
    };
    void findNodes(const Cells& cells, const particles::ParticleSystem& system);
    void findPassage(const particles::ParticleStore& s);
    double largestSpeed() const;

    sph::Solute solute_;
    double mass_, density_, viscosity_, radius_;
    sph::Diffusion diffusion_;
    HolderSums holders_;
    std::size_t rows_ = 0;
    std::vector<Node> nodes_;  // with open pores
    std::vector<Near> near_;
    std::vector<double> sums_;                             // of each row: sum w V and sum w q inside, the same outside
    std::vector<double> concentrations_, rates_, speeds_;  // of the particles; dq/dt, and greatest part passed on [1/s]
    bool isOpen_ = false;                                  // whether any cell of the scene has open pores
    double rest_ = 0;
    long mostParts_ = 0;
};

}  // namespace corpuscle::coupling
