// What several observers need to know of cells.
//
// A cell's state may be read on the ranks that hold it only. All holders have the same bits; its numbers come from its
// owner, and every rank gets them.
#pragma once
#include <functional>
#include <optional>

#include "coupling/scene.hpp"
#include "geometry/boundsIndex.hpp"
#include "geometry/insideTest.hpp"
#include "observers/observer.hpp"

namespace corpuscle::observers {

// count numbers of each cell of the scene, [number of the cell - 1][number], on every rank; work(cell, out) runs on one
// rank per cell. Collective.
std::vector<std::vector<double>> ofEachCell(const coupling::Scene& scene, std::size_t count,
                                            const std::function<void(const coupling::Cell&, double* out)>& work);

// Tables of cells: one for each type, a row for each of its cells, the number of the cell before all else. What
// ofEachCell gave as rows, the table of the first type being number `first`.
std::vector<Row> rowsByType(const coupling::Scene& scene, std::size_t first,
                            const std::vector<std::vector<double>>& ofCells);
std::vector<io::Column> cellTable(std::vector<io::Column> columns);

// The numbers of all ranks one after another, in the order of the ranks, on every rank. Collective.
std::vector<double> gatherNumbers(const coupling::Scene& scene, const std::vector<double>& own);

// The surface of a held cell now, closed by a fan over the rim of each hole; without nodes that no whole triangle has.
// Empty when every triangle is broken.
geometry::TriangleMesh closedSurface(const coupling::Cell& cell);

// Where particles really are, whatever their `side` says: against the closed surfaces of the cells that this rank
// holds. Right for particles of this rank, wherever they stand: all of their periodic images that fall into a cell's
// bounds are tested.
class TrueSides {
  public:
    explicit TrueSides(const coupling::Scene& scene);
    bool inside(int cell, const Vec3& x) const;  // by the number of the cell
    int side(const Vec3& x) const;               // 0 outside, n inside cell number n

  private:
    bool isInHeld(std::size_t index, const Vec3& x) const;
    const coupling::Scene& scene_;
    Periodicity period_;
    std::vector<std::optional<geometry::InsideTest>> surfaces_;  // of held cells; empty: torn to the last triangle
    geometry::BoundsIndex index_;
};

}  // namespace corpuscle::observers
