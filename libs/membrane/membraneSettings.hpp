// One entry of constant/membranes.yaml: which laws a membrane has. A law that is not named does not exist: no
// storage, no pass.
#pragma once
#include "core/registry.hpp"
#include "membrane/angleLaw.hpp"
#include "membrane/areaConstraint.hpp"
#include "membrane/bendingLaw.hpp"
#include "membrane/bondLaw.hpp"
#include "membrane/ruptureLaw.hpp"
#include "membrane/surfaceViscosity.hpp"
#include "membrane/triangleLaw.hpp"
#include "membrane/volumeConstraint.hpp"

namespace corpuscle::membrane {

struct InteriorSettings {
    double viscosityRatio = 1;  // lambda = mu_in/mu_out
    static const Schema<InteriorSettings>& schema();
};

struct MembraneSettings {
    InteriorSettings interior;
    std::optional<std::string> stressFree;  // file of the shape without tension; empty: the mesh's own
    Choice<BondLaw> bonds;                  // empty: none; at least one of bonds and triangles is there
    Choice<TriangleLaw> triangles;          // empty: none
    Choice<AngleLaw> angles;                // empty: none
    Choice<BendingLaw> bending;             // empty: none
    std::optional<AreaConstraint> area;
    std::optional<VolumeConstraint> volume;
    std::optional<SurfaceViscosity> viscosity;
    Choice<RuptureLaw> rupture;  // empty: bonds never break
    // Of the sheet at small strain, what all laws add: bonds as a hexagonal network of this edge [m], closed form.
    SurfaceModuli moduli(double edge) const;
    static const Schema<MembraneSettings>& schema();
};

}  // namespace corpuscle::membrane
