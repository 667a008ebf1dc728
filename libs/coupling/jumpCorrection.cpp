#include "coupling/jumpCorrection.hpp"

#include <cmath>

#include "core/error.hpp"
#include "membrane/surface.hpp"

namespace corpuscle::coupling {

void JumpCorrection::place() {
    root_.clear(), normal_.clear();
    for (const Cell& cell : cells_) {
        const double both = (1 + cell.viscosityRatio) * viscosity_;
        for (const Vec3& g : membrane::volumeGradient(cell.membrane.position, cell.membrane.network().triangles())) {
            const double area = g.norm();  // 0: no membrane, no kink
            root_.push_back(area > 0 ? std::sqrt(reachInSpacings * spacing_ / (both * area)) : 0);
            normal_.push_back(area > 0 ? Vec3(g / area) : Vec3(Vec3::Zero()));
        }
    }
}

JumpCorrection::Vectors JumpCorrection::scaled(const Vectors& v) const {
    Vectors found(v.size());
    for (std::size_t m = 0; m < v.size(); ++m) found[m] = root_[m] * (v[m] - normal_[m].dot(v[m]) * normal_[m]);
    return found;
}

void JumpCorrection::addSlip(std::span<const Vec3> f, Vectors& v) const {
    for (std::size_t m = 0; m < v.size(); ++m) v[m] += root_[m] * root_[m] * (f[m] - normal_[m].dot(f[m]) * normal_[m]);
}

double JumpCorrection::dot(const Vectors& a, const Vectors& b) {
    double sum = 0;
    for (std::size_t m = 0; m < a.size(); ++m) sum += a[m].dot(b[m]);
    return sum;
}

void JumpCorrection::fail() { throw Failure(ExitCode::numerics, "the slip of the membranes' nodes did not converge"); }

}  // namespace corpuscle::coupling
