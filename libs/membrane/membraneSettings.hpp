// One entry of constant/membranes.yaml: the laws of a membrane. A law that the entry does not name takes no storage and
// no loop.
#pragma once
#include "core/registry.hpp"
#include "membrane/angleLaw.hpp"
#include "membrane/areaConstraint.hpp"
#include "membrane/bendingLaw.hpp"
#include "membrane/bondLaw.hpp"
#include "membrane/poreLaw.hpp"
#include "membrane/rim.hpp"
#include "membrane/ruptureLaw.hpp"
#include "membrane/surfaceViscosity.hpp"
#include "membrane/triangleLaw.hpp"
#include "membrane/volumeConstraint.hpp"

namespace corpuscle::membrane {

struct InteriorSettings {
    double viscosityRatio = 1;            // lambda = mu_in/mu_out
    std::optional<double> concentration;  // of the solute at t = 0 [kg/m^3]; empty: 0
    static const Schema<InteriorSettings>& schema();
};

struct MembraneSettings {
    InteriorSettings interior;
    std::optional<std::string> stressFree;  // file of the stress-free shape; empty: that of the mesh
    Choice<BondLaw> bonds;                  // empty: none; at least one of bonds and triangles is given
    Choice<TriangleLaw> triangles;          // empty: none
    Choice<AngleLaw> angles;                // empty: none
    Choice<BendingLaw> bending;             // empty: none
    std::optional<AreaConstraint> area;
    std::optional<VolumeConstraint> volume;
    std::optional<SurfaceViscosity> viscosity;
    Choice<RuptureLaw> rupture;  // empty: bonds never break
    std::optional<Rim> rim;      // empty: no line tension
    Choice<PoreLaw> pores;       // empty: the membrane has none
    // Moduli of the sheet at small strain, summed over all laws; bonds count as a hexagonal network of this edge length
    // [m], in closed form.
    SurfaceModuli moduli(double edge) const;
    static const Schema<MembraneSettings>& schema();
};

}  // namespace corpuscle::membrane
