#include "membrane/areaConstraint.hpp"

#include <algorithm>
#include <numeric>

#include "membrane/hessian.hpp"
#include "membrane/wholeSurface.hpp"

namespace corpuscle::membrane {

namespace {

std::array<Vec3, 3> places(std::span<const Vec3> x, const Index3& node) { return {x[node[0]], x[node[1]], x[node[2]]}; }

double total(const std::vector<double>& areas) { return std::accumulate(areas.begin(), areas.end(), 0.0); }

// Adds the part of slope d2A/dx2 that resists displacements along the normal n, if the slope is a tension:
// slope (e_i . e_j)/(4 A) n n^T with e_i the edge opposite corner i. On a flat sheet nothing else remains, as the parts
// within the plane cancel around each node.
void addTension(const std::array<Vec3, 3>& x, double area, double slope, Eigen::Matrix<double, 9, 9>& matrix) {
    if (!(slope > 0) || !(area > 0)) {
        return;
    }
    const std::array<Vec3, 3> opposite{x[2] - x[1], x[0] - x[2], x[1] - x[0]};
    const Vec3 normal = opposite[0].cross(opposite[1]).normalized();
    const Mat3 along = normal * normal.transpose();
    for (int m = 0; m < 3; ++m) {
        for (int n = 0; n < 3; ++n) {
            matrix.block<3, 3>(3 * m, 3 * n) += slope * opposite[m].dot(opposite[n]) / (4 * area) * along;
        }
    }
}

// Adds slope d2A/dx2 + curvature (dA/dx)(dA/dx)^T of one triangle.
void addTriangle(std::span<const Vec3> x, const Index3& node, double slope, double curvature, Definiteness definiteness,
                 Stiffness& stiffness) {
    const auto corners = places(x, node);
    const auto area = TriangleArea::at(corners);
    Eigen::Matrix<double, 9, 1> gradient;
    gradient << area.gradient[0], area.gradient[1], area.gradient[2];
    Eigen::Matrix<double, 9, 9> matrix = curvature * gradient * gradient.transpose();
    if (definiteness == Definiteness::partwise) {
        addTension(corners, area.value, slope, matrix);
    } else {
        matrix += slope * hessian<TriangleArea>(corners);
    }
    if (definiteness == Definiteness::semiDefinite) {
        matrix = semiDefinite(matrix);
    }
    stiffness.add(node, matrix);
}

class LocalArea final : public Term {
  public:
    LocalArea(const Network& network, double modulus, double scale)
        : network_(network), modulus_(modulus), scale_(scale) {}

    void addForces(std::span<const Vec3> x, std::span<Vec3> f) const override {
        for (const int t : network_.wholeTriangles()) {
            const Index3& node = network_.triangles()[t];
            const auto area = TriangleArea::at(places(x, node));
            for (int k = 0; k < 3; ++k) {
                f[node[k]] -= slope(t, area.value) * area.gradient[k];
            }
        }
    }

    double energy(std::span<const Vec3> x) const override {
        double sum = 0;
        for (const int t : network_.wholeTriangles()) {
            const double area = TriangleArea::at(places(x, network_.triangles()[t])).value, change = area - rest(t);
            sum += share(t, area) * 0.5 * modulus_ * change * change / rest(t);
        }
        return sum;
    }

    void addTensileEnergy(std::span<const Vec3> x, std::span<double> ofTriangle) const override {
        for (const int t : network_.wholeTriangles()) {
            const double change = TriangleArea::at(places(x, network_.triangles()[t])).value - rest(t);
            ofTriangle[t] += change > 0 ? 0.5 * modulus_ / rest(t) * change * change : 0;
        }
    }

    void addStiffness(std::span<const Vec3> x, Definiteness definiteness, Stiffness& stiffness) const override {
        for (const int t : network_.wholeTriangles()) {
            const Index3& node = network_.triangles()[t];
            const double area = TriangleArea::at(places(x, node)).value;
            addTriangle(x, node, slope(t, area), share(t, area) * modulus_ / rest(t), definiteness, stiffness);
        }
    }

    double maxStiffness(std::span<const Vec3> x) const override {
        std::vector<double> ofNode(x.size(), 0.0);
        for (const int t : network_.wholeTriangles()) {
            const Index3& node = network_.triangles()[t];
            double sum = 0;
            const auto area = TriangleArea::at(places(x, node));
            for (const Vec3& g : area.gradient) {
                sum += g.norm();
            }
            for (int k = 0; k < 3; ++k) {
                ofNode[node[k]] += modulus_ / rest(t) * sum * area.gradient[k].norm();
            }
        }
        return ofNode.empty() ? 0.0 : *std::max_element(ofNode.begin(), ofNode.end());
    }

  private:
    double rest(int t) const { return scale_ * network_.restAreas()[t]; }
    // Share of its energy that a triangle keeps; one that is weakened (network.hpp) loses energy in tension only.
    double share(int t, double area) const { return area > rest(t) ? network_.shareOfTriangle(t) : 1; }
    double slope(int t, double area) const { return share(t, area) * modulus_ * (area / rest(t) - 1); }

    const Network& network_;
    double modulus_, scale_;
};

class GlobalArea final : public WholeSurfaceTerm {
    using WholeSurfaceTerm::WholeSurfaceTerm;
    double value(std::span<const Vec3> x) const override {
        double sum = 0;
        for (const Index3& node : network_.triangles()) {
            sum += TriangleArea::at(places(x, node)).value;
        }
        return sum;
    }
    std::vector<Vec3> gradient(std::span<const Vec3> x) const override {
        std::vector<Vec3> sum(x.size(), Vec3::Zero());
        for (const Index3& node : network_.triangles()) {
            const auto part = TriangleArea::at(places(x, node));
            for (int k = 0; k < 3; ++k) {
                sum[node[k]] += part.gradient[k];
            }
        }
        return sum;
    }
    void addCurvature(std::span<const Vec3> x, double slope, Definiteness definiteness,
                      Stiffness& stiffness) const override {
        if (definiteness == Definiteness::partwise && !(slope > 0)) {
            return;
        }
        for (const Index3& node : network_.triangles()) {
            addTriangle(x, node, slope, 0, definiteness, stiffness);
        }
    }
};

}  // namespace

double AreaConstraint::restArea(const Network& network) const { return rest.value_or(total(network.restAreas())); }

std::vector<std::unique_ptr<Term>> AreaConstraint::makeTerms(Network& network) const {
    std::vector<std::unique_ptr<Term>> terms;
    const double target = restArea(network);
    if (local) {
        terms.push_back(std::make_unique<LocalArea>(network, *local, target / total(network.restAreas())));
    }
    if (global) {
        terms.push_back(std::make_unique<GlobalArea>(network, *global, target));
    }
    return terms;
}

const Schema<AreaConstraint>& AreaConstraint::schema() {
    static const Schema<AreaConstraint> s =
        Schema<AreaConstraint>("area constraint", "area held near a target, by triangle and as a whole")
            .quantity("local", &AreaConstraint::local, unit::newtonPerMetre,
                      "modulus of each triangle's area, K/2 (A - A0)^2/A0", {.range = positive})
            .quantity("global", &AreaConstraint::global, unit::newtonPerMetre,
                      "modulus of the whole area; let go when the cell ruptures", {.range = positive})
            .quantity("rest", &AreaConstraint::rest, unit::metre.power(2),
                      "area wanted; that of the stress-free mesh when absent", {.range = positive})
            .check([](const AreaConstraint& a, const Node& node, Problems& problems) {
                if (!a.local && !a.global) {
                    problems.add(node.place(), node.path,
                                 "neither local nor global is given; give at least one modulus, or leave area out");
                }
            });
    return s;
}

}  // namespace corpuscle::membrane
