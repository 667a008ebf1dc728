#include "membrane/volumeConstraint.hpp"

#include <numbers>

#include "core/error.hpp"
#include "membrane/surface.hpp"
#include "membrane/wholeSurface.hpp"

namespace corpuscle::membrane {

namespace {

class Volume final : public WholeSurfaceTerm {
    using WholeSurfaceTerm::WholeSurfaceTerm;
    double value(std::span<const Vec3> x) const override { return enclosedVolume(x, network_.triangles()); }
    std::vector<Vec3> gradient(std::span<const Vec3> x) const override {
        return volumeGradient(x, network_.triangles());
    }
    void addCurvature(std::span<const Vec3> x, double slope, Definiteness definiteness,
                      Stiffness& stiffness) const override {
        addVolumeCurvature(network_, x, slope, definiteness, stiffness);
    }
};

}  // namespace

void addVolumeCurvature(const Network& network, std::span<const Vec3> x, double slope, Definiteness definiteness,
                        Stiffness& stiffness) {
    if (definiteness == Definiteness::partwise) {
        return;
    }
    for (const Bond& bond : network.allBonds()) {
        const auto across = [&](int triangle) -> const Vec3& {
            const Index3& t = network.triangles()[triangle];
            return x[t[0] + t[1] + t[2] - bond.node[0] - bond.node[1]];
        };
        const auto [left, right] = network.bondTriangles(bond.number);
        const Vec3 s = slope / 6 * (across(right) - across(left));
        Eigen::Matrix<double, 6, 6> matrix = Eigen::Matrix<double, 6, 6>::Zero();
        Mat3 cross;
        cross << 0, -s.z(), s.y(), s.z(), 0, -s.x(), -s.y(), s.x(), 0;
        matrix.topRightCorner<3, 3>() = cross;
        matrix.bottomLeftCorner<3, 3>() = cross.transpose();
        if (definiteness == Definiteness::semiDefinite) {
            matrix = semiDefinite(matrix);
        }
        stiffness.add(bond.node, matrix);
    }
}

std::unique_ptr<Term> VolumeConstraint::makeTerm(Network& network, double restArea) const {
    if (network.isOpen()) {
        throw Failure(ExitCode::invalidCase,
                      "membrane: volume on a mesh with a border, which encloses none. Leave volume out or close the "
                      "mesh (checkMesh shows its faults)");
    }
    const double radius = std::sqrt(restArea / (4 * std::numbers::pi));
    const double target = reducedVolume ? *reducedVolume * 4 * std::numbers::pi / 3 * radius * radius * radius
                                        : rest.value_or(enclosedVolume(network.stressFree(), network.triangles()));
    if (!(target > 0)) {
        throw Failure(ExitCode::invalidCase,
                      "membrane: volume on a mesh that encloses a negative volume; its triangles run clockwise seen "
                      "from outside. Turn them (checkMesh shows its faults)");
    }
    return std::make_unique<Volume>(network, modulus, target);
}

const Schema<VolumeConstraint>& VolumeConstraint::schema() {
    static const Schema<VolumeConstraint> s =
        Schema<VolumeConstraint>("volume constraint",
                                 "enclosed volume held near a target; let go when the cell ruptures")
            .quantity("modulus", &VolumeConstraint::modulus, unit::pascal, "K in E = K/2 (V - V0)^2/V0",
                      {.range = positive})
            .quantity("rest", &VolumeConstraint::rest, unit::metre.power(3),
                      "volume wanted; that of the stress-free mesh when neither this nor reducedVolume is given",
                      {.range = positive})
            .quantity("reducedVolume", &VolumeConstraint::reducedVolume, unit::none,
                      "volume wanted over that of the sphere with the membrane's rest area",
                      {.range = {.low = 0, .high = 1, .lowOpen = true}})
            .atMostOneOf({"rest", "reducedVolume"});
    return s;
}

}  // namespace corpuscle::membrane
