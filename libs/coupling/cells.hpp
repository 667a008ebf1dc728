// The cells of a scene, of which each rank holds those that come near its brick.
//
// A cell is held by every rank of whose brick it comes within `margin`: they all have its network and the places of its
// nodes, and compute the same forces, bit for bit. All holders know who the others are. The lowest of them is the
// cell's owner: it speaks for the cell where each is to count once. Other ranks know no more of it than its type and
// where it began.
//
// Numbers go through the types, and within each through its places: cell n of the scene is cell n on every rank, in
// results and in the field `side` of the particles inside it.
#pragma once
#include <map>
#include <utility>
#include <vector>

#include "coupling/cell.hpp"
#include "particles/particleSystem.hpp"

namespace corpuscle::coupling {

class Cells {
  public:
    static constexpr double everywhere = 1e30;  // margin with which every rank holds every cell [m]

    Cells() = default;
    // Nothing is held yet. margin [m].
    explicit Cells(std::vector<CellType> types, double margin = everywhere);

    bool exist() const { return count_ > 0; }     // in the scene, whoever holds them
    std::size_t count() const { return count_; }  // in the scene
    std::size_t nodeCount() const { return nodes_; }
    const std::vector<CellType>& types() const { return types_; }
    // By the number of a cell, 1 and up; and by that of a node.
    std::size_t typeOf(int number) const;
    std::string nameOf(int number) const;                     // of its type, with its own number where that has several
    std::pair<int, int> cellOfNode(std::int64_t node) const;  // number of the cell, and node in it
    double meanBondLength() const;                            // the largest of all types [m]

    // Those that this rank holds, in the order of their numbers.
    auto begin() { return held_.begin(); }
    auto end() { return held_.end(); }
    auto begin() const { return held_.begin(); }
    auto end() const { return held_.end(); }
    Cell& operator[](std::size_t index) { return held_[index]; }
    const Cell& operator[](std::size_t index) const { return held_[index]; }
    std::size_t heldCount() const { return held_.size(); }
    static constexpr std::size_t notHeld = static_cast<std::size_t>(-1);
    std::size_t indexOf(int number) const;  // among these, or notHeld
    Cell* find(int number);                 // null: this rank does not hold it
    const Cell* find(int number) const;

    // As it stands at the start, at rest.
    Cell make(int number) const;
    std::vector<Vec3> startingNodes(int number) const;
    void setSolidVolume(int number, double volume) { solidVolume_[number] = volume; }  // before cells are made
    double solidVolume(int number) const;

    // Those that come near this rank's brick, as they stand at the start.
    void placeAtStart(const particles::ParticleSystem& system);
    // Those given, which nobody else has: of a checkpoint. Until the next settle, or resettle by their `reach`.
    void take(std::vector<Cell> cells, int rank);
    // Who holds which cell now that nodes have moved or bricks have been cut: hands the state of cells to those who
    // hold them from now on. Collective.
    void settle(const particles::ParticleSystem& system);
    // The same by the reach that each cell had when it was settled last.
    void resettle(const particles::ParticleSystem& system);
    // The first, where lists have been built since the last of these. Collective.
    void follow(const particles::ParticleSystem& system) {
        if (system.builds() != settledAt_) settle(system);
    }

    // A cell that every rank holds, of a type of its own: for scenes that are made by hand.
    void add(Cell cell);

  private:
    std::vector<int> holdersOf(const geometry::Bounds& reach, const particles::ParticleSystem& system) const;
    std::vector<double> packed(const Cell& cell) const;
    Cell unpacked(const std::vector<double>& message, std::size_t& at) const;

    std::vector<CellType> types_;
    double margin_ = everywhere;
    long settledAt_ = -1;  // of the system's builds
    std::size_t count_ = 0, nodes_ = 0;
    std::map<int, double> solidVolume_;  // of the cells that have bodies in them
    std::vector<Cell> held_;
};

}  // namespace corpuscle::coupling
