// What several observers need of cells.
//
// The state of a cell may be read only on the ranks that hold it, where it is bitwise the same. The owner of a cell
// computes its numbers, and every rank receives them.
#pragma once
#include <functional>
#include <optional>

#include "coupling/scene.hpp"
#include "geometry/boundsIndex.hpp"
#include "geometry/insideTest.hpp"
#include "observers/observer.hpp"

namespace corpuscle::observers {

// `count` numbers of each cell of the scene, [number of the cell - 1][number], on every rank; work(cell, out) runs on
// one rank per cell. Collective.
std::vector<std::vector<double>> ofEachCell(const coupling::Scene& scene, std::size_t count,
                                            const std::function<void(const coupling::Cell&, double* out)>& work);

// Tables of cells: one for each type, with a row for each of its cells, which begins with the number of the cell.
// rowsByType turns the result of ofEachCell into rows; `first` is the number of the table of the first type.
std::vector<Row> rowsByType(const coupling::Scene& scene, std::size_t first,
                            const std::vector<std::vector<double>>& ofCells);
std::vector<io::Column> cellTable(std::vector<io::Column> columns);

// The numbers of all ranks one after another, in the order of the ranks, on every rank. Collective.
std::vector<double> gatherNumbers(const coupling::Scene& scene, const std::vector<double>& own);

// The present surface of a held cell, closed by a fan over the rim of each hole; without nodes that belong to no whole
// triangle. Empty if every triangle is broken.
geometry::TriangleMesh closedSurface(const coupling::Cell& cell);

// On which side of the membranes particles really are, whatever their `side` says: tests positions against the closed
// surfaces of the cells that this rank holds. Right for all particles of this rank: all of their periodic images that
// fall into the bounds of a cell are tested.
class TrueSides {
  public:
    explicit TrueSides(const coupling::Scene& scene);
    bool inside(int cell, const Vec3& x) const;  // by the number of the cell
    int side(const Vec3& x) const;               // 0 outside, n inside cell number n

  private:
    bool isInHeld(std::size_t index, const Vec3& x) const;
    const coupling::Scene& scene_;
    Periodicity period_;
    std::vector<std::optional<geometry::InsideTest>> surfaces_;  // of held cells; empty: no triangle is left
    geometry::BoundsIndex index_;
};

}  // namespace corpuscle::observers
