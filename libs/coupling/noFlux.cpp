#include "coupling/noFlux.hpp"

#include <algorithm>
#include <cmath>

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

geometry::NearestImages::Found NoFlux::beside(const geometry::TriangleTree& tree, const geometry::NearestImages& images,
                                              const Cell& cell, const Vec3& x) const {
    geometry::NearestImages::Found found = images.nearest(x);
    if (!found || !cell.membrane.network().isOpen()) return found;
    if (tree.isOnBorder(found.at)) return {};
    found.at.triangle = cell.membrane.network().wholeTriangles()[static_cast<std::size_t>(found.at.triangle)];
    return found;
}

void NoFlux::find(const ParticleSystem& system, std::size_t c, double moved, const std::vector<int>& candidates) {
    const particles::ParticleStore& s = system.store();
    const Cell& cell = cells_[c];
    if (candidates.empty()) return;
    const bool isTorn = cell.membrane.network().isOpen();
    const geometry::TriangleTree& tree = surfaces_.of(cell);
    const geometry::NearestImages images(tree, cell.membrane.position, system.periodicity());
    for (const int particle : candidates) {
        const auto i = static_cast<std::size_t>(particle);
        if (s.kindOf(i) != Kind::fluid) continue;
        const auto [at, x] = beside(tree, images, cell, s.position(i));
        if (!at) continue;
        const double q = at.distance / spacing_, chi = std::max(0.0, 1 - q * q);
        const Vec3 slide = system.periodicity().slideOf(s.position(i), x);
        near_.push_back({particle, c, at, sideOf(s, particle, cell), chi * chi, normal(cell, at, x), slide});
        if (!isTorn) continue;
        Near& near = near_.back();
        const double before = at.distance - moved * (s.velocity(i) - velocity(near)).dot(near.normal);
        near.side = before < 0 ? -1 : 1;
    }
}

// The distance from the membrane, positive on the own side, grows by `step` unless another part of the membrane comes
// nearer; from there it falls again, at the same rate if the two parts are parallel.
Vec3 NoFlux::toOwnSide(const geometry::TriangleTree& tree, const geometry::NearestImages& images, const Cell& cell,
                       const geometry::SurfacePoint& at, const Vec3& x, double own) const {
    const Vec3 away = own * normal(cell, at, x);
    const double before = own * at.distance, step = leastDistanceInSpacings * spacing_ - before;
    const auto [then, image] = beside(tree, images, cell, x + step * away);
    const double after = then ? own * then.distance : before + step;
    return std::clamp(0.5 * (after - before + step), 0.0, step) * away;
}

void NoFlux::keepSides(ParticleSystem& system) {
    particles::ParticleStore& s = system.store();
    const Periodicity& period = system.periodicity();
    const double least = leastDistanceInSpacings * spacing_;
    for (std::size_t k = 0; k < near_.size();) {  // near_ is ordered by cells
        const std::size_t c = near_[k].cell;
        const Cell& cell = cells_[c];
        const geometry::TriangleTree& tree = surfaces_.of(cell);
        const geometry::NearestImages images(tree, cell.membrane.position, period);
        for (; k < near_.size() && near_[k].cell == c; ++k) {
            const auto i = static_cast<std::size_t>(near_[k].particle);
            const double own = near_[k].side;
            const auto [at, x] = beside(tree, images, cell, s.position(i));
            if (!at || own * at.distance >= least) continue;
            if (own * at.distance < 0) ++crossings_, deepest_ = std::max(deepest_, std::abs(at.distance));
            s.setPosition(i, s.position(i) + toOwnSide(tree, images, cell, at, x, own));
        }
    }
}

}  // namespace corpuscle::coupling
