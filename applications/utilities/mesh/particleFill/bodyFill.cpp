#include "bodyFill.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/periodicSurface.hpp"

namespace corpuscle::utilities {

std::vector<int> bodyOfEach(const simulation::Case& input, const std::vector<geometry::TriangleMesh>& bodies,
                            const std::vector<Vec3>& points) {
    std::vector<int> taken(points.size(), 0);
    const Periodicity period = input.fluidBox().periodicity();
    const double reach = std::numbers::sqrt3 * input.spacing();
    for (std::size_t b = 0; b < bodies.size(); ++b) {
        const geometry::PeriodicSurface surface(bodies[b], reach, period);
        std::vector<std::pair<double, std::size_t>> order;  // signed distance from the surface, and number
        for (std::size_t i = 0; i < points.size(); ++i) {
            if (taken[i] > 0) continue;
            if (const double distance = surface.at(points[i]).distance; std::isfinite(distance))
                order.emplace_back(distance, i);
        }
        const auto count = static_cast<std::size_t>(std::lround(bodies[b].volume() / input.particleVolume()));
        if (count == 0 || count > order.size())
            throw Failure(ExitCode::invalidCase,
                          "the body '" + input.mesh.bodies[b].name +
                              "' cannot be filled: take a smaller spacing in system/numerics.yaml");
        std::sort(order.begin(), order.end());
        for (std::size_t k = 0; k < count; ++k) taken[order[k].second] = static_cast<int>(b) + 1;
    }
    return taken;
}

}  // namespace corpuscle::utilities
