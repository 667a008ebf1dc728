// Every law: force = -grad(energy), no net force, no net torque; on a regular and an irregular mesh, strongly deformed.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <sstream>

#include "membrane/areaConstraint.hpp"
#include "membrane/blockStiffness.hpp"
#include "membrane/dihedralBending.hpp"
#include "membrane/fenePow.hpp"
#include "membrane/harmonicAngle.hpp"
#include "membrane/harmonicBond.hpp"
#include "membrane/helfrichBending.hpp"
#include "membrane/latticeSheet.hpp"
#include "membrane/linearElastic.hpp"
#include "membrane/neoHookean.hpp"
#include "membrane/skalak.hpp"
#include "membrane/volumeConstraint.hpp"
#include "membrane/wlcPow.hpp"
#include "meshes.hpp"

namespace corpuscle::membrane {
namespace {

using testing::Mesh;

struct LawCase {
    const char* name;
    std::function<std::unique_ptr<Term>(Network&)> make;
    bool restsInMesh = true;  // no forces in the stress-free mesh
};

std::unique_ptr<Term> helfrich(Network& n, double c0, std::optional<double> reduced) {
    HelfrichBending law;
    law.kappa = 0.7;
    law.spontaneousCurvature = c0;
    if (reduced) {
        law.areaDifference = AreaDifference{.ratio = 0.6, .reduced = reduced};
    }
    return law.makeTerm(n, {});
}

std::unique_ptr<Term> area(Network& n, const AreaConstraint& law) { return std::move(law.makeTerms(n).front()); }

// x0 and m are such that the largest stretch here, 2.6, stays within the contour length.
template <class Law>
std::unique_ptr<Term> contour(Network& n, double m, bool scaled) {
    Law law;
    law.Gs = 0.7;
    law.x0 = 0.3;
    law.m = m;
    law.scaled = scaled;
    return law.makeTerm(n);
}

template <class Law>
std::unique_ptr<Term> sheet(Network& n, Law law) {
    law.Gs = 0.7;
    return law.makeTerm(n);
}

std::vector<LawCase> laws() {
    return {{"bonds harmonic",
             [](Network& n) {
                 HarmonicBond law;
                 law.k = 0.7;
                 return law.makeTerm(n);
             }},
            {"bonds harmonic scaled",
             [](Network& n) {
                 HarmonicBond law;
                 law.k = 0.7;
                 law.scaled = true;
                 return law.makeTerm(n);
             }},
            {"bonds wlcPow", [](Network& n) { return contour<WlcPow>(n, 2, false); }},
            {"bonds wlcPow m 1.5 scaled", [](Network& n) { return contour<WlcPow>(n, 1.5, true); }},
            {"bonds fenePow", [](Network& n) { return contour<FenePow>(n, 2, false); }},
            {"bonds fenePow m 3 scaled", [](Network& n) { return contour<FenePow>(n, 3, true); }},
            {"triangles neoHookean", [](Network& n) { return sheet(n, NeoHookean{}); }},
            {"triangles skalak",
             [](Network& n) {
                 Skalak law;
                 law.C = 2;
                 return sheet(n, law);
             }},
            {"triangles linear",
             [](Network& n) {
                 LinearElastic law;
                 law.Ks = 1.9;
                 return sheet(n, law);
             }},
            {"triangles lattice", [](Network& n) { return sheet(n, LatticeSheet{}); }},
            {"angles harmonic",
             [](Network& n) {
                 HarmonicAngle law;
                 law.k = 0.7;
                 return law.makeTerm(n);
             }},
            {"bending dihedral",
             [](Network& n) {
                 DihedralBending law;
                 law.k = 0.7;
                 return law.makeTerm(n, {});
             }},
            {"bending helfrich", [](Network& n) { return helfrich(n, 0, {}); }, false},
            {"bending helfrich c0", [](Network& n) { return helfrich(n, 1.5, {}); }, false},
            {"bending helfrich area difference", [](Network& n) { return helfrich(n, -0.5, 1.4); }, false},
            {"area local", [](Network& n) { return area(n, {.local = 0.7}); }},
            {"area global", [](Network& n) { return area(n, {.global = 0.7}); }},
            {"area local with a target", [](Network& n) { return area(n, {.local = 0.7, .rest = 8.0}); }, false},
            {"volume", [](Network& n) { return VolumeConstraint{.modulus = 7}.makeTerm(n, 1); }},
            {"volume with a target",
             [](Network& n) { return VolumeConstraint{.modulus = 7, .reducedVolume = 0.8}.makeTerm(n, 9); }, false}};
}

// Fourth-order central differences: error (h/height of the thinnest triangle)^4 and rounding/h, both below 1e-8 of
// the largest force here.
double differenceForce(const Term& term, std::vector<Vec3>& x, std::size_t node, int axis, double h) {
    const double start = x[node][axis];
    const auto energyAt = [&](double shift) {
        x[node][axis] = start + shift;
        const double e = term.energy(x);
        x[node][axis] = start;
        return e;
    };
    return -(8 * (energyAt(h) - energyAt(-h)) - (energyAt(2 * h) - energyAt(-2 * h))) / (12 * h);
}

// Records a relative error for the table of docs/theory/membrane.md.
void record(const LawCase& law, const Mesh& mesh, const std::string& what, double error) {
    std::ostringstream text;
    text << error;
    ::testing::Test::RecordProperty(std::string(law.name) + "; " + what + "; " + std::to_string(mesh.nodes.size()),
                                    text.str());
}

void checkForces(const Mesh& mesh, double edge, const LawCase& law) {
    Network network(mesh.nodes, mesh.triangles);
    const auto term = law.make(network);
    std::vector<Vec3> x = testing::deformed(mesh.nodes, edge);
    std::vector<Vec3> f(x.size(), Vec3::Zero());
    term->addForces(x, f);

    double largest = 0;
    Vec3 sum = Vec3::Zero(), torque = Vec3::Zero();
    for (std::size_t n = 0; n < x.size(); ++n) {
        largest = std::max(largest, f[n].cwiseAbs().maxCoeff());
        sum += f[n];
        torque += x[n].cross(f[n]);
    }
    ASSERT_GT(largest, 0.01) << law.name;
    EXPECT_LT(sum.norm(), 1e-12 * largest * static_cast<double>(x.size())) << law.name;
    EXPECT_LT(torque.norm(), 1e-12 * largest * static_cast<double>(x.size())) << law.name;
    double worst = 0;
    for (std::size_t n = 0; n < x.size(); ++n) {
        for (int axis = 0; axis < 3; ++axis) {
            worst = std::max(worst, std::abs(f[n][axis] - differenceForce(*term, x, n, axis, 2e-4 * edge)));
        }
    }
    EXPECT_LT(worst, 1e-7 * largest) << law.name;
    record(law, mesh, "gradient", worst / largest);
    record(law, mesh, "force and torque", (sum.norm() + torque.norm()) / (largest * static_cast<double>(x.size())));

    if (!law.restsInMesh) {
        return;
    }
    // Forces at rest are exactly zero: rest values come from the same arithmetic.
    std::vector<Vec3> rest(x.size(), Vec3::Zero());
    term->addForces(mesh.nodes, rest);
    for (const Vec3& force : rest) {
        EXPECT_EQ(force.norm(), 0) << law.name;
    }
}

TEST(Forces, AreMinusTheGradientOnARegularMesh) {
    for (const LawCase& law : laws()) {
        checkForces(testing::icosphere(1), 0.55, law);
    }
}

TEST(Forces, AreMinusTheGradientOnAnIrregularMesh) {
    for (const LawCase& law : laws()) {
        checkForces(testing::irregular(2), 0.28, law);
    }
}

// With broken bonds: broken elements exert no force, also at rims, and terms of the whole cell have ended.
TEST(Forces, AreMinusTheGradientOnAnOpenCell) {
    const Mesh mesh = testing::irregular(1);
    for (const LawCase& law : laws()) {
        Network network(mesh.nodes, mesh.triangles);
        const auto term = law.make(network);
        network.breakBonds(std::vector<int>{3, 40, 41, 90});
        std::vector<Vec3> x = testing::deformed(mesh.nodes, 0.55);
        std::vector<Vec3> f(x.size(), Vec3::Zero());
        term->addForces(x, f);
        double largest = 0, worst = 0;
        for (std::size_t n = 0; n < x.size(); ++n) {
            largest = std::max(largest, f[n].cwiseAbs().maxCoeff());
            for (int axis = 0; axis < 3; ++axis) {
                worst = std::max(worst, std::abs(f[n][axis] - differenceForce(*term, x, n, axis, 1e-4)));
            }
        }
        EXPECT_LE(worst, 1e-7 * largest) << law.name;
    }
}

Eigen::MatrixXd stiffnessOf(const Term& term, const std::vector<Vec3>& x, Definiteness definiteness) {
    const auto size = static_cast<Eigen::Index>(3 * x.size());
    AssembledStiffness stiffness(x.size());
    term.addStiffness(x, definiteness, stiffness);
    Eigen::MatrixXd matrix(size, size);
    for (Eigen::Index k = 0; k < size; ++k) {
        matrix.col(k) = stiffness * Eigen::VectorXd::Unit(size, k);
    }
    return matrix;
}

// The stiffness against differences of the force; its semi-definite and partwise forms have no negative eigenvalue.
void checkStiffness(const Mesh& mesh, double edge, const LawCase& law, const std::vector<int>& broken = {}) {
    Network network(mesh.nodes, mesh.triangles);
    const auto term = law.make(network);
    network.breakBonds(broken);
    std::vector<Vec3> x = testing::deformed(mesh.nodes, edge);
    if (!broken.empty() && term->energy(x) == 0) {
        return;  // a term of the whole cell, which ends when the cell opens
    }
    const auto size = static_cast<Eigen::Index>(3 * x.size());
    AssembledStiffness exact(x.size());
    term->addStiffness(x, Definiteness::exact, exact);

    Eigen::MatrixXd matrix(size, size), difference(size, size);
    const double h = 2e-4 * edge;
    for (Eigen::Index k = 0; k < size; ++k) {
        const Eigen::VectorXd unit = Eigen::VectorXd::Unit(size, k);
        matrix.col(k) = exact * unit;
        difference.col(k).setZero();
        double& place = x[static_cast<std::size_t>(k / 3)][k % 3];
        const double start = place;
        for (const auto& [shift, weight] : {std::pair{h, 8.0}, {-h, -8.0}, {2 * h, -1.0}, {-2 * h, 1.0}}) {
            place = start + shift;
            std::vector<Vec3> f(x.size(), Vec3::Zero());
            term->addForces(x, f);
            for (Eigen::Index n = 0; n < size; ++n)
                difference(n, k) -= weight * f[static_cast<std::size_t>(n / 3)][n % 3] / (12 * h);
        }
        place = start;
    }
    const double largest = matrix.cwiseAbs().maxCoeff();
    EXPECT_GT(largest, 0.01) << law.name;
    const double worst = (matrix - difference).cwiseAbs().maxCoeff();
    EXPECT_LT(worst, 1e-7 * largest) << law.name;
    record(law, mesh, broken.empty() ? "stiffness" : "stiffness of an open cell", worst / largest);
    EXPECT_LT((matrix - matrix.transpose()).cwiseAbs().maxCoeff(), 1e-12 * largest) << law.name;
    for (const Definiteness definiteness : {Definiteness::semiDefinite, Definiteness::partwise}) {
        const Eigen::MatrixXd projected = stiffnessOf(*term, x, definiteness);
        EXPECT_LT((projected - projected.transpose()).cwiseAbs().maxCoeff(), 1e-12 * largest) << law.name;
        const Eigen::VectorXd values = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(projected).eigenvalues();
        EXPECT_GT(values.minCoeff(), -1e-12 * values.maxCoeff()) << law.name;
        EXPECT_GT(values.maxCoeff(), 0.01) << law.name;
    }
}

TEST(Stiffness, IsTheDerivativeOfTheForce) {
    for (const LawCase& law : laws()) {
        checkStiffness(testing::icosphere(1), 0.55, law);
        checkStiffness(testing::irregular(1), 0.55, law);
        checkStiffness(testing::irregular(1), 0.55, law, {3, 40, 90});
    }
}

// Without stress there is no geometric stiffness, hence nothing that the partwise form leaves out.
TEST(Stiffness, PartwiseIsExactAtRest) {
    for (const LawCase& law : laws()) {
        if (!law.restsInMesh) {
            continue;
        }
        for (const Mesh& mesh : {testing::icosphere(1), testing::irregular(1)}) {
            Network network(mesh.nodes, mesh.triangles);
            const auto term = law.make(network);
            const Eigen::MatrixXd exact = stiffnessOf(*term, mesh.nodes, Definiteness::exact),
                                  partwise = stiffnessOf(*term, mesh.nodes, Definiteness::partwise);
            EXPECT_LT((partwise - exact).cwiseAbs().maxCoeff(), 1e-12 * exact.cwiseAbs().maxCoeff()) << law.name;
        }
    }
}

// A bond under tension, and a triangle in biaxial tension whose law is convex in the strain, have positive
// semi-definite stiffness: the partwise form is exact there too, to half the digits, because of the closed form of the
// eigenvalues. (Skalak's law is not convex.)
TEST(Stiffness, PartwiseIsExactUnderTension) {
    for (const LawCase& law : laws()) {
        const std::string name = law.name;
        if ((name.find("bonds") != 0 && name.find("triangles") != 0) || name == "triangles skalak") {
            continue;
        }
        const Mesh mesh = testing::irregular(1);
        Network network(mesh.nodes, mesh.triangles);
        const auto term = law.make(network);
        std::vector<Vec3> x = mesh.nodes;
        for (Vec3& node : x) {
            node *= 1.2;
        }
        const Eigen::MatrixXd exact = stiffnessOf(*term, x, Definiteness::exact),
                              partwise = stiffnessOf(*term, x, Definiteness::partwise);
        EXPECT_LT((partwise - exact).cwiseAbs().maxCoeff(), 1e-8 * exact.cwiseAbs().maxCoeff()) << law.name;
        const Eigen::MatrixXd atRest = stiffnessOf(*term, mesh.nodes, Definiteness::exact);
        EXPECT_GT((atRest - exact).cwiseAbs().maxCoeff(), 1e-2 * exact.cwiseAbs().maxCoeff()) << law.name;
    }
}

// BlockStiffness against the assembled sparse matrix: products, diagonal, and filling a second time.
TEST(Stiffness, BlocksEqualTheAssembledMatrix) {
    const Mesh mesh = testing::irregular(1);
    const std::size_t nodes = mesh.nodes.size();
    for (const LawCase& law : laws()) {
        Network network(mesh.nodes, mesh.triangles);
        const auto term = law.make(network);
        BlockStiffness blocks(nodes);
        for (const double edge : {0.3, 0.55}) {
            const std::vector<Vec3> x = testing::deformed(mesh.nodes, edge);
            blocks.clear();
            term->addStiffness(x, Definiteness::exact, blocks);
            const Eigen::MatrixXd matrix = stiffnessOf(*term, x, Definiteness::exact);
            const double largest = matrix.cwiseAbs().maxCoeff();
            std::vector<Vec3> u(nodes, Vec3::Zero()), result(nodes, Vec3(1, 2, 3));
            testing::jitter(u, 1, 5);
            blocks.addProduct(0.7, u, result);
            const auto size = static_cast<Eigen::Index>(3 * nodes);
            const Eigen::VectorXd expected = 0.7 * matrix * Eigen::Map<const Eigen::VectorXd>(u.front().data(), size);
            for (std::size_t n = 0; n < nodes; ++n) {
                const auto at = static_cast<Eigen::Index>(3 * n);
                EXPECT_LT((result[n] - Vec3(1, 2, 3) - expected.segment<3>(at)).norm(), 1e-12 * largest * 10)
                    << law.name;
                EXPECT_LT((blocks.diagonal(n) - matrix.block<3, 3>(at, at)).norm(), 1e-12 * largest) << law.name;
            }
        }
    }
}

// Largest eigenvalue of the sum of E'' g g^T, by power iteration on differences of the force at rest (where the
// geometric part vanishes): it is below maxStiffness(), by a factor of at most the number of nodes of an element.
TEST(Forces, MaxStiffnessBoundsTheStiffness) {
    const Mesh mesh = testing::irregular(1);
    for (const LawCase& law : laws()) {
        if (!law.restsInMesh) {
            continue;
        }
        Network network(mesh.nodes, mesh.triangles);
        const auto term = law.make(network);
        std::vector<Vec3> direction(mesh.nodes.size(), Vec3::Zero());
        testing::jitter(direction, 1, 3);
        double eigenvalue = 0;
        for (int pass = 0; pass < 200; ++pass) {
            double norm = 0;
            for (const Vec3& d : direction) {
                norm += d.squaredNorm();
            }
            constexpr double h = 1e-5;
            std::vector<Vec3> plus = mesh.nodes, minus = mesh.nodes, change(plus.size(), Vec3::Zero()), back = change;
            for (std::size_t n = 0; n < plus.size(); ++n) {
                direction[n] /= std::sqrt(norm);
                plus[n] += h * direction[n];
                minus[n] -= h * direction[n];
            }
            term->addForces(plus, change);
            term->addForces(minus, back);
            eigenvalue = 0;
            for (std::size_t n = 0; n < plus.size(); ++n) {
                change[n] = (back[n] - change[n]) / (2 * h);
                eigenvalue += change[n].dot(direction[n]);
            }
            direction = change;
        }
        EXPECT_LE(eigenvalue, term->maxStiffness(mesh.nodes)) << law.name;
        EXPECT_GE(4 * eigenvalue, term->maxStiffness(mesh.nodes)) << law.name;
    }
}

TEST(Coordinates, CornerAngleHoldsItsAccuracyNearZeroAndPi) {
    for (const double theta : {1e-7, 1e-3, std::numbers::pi - 1e-3, std::numbers::pi - 1e-7}) {
        const auto q =
            CornerAngle::at({Vec3(1, 2, 0), Vec3(4, 2, 0), Vec3(1 + 2 * std::cos(theta), 2 + 2 * std::sin(theta), 0)});
        EXPECT_NEAR(q.value, theta, 1e-14);
        EXPECT_NEAR(q.gradient[1].y(), -1.0 / 3, 1e-9);  // 1/|u|, turning u towards v closes the angle
        EXPECT_NEAR(q.gradient[2].norm(), 1.0 / 2, 1e-9);
    }
    const auto straight = CornerAngle::at({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(-2, 0, 0)});
    EXPECT_EQ(straight.value, std::numbers::pi);
    EXPECT_EQ(straight.gradient[1].norm(), 0);
}

TEST(Coordinates, DihedralAngleIsPositiveWhereConvexAndReachesNearlyPi) {
    const Vec3 a(0, 0, 0), b(0, 1, 0);
    for (const double fold : {0.3, -0.3, 3.1, -3.1}) {
        const Vec3 c(-1, 0.5, 0), d(std::cos(fold), 0.2, -std::sin(fold));
        EXPECT_NEAR(DihedralAngle::at({a, b, c, d}).value, fold, 1e-14);
    }
}

}  // namespace
}  // namespace corpuscle::membrane
