#include "membrane/pipette.hpp"

#include <algorithm>
#include <cmath>

#include "membrane/surface.hpp"

namespace corpuscle::membrane {

namespace {

// Barycentric coordinates of the centroids of the 16 parts of a triangle whose edges are divided into four.
std::vector<Vec3> partMiddles() {
    constexpr int n = 4;
    std::vector<Vec3> middles;
    for (int i = 0; i < n; ++i) {
        for (int j = 0; i + j < n; ++j) {
            const Vec3 low(i + 1.0 / 3, j + 1.0 / 3, 0), high(i + 2.0 / 3, j + 2.0 / 3, 0);
            middles.push_back(low / n);
            if (i + j + 1 < n) {
                middles.push_back(high / n);
            }
        }
    }
    for (Vec3& m : middles) {
        m[2] = 1 - m[0] - m[1];
    }
    return middles;
}

class Contact final : public Term {
  public:
    Contact(const Network& network, const Pipette& pipette)
        : network_(network), pipette_(pipette), middles_(partMiddles()) {}

    void addForces(std::span<const Vec3> x, std::span<Vec3> f) const override {
        forEach(x, [&](const Index3& node, const Vec3& weight, const Depth& g, double area) {
            for (int k = 0; k < 3; ++k) {
                f[node[k]] += weight[k] * area * pressure(g.value) * g.outwards;
            }
        });
    }

    double energy(std::span<const Vec3> x) const override {
        double sum = 0;
        forEach(x, [&](const Index3&, const Vec3&, const Depth& g, double area) {
            sum += area * pressure(g.value) * g.value / 3;
        });
        return sum;
    }

    void addStiffness(std::span<const Vec3> x, Definiteness definiteness, Stiffness& stiffness) const override {
        forEach(x, [&](const Index3& node, const Vec3& weight, const Depth& g, double area) {
            Eigen::MatrixXd ofPoint = area * slope(g.value) * g.outwards * g.outwards.transpose();
            ofPoint -= area * pressure(g.value) * g.curvature;
            if (definiteness != Definiteness::exact) {
                ofPoint = semiDefinite(ofPoint);
            }
            Eigen::Matrix<double, 9, 9> matrix;
            for (int k = 0; k < 3; ++k) {
                for (int m = 0; m < 3; ++m) {
                    matrix.block<3, 3>(3 * k, 3 * m) = weight[k] * weight[m] * ofPoint;
                }
            }
            stiffness.add(node, matrix);
        });
    }

    double maxStiffness(std::span<const Vec3> x) const override {
        std::vector<double> ofNode(x.size(), 0.0);
        forEach(x, [&](const Index3& node, const Vec3& weight, const Depth& g, double area) {
            for (int k = 0; k < 3; ++k) {
                ofNode[node[k]] += weight[k] * area * slope(g.value);
            }
        });
        return ofNode.empty() ? 0.0 : *std::max_element(ofNode.begin(), ofNode.end());
    }

  private:
    // Depth g in the glass, direction out of the glass (minus the gradient of g), and second derivative of the distance
    // to the middle of the wall.
    struct Depth {
        double value = 0;
        Vec3 outwards = Vec3::Zero();
        Mat3 curvature = Mat3::Zero();
    };

    double pressure(double g) const { return pipette_.contactPressure * g * g / (pipette_.depth * pipette_.depth); }
    double slope(double g) const { return 2 * pipette_.contactPressure * g / (pipette_.depth * pipette_.depth); }

    Depth depth(const Vec3& x) const {
        const double rho = x.head<2>().norm(), across = rho - pipette_.middle();
        const double below = std::min(0.0, x[2] - pipette_.mouth - 0.5 * pipette_.wall);
        const double d = std::hypot(across, below);
        Depth result{0.5 * pipette_.wall - d};
        if (!(result.value > 0) || !(d > 0)) {
            return result;
        }
        const Vec3 radial(x[0] / rho, x[1] / rho, 0), hoop(-radial[1], radial[0], 0);
        result.outwards = (across * radial + below * Vec3::UnitZ()) / d;
        result.curvature = across / (d * rho) * hoop * hoop.transpose();
        if (below < 0) {
            const Vec3 along = (-below * radial + across * Vec3::UnitZ()) / d;
            result.curvature += along * along.transpose() / d;
        }
        return result;
    }

    // Calls use for each point of the triangles that lies in the glass, with its share of the stress-free area.
    template <class Use>
    void forEach(std::span<const Vec3> x, const Use& use) const {
        for (const int t : network_.wholeTriangles()) {
            const Index3& node = network_.triangles()[t];
            if (std::max({x[node[0]][2], x[node[1]][2], x[node[2]][2]}) <= pipette_.mouth) {
                continue;
            }
            const double area = network_.restAreas()[t] / static_cast<double>(middles_.size());
            for (const Vec3& m : middles_) {
                if (const Depth g = depth(m[0] * x[node[0]] + m[1] * x[node[1]] + m[2] * x[node[2]]); g.value > 0) {
                    use(node, m, g, area);
                }
            }
        }
    }

    const Network& network_;
    Pipette pipette_;
    std::vector<Vec3> middles_;
};

class Suction final : public Term {
  public:
    Suction(const Network& network, std::span<const Vec3> initial, const Pipette& pipette, double pressure)
        : network_(network), pipette_(pipette), pressure_(pressure) {
        for (const Index3& t : network.triangles()) {
            facesPipette_.push_back(areaVector(initial, t)[2] > 0);
        }
    }

    void addForces(std::span<const Vec3> x, std::span<Vec3> f) const override {
        forEach(x, [&](const Index3& node, const Field& at, double area) {
            for (int k = 0; k < 3; ++k) {
                f[node[k]] += pressure_ * (at.value * areaGradient(x, node, k) + area / 3 * at.gradient);
            }
        });
    }

    double energy(std::span<const Vec3> x) const override {
        double sum = 0;
        forEach(x, [&](const Index3&, const Field& at, double area) { sum -= pressure_ * at.value * area; });
        return sum;
    }

    void addStiffness(std::span<const Vec3> x, Definiteness, Stiffness& stiffness) const override {
        Mat3 turn = Mat3::Zero();  // d2A_z/dx_k dx_k+1
        turn(0, 1) = 0.5, turn(1, 0) = -0.5;
        forEach(x, [&](const Index3& node, const Field& at, double area) {
            Eigen::Matrix<double, 9, 9> matrix;
            for (int k = 0; k < 3; ++k) {
                for (int m = 0; m < 3; ++m) {
                    Mat3 block = area / 9 * at.curvature;
                    block += areaGradient(x, node, k) * at.gradient.transpose() / 3;
                    block += at.gradient * areaGradient(x, node, m).transpose() / 3;
                    if (m == (k + 1) % 3) {
                        block += at.value * turn;
                    } else if (k == (m + 1) % 3) {
                        block += at.value * turn.transpose();
                    }
                    matrix.block<3, 3>(3 * k, 3 * m) = -pressure_ * block;
                }
            }
            stiffness.add(node, matrix);
        });
    }

    double maxStiffness(std::span<const Vec3>) const override { return 0; }  // the stiffness is geometric only

  private:
    struct Field {  // F and its derivatives
        double value;
        Vec3 gradient;
        Mat3 curvature;
    };

    Field field(const Vec3& x) const {
        const double width = 0.5 * pipette_.wall, rho = x.head<2>().norm(), z = x[2] - pipette_.mouth;
        const double h = std::max(0.0, rho - pipette_.radius) / width;  // below 1, as forEach ensures
        const double s = 1 - h * h * (3 - 2 * h), ds = -6 * h * (1 - h) / width;
        const double dds = h > 0 ? -6 * (1 - 2 * h) / (width * width) : 0;
        Field f{s * z, Vec3(0, 0, s), Mat3::Zero()};
        if (h > 0) {
            const Vec3 radial(x[0] / rho, x[1] / rho, 0), hoop(-radial[1], radial[0], 0), up = Vec3::UnitZ();
            f.gradient += ds * z * radial;
            f.curvature = z * (dds * radial * radial.transpose() + ds / rho * hoop * hoop.transpose());
            f.curvature += ds * (radial * up.transpose() + up * radial.transpose());
        }
        return f;
    }

    // dA_z/dx_k: half of z cross the opposite edge.
    static Vec3 areaGradient(std::span<const Vec3> x, const Index3& node, int k) {
        const Vec3 edge = x[node[(k + 2) % 3]] - x[node[(k + 1) % 3]];
        return {-0.5 * edge[1], 0.5 * edge[0], 0};
    }

    template <class Use>
    void forEach(std::span<const Vec3> x, const Use& use) const {
        for (const int t : network_.wholeTriangles()) {
            const Index3& node = network_.triangles()[t];
            const Vec3 middle = (x[node[0]] + x[node[1]] + x[node[2]]) / 3;
            if (facesPipette_[t] && pipette_.isInside(middle)) {
                use(node, field(middle), areaVector(x, node)[2]);
            }
        }
    }

    const Network& network_;
    Pipette pipette_;
    double pressure_;
    std::vector<char> facesPipette_;
};

}  // namespace

double Pipette::touching(std::span<const Vec3> x, double radius, double wall) {
    double mouth = -std::numeric_limits<double>::infinity();
    for (const Vec3& p : x) {
        const double across = p.head<2>().norm() - radius - 0.5 * wall;
        if (std::abs(across) < 0.5 * wall) {
            mouth = std::max(mouth, p[2] - 0.5 * wall + std::sqrt(0.25 * wall * wall - across * across));
        }
    }
    return mouth;
}

std::shared_ptr<const Term> pipetteContact(const Network& network, const Pipette& pipette) {
    return std::make_shared<Contact>(network, pipette);
}

std::shared_ptr<const Term> pipetteSuction(const Network& network, std::span<const Vec3> initial,
                                           const Pipette& pipette, double pressure) {
    return std::make_shared<Suction>(network, initial, pipette, pressure);
}

}  // namespace corpuscle::membrane
