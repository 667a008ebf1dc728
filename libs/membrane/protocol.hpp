// Family of the protocols of membraneRelax: what is done to a membrane without fluid, stage by stage, and what is
// measured.
//
// Each stage defines the loads; the equilibrium under them (equilibrium.hpp) is sought from that of the previous stage.
// The cell lies as its shape is defined: axis along z, centre at the origin.
#pragma once
#include <string>
#include <vector>

#include "membrane/equilibrium.hpp"

namespace corpuscle::membrane {

class Protocol {
  public:
    static constexpr const char* familyName = "relaxation protocol";
    virtual ~Protocol() = default;
    virtual int stages() const = 0;
    // Loads of a stage (0, 1, ...); may displace nodes first. Throws Failure(invalidCase) for an unsuitable membrane.
    virtual Loads apply(int stage, Membrane& membrane) const = 0;
    virtual std::string describe(int stage) const = 0;  // "60 pN"
    // Columns in addition to those of every protocol (area, volume, energy); `measure` gives their values in
    // equilibrium.
    struct Column {
        std::string name, unit, meaning;  // unit: "m2"; empty: dimensionless
        std::string header() const { return unit.empty() ? name : name + "_" + unit; }
    };
    virtual std::vector<Column> columns() const = 0;
    // Columns of every protocol, before and after its own.
    static std::vector<Column> columnsBefore() { return {{"stage", "", "number of the stage, 0 and up"}}; }
    static std::vector<Column> columnsAfter() {
        return {{"area", "m2", "area of the membrane"},
                {"volume", "m3", "enclosed volume; 0: the membrane is open"},
                {"areaStrain", "", "area over that of the mesh, less 1"},
                {"volumeStrain", "", "volume over that of the mesh, less 1"},
                {"energy", "J", "elastic energy of the membrane"},
                {"iterations", "", "iterations until equilibrium"},
                {"residual", "N", "largest force on a node that is left"}};
    }
    virtual std::vector<double> measure(int stage, const Membrane& membrane) const = 0;
};

// For each node, whether it lies on a border of the original mesh.
inline std::vector<char> borderNodes(const Network& network) {
    std::vector<char> border(network.nodeCount(), 0);
    for (const Bond& bond : network.allBonds()) {
        const auto [left, right] = network.bondTriangles(bond.number);
        if (left < 0 || right < 0) {
            border[bond.node[0]] = border[bond.node[1]] = 1;
        }
    }
    return border;
}

}  // namespace corpuscle::membrane
