// The cells of a scene; each rank holds those near its brick.
//
// A rank holds a cell if the cell comes within `margin` of its brick. All holders have the network and the node
// positions of the cell and compute the same forces, bit for bit; each knows the other holders. The lowest holder is
// the owner of the cell, which counts it in sums over all cells. Other ranks know only its type and where it started.
//
// Cells are numbered type by type, and within a type in the order of its places: cell n of the scene is cell n on every
// rank, in results and in the field `side` of the particles inside it.
#pragma once
#include <map>
#include <utility>
#include <vector>

#include "coupling/cell.hpp"
#include "particles/particleSystem.hpp"

namespace corpuscle::coupling {

class Cells {
  public:
    static constexpr double everywhere = 1e30;  // margin for which every rank holds every cell [m]

    Cells() = default;
    // The rank holds no cell yet. margin [m].
    explicit Cells(std::vector<CellType> types, double margin = everywhere);

    bool exist() const { return count_ > 0; }     // in the scene, held by this rank or not
    std::size_t count() const { return count_; }  // in the scene
    std::size_t nodeCount() const { return nodes_; }
    const std::vector<CellType>& types() const { return types_; }
    // number: of a cell, from 1. node: global number of a node.
    std::size_t typeOf(int number) const;
    std::string nameOf(int number) const;  // name of its type, followed by its number if the type has several cells
    std::pair<int, int> cellOfNode(std::int64_t node) const;  // number of the cell, and number of the node in it
    double meanBondLength() const;                            // the largest of all types [m]
    bool canRupture() const;                                  // whether any type has a rupture law
    bool havePores() const;                                   // whether any type has a pore law

    // The cells that this rank holds, in the order of their numbers.
    auto begin() { return held_.begin(); }
    auto end() { return held_.end(); }
    auto begin() const { return held_.begin(); }
    auto end() const { return held_.end(); }
    Cell& operator[](std::size_t index) { return held_[index]; }
    const Cell& operator[](std::size_t index) const { return held_[index]; }
    std::size_t heldCount() const { return held_.size(); }
    static constexpr std::size_t notHeld = static_cast<std::size_t>(-1);
    std::size_t indexOf(int number) const;  // index of a held cell, or notHeld
    Cell* find(int number);                 // null: this rank does not hold it
    const Cell* find(int number) const;

    // The cell as it is at the start, at rest.
    Cell make(int number) const;
    std::vector<Vec3> startingNodes(int number) const;
    void setSolidVolume(int number, double volume) { solidVolume_[number] = volume; }  // before cells are made
    double solidVolume(int number) const;

    // Makes the cells near this rank's brick, as they are at the start.
    void placeAtStart(const particles::ParticleSystem& system);
    // Takes cells of a checkpoint that this rank alone holds, until the next `settle`, or `resettle` by their `reach`.
    void take(std::vector<Cell> cells, int rank);
    // Determines the holders of each cell after nodes have moved or the box has been cut into new bricks, and sends the
    // state of cells to their new holders. Collective.
    void settle(const particles::ParticleSystem& system);
    // The same, but by the `reach` that each cell had at the last `settle`. Collective.
    void resettle(const particles::ParticleSystem& system);
    // `settle`, if lists have been built since holders were last determined. Collective.
    void follow(const particles::ParticleSystem& system) {
        if (system.builds() != settledAt_) settle(system);
    }

    // Adds a cell that every rank holds, with a type of its own: for scenes that are not built from a case.
    void add(Cell cell);

  private:
    std::vector<int> holdersOf(const geometry::Bounds& reach, const particles::ParticleSystem& system) const;
    std::vector<double> packed(const Cell& cell) const;
    Cell unpacked(const std::vector<double>& message, std::size_t& at) const;

    std::vector<CellType> types_;
    double margin_ = everywhere;
    long settledAt_ = -1;  // count of the system's list builds when holders were last determined
    std::size_t count_ = 0, nodes_ = 0;
    std::map<int, double> solidVolume_;  // by number of the cell, for cells with rigid bodies inside [m^3]
    std::vector<Cell> held_;
};

}  // namespace corpuscle::coupling
