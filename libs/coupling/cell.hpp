// A cell of the scene: its membrane, and what belongs to the pair of membrane and fluid. What cells of one type have in
// common.
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

// An entry of `cells` in system/mesh.yaml: one mesh and one set of laws, placed as often as the case says. Every rank
// knows the places of all cells, and nothing else of those that it does not hold.
struct CellType {
    std::string name;                       // of the entry, of 0/<name>.vtp and of its results
    std::string laws;                       // entry of constant/membranes.yaml
    std::vector<Vec3> nodes;                // as in 0/<name>.vtp
    std::vector<Index3> triangles;          // of these
    std::vector<Vec3> stressFree{};         // empty: the nodes
    membrane::MembraneSettings settings;    // the laws
    double radius = 0;                      // a [m]
    double viscosityRatio = 1;              // mu_in/mu_out
    std::vector<double> nodeMass{};         // of each node as a particle [kg]; none where nodes are no particles
    std::vector<geometry::Place> places{};  // of the nodes; one for each cell

    // By Cells: the number of its first cell, 1 and up, and of that cell's first node; what all of its cells share.
    int firstCell = 1, firstNode = 0;
    std::shared_ptr<membrane::MembraneType> membrane{};

    double extent() const {  // of the nodes around the centre of a place of scale 1: the farthest of them [m]
        double farthest = 0;
        for (const Vec3& x : nodes) farthest = std::max(farthest, x.norm());
        return farthest;
    }
};

struct Cell {
    membrane::Membrane membrane;                // membrane.cell: its number, 1 and up
    std::size_t type = 0;                       // which one
    double radius = 0;                          // a [m]
    int firstNode = 0;                          // global number of its node 0: field `node` of the store
    double initialArea = 0, initialVolume = 0;  // at t = 0 [m^2, m^3]
    std::vector<double> nodeMass{};             // of each node as a particle [kg]
    double solidVolume = 0;                     // of rigid bodies inside [m^3]
    Arc arc{};  // by which its nodes are off the chord of their step; none between steps

    std::vector<int> holders{0};  // ranks that hold it, ascending; the first of them is its owner
    geometry::Bounds reach{};     // of its nodes when it was last settled who holds it

    int nodeCount() const { return static_cast<int>(membrane.position.size()); }
    // Its owner counts it where every cell is to be counted once.
    bool isOwnedBy(int rank) const { return holders.front() == rank; }
};

// The lowest rank that holds both, -1: none does. Of what every rank holds the list is empty.
inline int lowestCommonHolder(const std::vector<int>& one, const std::vector<int>& other) {
    if (one.empty() || other.empty())
        return one.empty() && other.empty() ? 0 : one.empty() ? other.front() : one.front();
    for (const int r : one)
        if (std::binary_search(other.begin(), other.end(), r)) return r;
    return -1;
}

inline Vec3 middleOf(const Cell& cell) { return geometry::boundsOf(cell.membrane.position).center(); }

// What one cell is called: as its type, with its own number where the type has several.
inline std::string nameOfCell(const std::string& type, std::size_t count, int number) {
    return count == 1 ? type : type + " " + std::to_string(number);
}

}  // namespace corpuscle::coupling
