// Micropipette aspiration: a pipette along z stands on top of the membrane and aspirates it in stages (the energies of
// glass and suction are in pipette.hpp).
//
// symbol  | key       | meaning                                             | unit
// P       | pressures | suction of each stage                               | Pa
// R       | radius    | inner radius of the pipette                         | m
// w       | wall      | wall thickness; the end is round with radius w/2    | m
// c       | softness  | depth of nodes in the glass at the largest P        | m
// The mouth stands where the stress-free shape touches the glass. There is no friction. Cells need laws that hold their
// volume and area (keys volume, area); the border of a flat sheet stays in its plane.
// Measured: L, the length from the mouth to the tip of the tongue (the aspirated part), and L/R.
// For a flat sheet that keeps its area, with W = Gs/2 (l^2 + l^-2 - 2), no bending, and a tongue with a hemispherical
// cap,
//     P R/Gs = 2 L/R - 1 + ln(2 L/R)           (Evans, Biophys. J. 13, 941 (1973); Chien and others, Biophys. J. 24,
//                                              463 (1978))
// and for a surface of constant tension T on a sphere of radius Rc, P = 2 T (1/R - 1/Rc) at L = R.
#pragma once
#include <optional>

#include "core/settings.hpp"
#include "membrane/pipette.hpp"
#include "membrane/protocol.hpp"

namespace corpuscle::membrane {

struct Aspiration : Protocol {
    std::vector<double> pressures;     // Pa
    double radius = 0, wall = 0;       // m
    std::optional<double> softness{};  // m; empty: R/50

    int stages() const override { return static_cast<int>(pressures.size()); }
    Loads apply(int stage, Membrane& membrane) const override;
    std::string describe(int stage) const override;
    std::vector<Column> columns() const override;
    // Throws Failure(numerics) where the membrane has gone through the glass.
    std::vector<double> measure(int stage, const Membrane& membrane) const override;
    static const Schema<Aspiration>& schema();

  private:
    Pipette pipette(const Membrane& membrane) const;
};

}  // namespace corpuscle::membrane
