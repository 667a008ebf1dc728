#include "coupling/insideShares.hpp"

#include <algorithm>
#include <utility>

namespace corpuscle::coupling {

std::vector<sph::Inside> insideShares(const Scene& scene, const NoFlux* noFlux) {
    const particles::ParticleStore& s = scene.store();
    if (!s.optional().viscosity) return std::vector<sph::Inside>(s.size());
    const double mu = scene.model().viscosity;
    std::vector<sph::Inside> inside = sph::insideByCentre(s, mu);
    if (!noFlux) return inside;
    std::vector<char> isNear(s.size(), 0);
    noFlux->forDistances([&](int particle, const Cell& cell, double distance) {
        const auto i = static_cast<std::size_t>(particle);
        const double share = std::clamp(0.5 - distance / scene.spacing, 0.0, 1.0),
                     viscosity = mu * scene.cells.types()[cell.type].viscosityRatio;
        // Between two membranes it belongs to the one within which it lies, or to the nearer one.
        if (!std::exchange(isNear[i], 1) || share > inside[i].share)
            inside[i] = viscosity == mu ? sph::Inside{} : sph::Inside{share, viscosity};
    });
    return inside;
}

}  // namespace corpuscle::coupling
