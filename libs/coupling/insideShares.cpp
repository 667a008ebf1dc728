#include "coupling/insideShares.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "membrane/curvature.hpp"

namespace corpuscle::coupling {

namespace {

// The mean curvature of the membrane of one cell at a time near each particle that is near a node of it [1/m].
class Curvature {
  public:
    Curvature(const Immersed& immersed, std::size_t particles) : immersed_(immersed), sums_(particles) {}

    std::size_t cell() const { return cell_; }
    void find(std::size_t cell) {
        if (cell_ != none)
            immersed_.forNear(
                cell_, [&](std::size_t, int particle, double) { sums_[static_cast<std::size_t>(particle)] = {}; });
        cell_ = cell;
        const membrane::Membrane& m = immersed_.cells()[cell].membrane;
        const auto& triangles = m.network().triangles();
        const std::vector<Vec3> ofArea = membrane::areaGradient(m.position, triangles),
                                ofVolume = membrane::volumeGradient(m.position, triangles);
        immersed_.forNear(cell, [&](std::size_t node, int particle, double weight) {
            Sum& sum = sums_[static_cast<std::size_t>(particle)];
            sum.curvature += weight * ofArea[node].dot(ofVolume[node].stableNormalized());
            sum.area += weight * ofVolume[node].norm();
        });
    }
    double at(int particle) const {
        const Sum& sum = sums_[static_cast<std::size_t>(particle)];
        return sum.area > 0 ? sum.curvature / sum.area : 0;
    }

  private:
    struct Sum {
        double curvature = 0, area = 0;
    };
    static constexpr std::size_t none = static_cast<std::size_t>(-1);
    const Immersed& immersed_;
    std::size_t cell_ = none;
    std::vector<Sum> sums_;  // of each particle
};

}  // namespace

std::vector<sph::Inside> insideShares(const Scene& scene, const NoFlux* noFlux, const Immersed* immersed) {
    const particles::ParticleStore& s = scene.store();
    if (!s.optional().viscosity) return std::vector<sph::Inside>(s.size());
    const double mu = scene.model().viscosity, dx = scene.spacing;
    std::vector<sph::Inside> inside = sph::insideByCentre(s, mu);
    if (!noFlux) return inside;
    std::vector<char> isNear(s.size(), 0);
    std::optional<Curvature> curvature;
    noFlux->forNearest([&](int particle, std::size_t number, const geometry::SurfacePoint& at) {
        const Cell& cell = scene.cells[number];
        if (cell.membrane.network().isOpen()) return;
        const auto i = static_cast<std::size_t>(particle);
        sph::Inside found;
        if (const double ratio = scene.cells.types()[cell.type].viscosityRatio; ratio != 1) {
            if (!curvature) curvature.emplace(*immersed, s.size());
            if (curvature->cell() != number) curvature->find(number);
            found = {std::clamp(0.5 - at.distance / dx - curvature->at(particle) * dx / 24, 0.0, 1.0), mu * ratio};
        }
        // A particle near two membranes belongs to that for which its share is larger.
        if (!std::exchange(isNear[i], 1) || found.share > inside[i].share) inside[i] = found;
    });
    return inside;
}

}  // namespace corpuscle::coupling
