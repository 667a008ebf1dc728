// Stretching by optical tweezers: two beads stuck to opposite ends of the rim along x are pulled apart by a force F
// each.
//
//     nodes whose stress-free place lies within contact/2 of the outermost node at either end share F by their
//         stress-free areas
// symbol  | meaning                              | unit
// forces  | F of each stage                      | N
// contact | diameter of a bead's contact area    | m
// The forces are dead loads: no coordinate is held, and the contact areas may turn.
// Read off: axial diameter, between the mean places of the contact areas' outermost nodes (extent along x), and
// transverse diameter, the extent along y, in the plane of the disc.
// Experiment: Mills, Qie, Dao, Lim, Suresh, Mol. Cell. Biomech. 1 (2004) 169; contact about 2 um across.
#pragma once
#include "core/settings.hpp"
#include "membrane/protocol.hpp"

namespace corpuscle::membrane {

struct Tweezers : Protocol {
    std::vector<double> forces;  // N
    double contact = 0;          // m

    int stages() const override { return static_cast<int>(forces.size()); }
    Loads apply(int stage, Membrane& membrane) const override;
    std::string describe(int stage) const override;
    std::vector<Column> columns() const override;
    std::vector<double> measure(int stage, const Membrane& membrane) const override;
    static const Schema<Tweezers>& schema();
};

}  // namespace corpuscle::membrane
