// system/relax.yaml: one cell, what is done to it, and how closely its equilibria are found.
#pragma once
#include "membrane/protocol.hpp"
#include "simulation/caseSettings.hpp"

namespace corpuscle::simulation {

struct RelaxSettings {
    CellSettings cell;
    Choice<membrane::Protocol> protocol;
    double tolerance = 1e-6;  // of the largest load, or of forceScale
    double forceScale = 0;    // N; for stages without loads
    long iterations = 500;    // of Newton's method, each stage
    static const Schema<RelaxSettings>& schema();
};

}  // namespace corpuscle::simulation
