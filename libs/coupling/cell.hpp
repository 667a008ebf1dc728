// A cell of the scene (`Cell`): its membrane and the data of its coupling to the fluid; and what all cells of one type
// have in common (`CellType`).
#pragma once
#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "coupling/arc.hpp"
#include "geometry/crossings.hpp"
#include "geometry/place.hpp"
#include "membrane/membrane.hpp"
#include "particles/box.hpp"

namespace corpuscle::coupling {

// An entry of `cells` in system/mesh.yaml: one mesh and one set of laws, used by all cells of this type. Every rank
// knows the starting places of all cells; of cells that it does not hold it knows nothing else.
struct CellType {
    std::string name;                       // of the entry, of 0/<name>.vtp and of its results
    std::string laws;                       // name of its entry in constant/membranes.yaml
    std::vector<Vec3> nodes;                // positions as in 0/<name>.vtp
    std::vector<Index3> triangles;          // of these nodes
    std::vector<Vec3> stressFree{};         // stress-free positions of the nodes; empty: as `nodes`
    membrane::MembraneSettings settings;    // the laws
    double radius = 0;                      // a [m]
    double viscosityRatio = 1;              // mu_in/mu_out
    std::vector<double> nodeMass{};         // of each node as a particle [kg]; empty if nodes are no particles
    std::vector<geometry::Place> places{};  // where each cell starts

    // Set by Cells: number of the first cell of this type, from 1; number of that cell's first node, from 0; network
    // and laws that its cells of scale 1 share.
    int firstCell = 1, firstNode = 0;
    std::shared_ptr<membrane::MembraneType> membrane{};

    double extent() const {  // largest distance of a node from the centre of the cell, at scale 1 [m]
        double farthest = 0;
        for (const Vec3& x : nodes) farthest = std::max(farthest, x.norm());
        return farthest;
    }
};

struct Cell {
    membrane::Membrane membrane;                // membrane.cell: number of the cell, from 1
    std::size_t type = 0;                       // index of its type in Cells::types
    double radius = 0;                          // a [m]
    int firstNode = 0;                          // global number of its node 0, as in the field `node` of the store
    double initialArea = 0, initialVolume = 0;  // at t = 0 [m^2, m^3]
    std::vector<double> nodeMass{};             // of each node as a particle [kg]
    double solidVolume = 0;                     // of rigid bodies inside [m^3]
    Arc arc{};                                  // moves its nodes off the chord within a step; zero between steps

    std::vector<int> holders{0};  // ranks that hold it, ascending; the first is its owner
    geometry::Bounds reach{};     // bounds of its nodes when its holders were last determined

    // Node positions at the beginning of a step, `seconds` before the present positions x* (Immersed::depart).
    std::vector<Vec3> departure(double seconds) const {
        std::vector<Vec3> x = membrane.position;
        for (std::size_t n = 0; n < x.size(); ++n) x[n] = arc.toChord(x[n]) - seconds * membrane.velocity[n];
        return x;
    }

    int nodeCount() const { return static_cast<int>(membrane.position.size()); }
    // Whether `rank` is the owner, which counts the cell in sums over all cells.
    bool isOwnedBy(int rank) const { return holders.front() == rank; }
};

// The lowest rank in both lists of holders; -1: there is none. An empty list stands for all ranks.
inline int lowestCommonHolder(const std::vector<int>& one, const std::vector<int>& other) {
    if (one.empty() || other.empty())
        return one.empty() && other.empty() ? 0 : one.empty() ? other.front() : one.front();
    for (const int r : one)
        if (std::binary_search(other.begin(), other.end(), r)) return r;
    return -1;
}

inline Vec3 middleOf(const Cell& cell) { return geometry::boundsOf(cell.membrane.position).center(); }

// Name of a cell: that of its type, with the number of the cell added where the type has several.
inline std::string nameOfCell(const std::string& type, std::size_t count, int number) {
    return count == 1 ? type : type + " " + std::to_string(number);
}

}  // namespace corpuscle::coupling
