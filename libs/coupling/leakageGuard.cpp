#include "coupling/leakageGuard.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "geometry/boundsIndex.hpp"
#include "geometry/periodicSurface.hpp"

namespace corpuscle::coupling {

using particles::Kind;
using particles::ParticleStore;
using particles::ParticleSystem;

namespace {
constexpr double restoredDistanceInSpacings = 0.1;
constexpr std::size_t longestReport = 1000;
}  // namespace

void LeakageGuard::findCandidates(const ParticleSystem& system, const Cells& cells) {
    surfaces_.keepHeld(cells);
    candidates_.assign(cells.heldCount(), {});
    std::vector<geometry::Bounds> bounds(cells.heldCount());
    std::vector<std::optional<geometry::NearestImages>> surfaces(cells.heldCount());
    for (std::size_t c = 0; c < cells.heldCount(); ++c) {
        const membrane::Membrane& m = cells[c].membrane;
        if (m.network().isOpen()) continue;
        surfaces[c].emplace(surfaces_.of(cells[c]), m.position, system.periodicity());
        bounds[c] = geometry::boundsOf(m.position);
    }
    const particles::Box& box = system.box();
    const geometry::BoundsIndex index(bounds, box.low, box.high, system.periodicity(), reachInSpacings * spacing_);
    const ParticleStore& s = system.store();
    for (int i = 0; i < system.owned(); ++i) {
        if (s.kindOf(static_cast<std::size_t>(i)) != Kind::fluid) continue;
        const Vec3 x = s.position(static_cast<std::size_t>(i));
        for (const int c : index.near(x))
            if (surfaces[static_cast<std::size_t>(c)]->nearest(x))
                candidates_[static_cast<std::size_t>(c)].push_back(i);
    }
}

void LeakageGuard::movedBack(ParticleSystem& system, const Cells& cells) {
    for (std::size_t c = 0; c < cells.heldCount(); ++c) movedBack(system, cells[c], c);
}

void LeakageGuard::movedBack(ParticleSystem& system, const Cell& cell, std::size_t index) {
    if (cell.membrane.network().isOpen() || candidates_[index].empty()) return;
    ParticleStore& s = system.store();
    const geometry::NearestImages images(surfaces_.of(cell), cell.membrane.position, system.periodicity());
    for (const int i : candidates_[index]) {
        const auto [at, x] = images.nearest(s.position(i));
        if (!at) continue;
        const double own = s.side[i] == cell.membrane.cell ? -1 : 1;  // sign of the distance on the particle's own side
        if (own * at.distance >= 0) continue;
        const Index3& triangle = cell.membrane.network().triangles()[static_cast<std::size_t>(at.triangle)];
        const auto node = [&](int k) { return static_cast<std::size_t>(triangle[static_cast<std::size_t>(k)]); };
        Vec3 outward = (x - at.point) / at.distance;
        if (!(std::abs(at.distance) > 1e-6 * spacing_)) {
            const auto& p = cell.membrane.position;
            outward = (p[node(1)] - p[node(0)]).cross(p[node(2)] - p[node(0)]).normalized();
        }
        s.setPosition(static_cast<std::size_t>(i),
                      s.position(i) + (at.point + own * restoredDistanceInSpacings * spacing_ * outward - x));
        Vec3 membraneVelocity = Vec3::Zero();
        for (int k = 0; k < 3; ++k) membraneVelocity += at.weights[k] * cell.membrane.velocity[node(k)];
        const Vec3 u = s.velocity(i);
        const double approach = own * (u - membraneVelocity).dot(outward);
        if (approach < 0) s.setVelocity(static_cast<std::size_t>(i), u - own * approach * outward);
        ++moves_;
        deepest_ = std::max(deepest_, std::abs(at.distance));
        if (report_.size() < longestReport) report_.push_back({s.id[i], cell.membrane.cell, std::abs(at.distance), x});
    }
}

}  // namespace corpuscle::coupling
