// A cell of the scene: its membrane, and what belongs to the pair of membrane and fluid.
//
// Every rank knows every cell's network; the ranks whose bricks a cell touches hold it: they have its node positions of
// now and compute its forces. The others' copy of the state is old and must not be read.
#pragma once
#include <string>
#include <vector>

#include "membrane/membrane.hpp"
#include "particles/box.hpp"

namespace corpuscle::coupling {

struct Cell {
    membrane::Membrane membrane;                // membrane.cell: its number, 1 and up
    std::string type;                           // entry of constant/membranes.yaml
    double radius = 0;                          // a [m]
    double viscosityRatio = 1;                  // mu_in/mu_out
    int firstNode = 0;                          // global number of its node 0: field `node` of the store
    double initialArea = 0, initialVolume = 0;  // at t = 0 [m^2, m^3]
    std::vector<double> nodeMass{};             // of each node as a particle [kg]
    bool held = true;
    double solidVolume = 0;  // of rigid bodies inside [m^3]

    int nodeCount() const { return static_cast<int>(membrane.position.size()); }
};

inline Vec3 middleOf(const Cell& cell) {  // of its bounds
    Vec3 low = cell.membrane.position.front(), high = low;
    for (const Vec3& p : cell.membrane.position) low = low.cwiseMin(p), high = high.cwiseMax(p);
    return 0.5 * (low + high);
}

}  // namespace corpuscle::coupling
