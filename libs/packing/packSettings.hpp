// system/pack.yaml: which cells of a case cellPack places, and how closely.
//
//     cells:
//       - {name: redCell, haematocrit: 0.3}
//       - {name: platelet, number: 12, orientation: {type: aligned, axis: [1, 0, 0]}}
//     gap: 0.25 dx
//     seed: 1
#pragma once
#include <optional>

#include "packing/orientation.hpp"

namespace corpuscle::packing {

struct PackedTypeSettings {
    std::string name;
    std::optional<long> number;
    std::optional<double> haematocrit;  // volume of these cells over the volume between the walls
    Choice<Orientation> orientation;
    static const Schema<PackedTypeSettings>& schema();
};

struct PackSettings {
    std::vector<PackedTypeSettings> cells;
    Length gap;
    long seed = 1;
    static const Schema<PackSettings>& schema();
};

}  // namespace corpuscle::packing
