#include "membrane/volumeConstraint.hpp"

#include <numbers>

#include "core/error.hpp"
#include "membrane/surface.hpp"

namespace corpuscle::membrane {

namespace {

double enclosed(const Network& network, std::span<const Vec3> x) {
    double sum = 0;
    for (const Index3& t : network.triangles()) {
        sum += tetrahedron(x[t[0]], x[t[1]], x[t[2]], x.front());
    }
    return sum;
}

class Volume final : public Term {
  public:
    Volume(const Network& network, double modulus, double rest) : network_(network), modulus_(modulus), rest_(rest) {}

    void addForces(std::span<const Vec3> x, std::span<Vec3> f) const override {
        if (network_.isOpen()) {
            return;
        }
        const double slope = modulus_ * (enclosed(network_, x) / rest_ - 1);
        const std::vector<Vec3> g = gradient(x);
        for (std::size_t n = 0; n < g.size(); ++n) {
            f[n] -= slope * g[n];
        }
    }

    double energy(std::span<const Vec3> x) const override {
        if (network_.isOpen()) {
            return 0;
        }
        const double change = enclosed(network_, x) - rest_;
        return 0.5 * modulus_ * change * change / rest_;
    }

    void addStiffness(std::span<const Vec3> x, Definiteness definiteness, Stiffness& stiffness) const override {
        if (network_.isOpen()) {
            return;
        }
        const double slope = modulus_ * (enclosed(network_, x) / rest_ - 1);
        for (const Bond& bond : network_.allBonds()) {
            const auto [left, right] = network_.bondTriangles(bond.number);
            const Vec3 s = slope / 6 * (across(x, right, bond) - across(x, left, bond));
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
        stiffness.addRankOne(modulus_ / rest_, gradient(x));
    }

    double maxStiffness(std::span<const Vec3> x) const override {
        if (network_.isOpen()) {
            return 0;
        }
        double square = 0;
        for (const Vec3& g : gradient(x)) {
            square += g.squaredNorm();
        }
        return modulus_ / rest_ * square;
    }

  private:
    // A third of the area vectors of a node's triangles; each from edges, so that no digits go into the distance to the origin.
    std::vector<Vec3> gradient(std::span<const Vec3> x) const {
        std::vector<Vec3> sum(x.size(), Vec3::Zero());
        for (const Index3& t : network_.triangles()) {
            const Vec3 third = areaVector(x, t) / 3;
            for (const int node : t) {
                sum[node] += third;
            }
        }
        return sum;
    }
    const Vec3& across(std::span<const Vec3> x, int triangle, const Bond& bond) const {
        const Index3& t = network_.triangles()[triangle];
        return x[t[0] + t[1] + t[2] - bond.node[0] - bond.node[1]];
    }

    const Network& network_;
    double modulus_, rest_;
};

}  // namespace

std::unique_ptr<Term> VolumeConstraint::makeTerm(Network& network, double restArea) const {
    if (network.isOpen()) {
        throw Failure(ExitCode::invalidCase,
                      "membrane: volume on a mesh with a border, which encloses none. Leave volume out or close the "
                      "mesh (checkMesh shows its faults)");
    }
    const double radius = std::sqrt(restArea / (4 * std::numbers::pi));
    const double target = reducedVolume ? *reducedVolume * 4 * std::numbers::pi / 3 * radius * radius * radius
                                        : rest.value_or(enclosed(network, network.stressFree()));
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
