// One entry of constant/membranes.yaml: which laws a membrane has. A law that is not named does not exist: no
// storage, no pass.
#pragma once
#include "core/registry.hpp"
#include "membrane/angleLaw.hpp"
#include "membrane/bendingLaw.hpp"
#include "membrane/bondLaw.hpp"
#include "membrane/ruptureLaw.hpp"

namespace corpuscle::membrane {

struct InteriorSettings {
    double viscosityRatio = 1;  // lambda = mu_in/mu_out
    static const Schema<InteriorSettings>& schema();
};

struct MembraneSettings {
    InteriorSettings interior;
    Choice<BondLaw> bonds;
    Choice<AngleLaw> angles;     // empty: none
    Choice<BendingLaw> bending;  // empty: none
    Choice<RuptureLaw> rupture;  // empty: bonds never break
    static const Schema<MembraneSettings>& schema();
};

}  // namespace corpuscle::membrane
