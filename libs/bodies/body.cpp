#include "bodies/body.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "bodies/extrapolation.hpp"
#include "core/error.hpp"
#include "geometry/triangleTree.hpp"

namespace corpuscle::bodies {

namespace {
constexpr double gridInSpacings = 0.5;
}

Body::Body(std::string name, std::string type, const geometry::TriangleMesh& mesh, double density,
           std::shared_ptr<const BodyMotion> motionModel, double reach, double spacing)
    : name(std::move(name)),
      type(std::move(type)),
      solid(mesh, density),
      behaviour(std::move(motionModel)),
      state{solid.startCentre(), solid.startOrientation(), {}},
      distance(solid.surface, gridInSpacings * spacing, reach + spacing) {}

void Body::fill(const std::vector<Vec3>& places, double particleVolume, const sph::Kernel& kernel, double reach) {
    const geometry::TriangleTree grid(solid.surface, reach);
    particles.clear();
    for (const Vec3& x : places) {
        const Vec3 place = solid.startOrientation().conjugate() * (x - solid.startCentre());
        const geometry::SurfacePoint nearest = grid.nearest(place);
        // Particles deeper than the reach interact with no fluid, so any foot and depth will do.
        if (nearest)
            particles.push_back(
                {place, nearest.point,
                 std::max(0.0, -effectiveDistance(distance, place, nearest.distance, std::cbrt(particleVolume)))});
        else
            particles.push_back({place, place, reach});
    }
    sumRotationalDrag(particleVolume, kernel, reach);
}

// D Omega = sum_j s_j x (Omega x q_j),  q_j = sum_k 2 mu V^2 F (r_j - r_k) over the body's own particles k; q_j is 0
// far from the surface.
void Body::sumRotationalDrag(double particleVolume, const sph::Kernel& kernel, double reach) {
    const double factor = 2 * viscosity * particleVolume * particleVolume * kernel.gradientNormalisation(reach);
    const auto column = [&](double x) { return static_cast<std::int64_t>(std::floor(x / reach)); };
    std::map<std::array<std::int64_t, 3>, std::vector<const BodyParticle*>> cells;
    for (const BodyParticle& p : particles)
        cells[{column(p.place[0]), column(p.place[1]), column(p.place[2])}].push_back(&p);
    rotationalDrag.setZero();
    for (const BodyParticle& p : particles) {
        Vec3 q = Vec3::Zero();
        for (int n = 0; n < 27; ++n) {
            const auto cell = cells.find(
                {column(p.place[0]) + n % 3 - 1, column(p.place[1]) + n / 3 % 3 - 1, column(p.place[2]) + n / 9 - 1});
            if (cell == cells.end()) continue;
            for (const BodyParticle* other : cell->second) {
                const Vec3 d = p.place - other->place;
                const double distance = d.norm() / reach;
                if (distance < 1) q += factor * kernel.slope(distance) * d;
            }
        }
        rotationalDrag += p.foot.dot(q) * Mat3::Identity() - q * p.foot.transpose();
    }
}

std::vector<Vec3> Body::nodes() const {
    const Mat3 R = state.rotation();
    std::vector<Vec3> moved;
    for (const Vec3& x : solid.surface.nodes) moved.push_back(state.centre + R * x);
    return moved;
}

std::vector<double> Body::saved() const {
    std::vector<double> values;
    const auto add = [&](const auto& v) { values.insert(values.end(), v.data(), v.data() + v.size()); };
    add(state.centre), add(state.orientation.coeffs());
    add(state.motion.linear), add(state.motion.angular);
    add(wrench.force), add(wrench.torque);
    add(acceleration.linear), add(acceleration.angular);
    return values;
}

void Body::restore(const std::vector<double>& values) {
    if (values.size() != stateLength)
        throw Failure(ExitCode::io, "the checkpoint holds " + std::to_string(values.size()) +
                                        " numbers for the body '" + name + "' instead of " +
                                        std::to_string(stateLength) + "; start from firstTime");
    const double* next = values.data();
    const auto take = [&](auto& v) {
        std::copy_n(next, v.size(), v.data());
        next += v.size();
    };
    take(state.centre), take(state.orientation.coeffs());
    take(state.motion.linear), take(state.motion.angular);
    take(wrench.force), take(wrench.torque);
    take(acceleration.linear), take(acceleration.angular);
}

}  // namespace corpuscle::bodies
