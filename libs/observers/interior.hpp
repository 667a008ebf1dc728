// What became of the fluid that filled each cell at the start: the fluid particles of its side n.
//
// inside   | of all of them, wherever they are: constant in time
// released | of those outside the surface of a broken cell, its holes closed by fans over their rims: what went out
//          | through holes (and came not back)
// leaked   | those outside the surface of a whole cell: particles that squeezed between nodes, until the leakage guard
//          | puts them back. An error of the numerics and no release; the guard puts them back before a cell opens, too
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

// Of each cell of the scene, on every rank. Collective.
std::vector<Interior> interiors(const coupling::Scene& scene);
Interior total(const std::vector<Interior>& cells);

}  // namespace corpuscle::observers
