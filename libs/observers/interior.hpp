// Where the fluid is now that filled each cell at the start: the fluid particles whose side is n, for cell number n.
//
// inside   | all of them, wherever they are: constant in time
// released | those outside the surface of a broken cell, its holes closed by fans over their rims: fluid that has gone
//          | out through holes and has not come back
// leaked   | those outside the surface of a whole cell: particles that have slipped between nodes, until the leakage
//          | guard moves them back to their side. A numerical error, not a release; the guard also moves them back
//          | before a cell opens
#pragma once
#include <vector>

#include "coupling/scene.hpp"

namespace corpuscle::observers {

struct Interior {
    double mass = 0;            // inside, kg
    double released = 0;        // particles
    double releasedMass = 0;    // kg
    double releasedVolume = 0;  // sum of m/rho, m^3
    double leaked = 0;          // particles

    double haemolysisIndex() const { return mass > 0 ? 100 * releasedMass / mass : 0; }  // per cent
};

// For each cell of the scene, on every rank. Collective.
std::vector<Interior> interiors(const coupling::Scene& scene);
Interior total(const std::vector<Interior>& cells);

}  // namespace corpuscle::observers
