#include "coupling/insideShares.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "membrane/curvature.hpp"

namespace corpuscle::coupling {

namespace {

// Curvature of a membrane, interpolated between its nodes [1/m].
class Curvature {
  public:
    explicit Curvature(const membrane::Membrane& m)
        : triangles_(m.network().triangles()), atNodes_(membrane::curvatures(m.position, triangles_)) {}
    double at(const geometry::SurfacePoint& point) const {
        double sum = 0;
        for (int k = 0; k < 3; ++k)
            sum += point.weights[k] * atNodes_[static_cast<std::size_t>(triangles_[point.triangle][k])];
        return sum;
    }

  private:
    const std::vector<Index3>& triangles_;
    std::vector<double> atNodes_;
};

}  // namespace

std::vector<sph::Inside> insideShares(const Scene& scene, const NoFlux* noFlux) {
    const particles::ParticleStore& s = scene.store();
    if (!s.optional().viscosity) return std::vector<sph::Inside>(s.size());
    const double mu = scene.model().viscosity, dx = scene.spacing;
    std::vector<sph::Inside> inside = sph::insideByCentre(s, mu);
    if (!noFlux) return inside;
    std::vector<char> isNear(s.size(), 0);
    std::optional<Curvature> curvature;
    const Cell* of = nullptr;
    noFlux->forNearest([&](int particle, const Cell& cell, const geometry::SurfacePoint& at) {
        if (cell.membrane.network().isOpen()) return;
        const auto i = static_cast<std::size_t>(particle);
        sph::Inside found;
        if (const double ratio = scene.cells.types()[cell.type].viscosityRatio; ratio != 1) {
            if (std::exchange(of, &cell) != &cell) curvature.emplace(cell.membrane);
            found = {std::clamp(0.5 - at.distance / dx - curvature->at(at) * dx / 24, 0.0, 1.0), mu * ratio};
        }
        // A particle near two membranes belongs to that for which its share is larger.
        if (!std::exchange(isNear[i], 1) || found.share > inside[i].share) inside[i] = found;
    });
    return inside;
}

}  // namespace corpuscle::coupling
