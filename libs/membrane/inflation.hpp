// Inflation of a closed membrane by a pressure difference p, inside minus outside, which acts as a follower load.
// Measured: mean radius (3 V/(4 pi))^(1/3) and its ratio to that of the stress-free shape.
// For a sphere of stress-free radius a and stretch l the laws have closed forms; neo-Hookean: p a/Gs = 2 (1 - l^-6)/l.
#pragma once
#include "core/settings.hpp"
#include "membrane/protocol.hpp"

namespace corpuscle::membrane {

struct Inflation : Protocol {
    std::vector<double> pressures;  // Pa

    int stages() const override { return static_cast<int>(pressures.size()); }
    Loads apply(int stage, Membrane& membrane) const override;
    std::string describe(int stage) const override;
    std::vector<Column> columns() const override;
    std::vector<double> measure(int stage, const Membrane& membrane) const override;
    static const Schema<Inflation>& schema();
};

}  // namespace corpuscle::membrane
