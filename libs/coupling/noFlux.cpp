#include "coupling/noFlux.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "membrane/surface.hpp"

namespace corpuscle::coupling {

using particles::Kind;
using particles::ParticleSystem;

namespace {
constexpr double reachInSpacings = 0.5 * NoFlux::imageMarginInSpacings;

// Sign of the distance on the particle's side.
double sideOf(const particles::ParticleStore& s, int particle, const Cell& cell) {
    return s.side[static_cast<std::size_t>(particle)] == cell.membrane.cell ? -1 : 1;
}
}  // namespace

geometry::TriangleGrid& NoFlux::surface(std::size_t c) {
    const membrane::Membrane& m = cells_[c].membrane;
    grids_.resize(cells_.size());
    if (!grids_[c])
        grids_[c] = std::make_unique<geometry::TriangleGrid>(
            geometry::TriangleMesh{m.position, m.network().triangles()}, reachInSpacings * spacing_);
    else
        grids_[c]->update(m.position);
    return *grids_[c];
}

Vec3 NoFlux::normal(const Cell& cell, const geometry::SurfacePoint& at, const Vec3& x) const {
    if (std::abs(at.distance) > 1e-6 * spacing_) return (x - at.point) / at.distance;
    const membrane::Membrane& m = cell.membrane;
    return membrane::areaVector(m.position, m.network().triangles()[static_cast<std::size_t>(at.triangle)])
        .normalized();
}

Vec3 NoFlux::velocity(const Near& near) const {
    const membrane::Membrane& m = cells_[near.cell].membrane;
    const Index3& node = m.network().triangles()[static_cast<std::size_t>(near.at.triangle)];
    Vec3 v = Vec3::Zero();
    for (std::size_t k = 0; k < 3; ++k)
        v += near.at.weights[static_cast<int>(k)] * m.velocity[static_cast<std::size_t>(node[k])];
    return v;
}

void NoFlux::checkLength(const particles::Box& box, const Cell& cell) const {
    Vec3 low = cell.membrane.position.front(), high = low;
    for (const Vec3& p : cell.membrane.position) low = low.cwiseMin(p), high = high.cwiseMax(p);
    for (int k = 0; k < 3; ++k)
        if (box.periodic[static_cast<std::size_t>(k)] &&
            high[k] - low[k] > box.size()[k] - imageMarginInSpacings * spacing_)
            throw Failure(ExitCode::numerics,
                          fmt::format("the cell '{}' has become {:.4g} m long along {} and comes within {} spacings of "
                                      "its image in the periodic box: particles at its ends could no longer be told "
                                      "from those at its image's. Start again with a longer box",
                                      cell.membrane.name, high[k] - low[k], "xyz"[k], imageMarginInSpacings));
}

void NoFlux::find(const ParticleSystem& system, const std::vector<int>& candidates) {
    const particles::ParticleStore& s = system.store();
    near_.clear();
    for (std::size_t c = 0; c < cells_.size(); ++c) {
        if (cells_[c].membrane.network().isOpen()) continue;
        checkLength(system.box(), cells_[c]);
        const geometry::TriangleGrid& grid = surface(c);
        const Vec3 middle = middleOf(cells_[c]);
        for (const int i : candidates) {
            if (s.kindOf(static_cast<std::size_t>(i)) != Kind::fluid) continue;
            const Vec3 x = imageNear(system.box(), s.position(static_cast<std::size_t>(i)), middle);
            const geometry::SurfacePoint at = grid.nearest(x);
            if (!at) continue;
            const double q = at.distance / spacing_, chi = std::max(0.0, 1 - q * q);
            near_.push_back({i, c, at, sideOf(s, i, cells_[c]), chi * chi, normal(cells_[c], at, x)});
        }
    }
}

void NoFlux::keepSides(ParticleSystem& system) {
    particles::ParticleStore& s = system.store();
    const double least = leastDistanceInSpacings * spacing_;
    for (std::size_t k = 0; k < near_.size();) {  // near_ is ordered by cells
        const std::size_t c = near_[k].cell;
        const Cell& cell = cells_[c];
        const geometry::TriangleGrid& grid = surface(c);
        const Vec3 middle = middleOf(cell);
        for (; k < near_.size() && near_[k].cell == c; ++k) {
            const auto i = static_cast<std::size_t>(near_[k].particle);
            const double own = near_[k].side;
            const Vec3 x = imageNear(system.box(), s.position(i), middle);
            const geometry::SurfacePoint at = grid.nearest(x);
            if (!at || own * at.distance >= least) continue;
            if (own * at.distance < 0) ++crossings_, deepest_ = std::max(deepest_, std::abs(at.distance));
            s.setPosition(i, s.position(i) + (at.point + own * least * normal(cell, at, x) - x));
        }
    }
}

}  // namespace corpuscle::coupling
