// What several observers need to know of cells.
//
// A cell's state may be read on the ranks that hold it only. All holders have the same bits; its numbers come from the
// lowest rank among them, and every rank gets them.
#pragma once
#include <functional>
#include <optional>

#include "coupling/scene.hpp"
#include "geometry/insideTest.hpp"

namespace corpuscle::observers {

// The lowest rank that holds each cell. Collective.
std::vector<int> sourceRanks(const coupling::Scene& scene);

// count numbers of each cell, [cell][number], on every rank; work(cell, index of the cell, out) runs on one rank per
// cell. Collective.
std::vector<std::vector<double>> ofEachCell(
    const coupling::Scene& scene, std::size_t count,
    const std::function<void(const coupling::Cell&, std::size_t, double* out)>& work);

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
    bool inside(std::size_t cell, const Vec3& x) const;  // index of the cell
    int side(const Vec3& x) const;                       // 0 outside, n inside cell number n

  private:
    const coupling::Scene& scene_;
    Periodicity period_;
    std::vector<std::optional<geometry::InsideTest>> surfaces_;  // empty: not held
};

}  // namespace corpuscle::observers
