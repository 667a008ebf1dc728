#include "coupling/arc.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <numeric>

namespace corpuscle::coupling {

Arc Arc::of(const std::vector<Vec3>& position, const std::vector<Vec3>& velocity, double seconds) {
    const auto mean = [](const std::vector<Vec3>& all) {
        return Vec3(std::accumulate(all.begin(), all.end(), Vec3(Vec3::Zero())) / static_cast<double>(all.size()));
    };
    const Vec3 centre = mean(position), drift = mean(velocity);
    Vec3 moment = Vec3::Zero();
    Mat3 inertia = Mat3::Zero();
    for (std::size_t m = 0; m < position.size(); ++m) {
        const Vec3 r = position[m] - centre;
        moment += r.cross(velocity[m] - drift);
        inertia += r.squaredNorm() * Mat3::Identity() - r * r.transpose();
    }
    return {.centre = centre, .turn = seconds * inertia.ldlt().solve(moment)};
}

}  // namespace corpuscle::coupling
