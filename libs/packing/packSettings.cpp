#include "packing/packSettings.hpp"

namespace corpuscle::packing {

const Schema<PackedTypeSettings>& PackedTypeSettings::schema() {
    static const Schema<PackedTypeSettings> s =
        Schema<PackedTypeSettings>("packed type", "how many cells of one type of system/mesh.yaml are put in place")
            .name("name", &PackedTypeSettings::name, "of its entry in system/mesh.yaml, which names the table to write")
            .integer("number", &PackedTypeSettings::number, "of cells", {.range = atLeast(1)})
            .quantity("haematocrit", &PackedTypeSettings::haematocrit, unit::none,
                      "their volume, over that between the walls", {.range = between(1e-9, 0.9)})
            .exactlyOneOf({"number", "haematocrit"})
            .model("orientation", &PackedTypeSettings::orientation, "how they are turned", {.fallback = "random"});
    return s;
}

const Schema<PackSettings>& PackSettings::schema() {
    static const Schema<PackSettings> s =
        Schema<PackSettings>("pack", "system/pack.yaml: which cells cellPack puts in place, and how closely")
            .list("cells", &PackSettings::cells, "the types that are packed")
            .length("gap", &PackSettings::gap, "least distance of surfaces from each other and from walls",
                    {.fallback = "0.25 dx", .range = positive})
            .integer("seed", &PackSettings::seed, "of the random numbers", {.fallback = "1", .range = nonNegative});
    return s;
}

}  // namespace corpuscle::packing
