#include "coupling/noFlux.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/periodicSurface.hpp"
#include "membrane/surface.hpp"

namespace corpuscle::coupling {

using particles::Kind;
using particles::ParticleSystem;

namespace {
// Sign that the distance from the membrane has on the particle's own side.
double sideOf(const particles::ParticleStore& s, int particle, const Cell& cell) {
    return s.side[static_cast<std::size_t>(particle)] == cell.membrane.cell ? -1 : 1;
}
}  // namespace

Vec3 NoFlux::normal(const Cell& cell, const geometry::SurfacePoint& at, const Vec3& x) const {
    if (std::abs(at.distance) > 1e-6 * spacing_) return (x - at.point) / at.distance;
    const membrane::Membrane& m = cell.membrane;
    return membrane::areaVector(m.position, m.network().triangles()[static_cast<std::size_t>(at.triangle)])
        .normalized();
}

Vec3 NoFlux::velocity(const Near& near) const {
    const membrane::Membrane& m = cells_[near.cell].membrane;
    const Index3& node = m.network().triangles()[static_cast<std::size_t>(near.at.triangle)];
    Vec3 v = -near.slide;
    for (std::size_t k = 0; k < 3; ++k)
        v += near.at.weights[static_cast<int>(k)] * m.velocity[static_cast<std::size_t>(node[k])];
    return v;
}

void NoFlux::forgetOthers() {
    near_.clear();
    surfaces_.keepHeld(cells_);
}

void NoFlux::find(const ParticleSystem& system, std::size_t c, const std::vector<int>& candidates) {
    const particles::ParticleStore& s = system.store();
    const Cell& cell = cells_[c];
    if (candidates.empty()) return;
    const geometry::NearestImages images(surfaces_.of(cell), cell.membrane.position, system.periodicity());
    for (const int i : candidates) {
        if (s.kindOf(static_cast<std::size_t>(i)) != Kind::fluid) continue;
        const auto [at, x] = images.nearest(s.position(static_cast<std::size_t>(i)));
        if (!at) continue;
        const double q = at.distance / spacing_, chi = std::max(0.0, 1 - q * q);
        const Vec3 slide = system.periodicity().slideOf(s.position(static_cast<std::size_t>(i)), x);
        near_.push_back({i, c, at, sideOf(s, i, cell), chi * chi, normal(cell, at, x), slide});
    }
}

void NoFlux::keepSides(ParticleSystem& system) {
    particles::ParticleStore& s = system.store();
    const Periodicity& period = system.periodicity();
    const double least = leastDistanceInSpacings * spacing_;
    for (std::size_t k = 0; k < near_.size();) {  // near_ is ordered by cells
        const std::size_t c = near_[k].cell;
        const Cell& cell = cells_[c];
        const geometry::NearestImages images(surfaces_.of(cell), cell.membrane.position, period);
        for (; k < near_.size() && near_[k].cell == c; ++k) {
            const auto i = static_cast<std::size_t>(near_[k].particle);
            const double own = near_[k].side;
            const auto [at, x] = images.nearest(s.position(i));
            if (!at || own * at.distance >= least) continue;
            if (own * at.distance < 0) ++crossings_, deepest_ = std::max(deepest_, std::abs(at.distance));
            s.setPosition(i, s.position(i) + (at.point + own * least * normal(cell, at, x) - x));
        }
    }
}

}  // namespace corpuscle::coupling
