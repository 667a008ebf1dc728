// Bond and triangle laws: response at finite strain against their formulas, on a regular and an irregular mesh, and
// inflation of a sphere.
#include <gtest/gtest.h>

#include "geometry/mesher.hpp"
#include "geometry/spheroid.hpp"
#include "inPlaneCases.hpp"
#include "membrane/diagnostics.hpp"

namespace corpuscle::membrane {
namespace {

using namespace testing;

// Nominal stress dW/dF of a patch from its forces: F -> F + dF moves node X by dF X.
Mat2 nominalStress(const Mesh& mesh, const MembraneSettings& laws, const Mat2& F) {
    const auto membrane = makeMembrane(mesh, laws);
    membrane->position = mapped(mesh, F);
    membrane->computeForces();
    Mat2 sum = Mat2::Zero();
    for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
        sum -= membrane->force[n].head<2>() * mesh.nodes[n].head<2>().transpose();
    }
    return sum / areaOf(mesh);
}

// Formulas of a law, written independently of it: dW/dl1 of W(l1, l2), and dW/dgamma of simple shear (I1 = gamma^2, I2
// = 0).
struct Response {
    const char* name;
    MembraneSettings laws;
    std::function<double(double, double)> stretch;
    std::function<double(double)> shear;
};

// Mean over directions of the lattice law's W = 4 Gs <(l - 1)^2>.
double overDirections(int directions, const std::function<double(double, double)>& ofDirection) {
    double sum = 0;
    for (int k = 0; k < directions; ++k) {
        const double phi = std::numbers::pi * k / directions;
        sum += ofDirection(std::cos(phi), std::sin(phi)) / directions;
    }
    return sum;
}

std::vector<Response> responses(int directions) {
    return {{"neoHookean", only(neoHookean()), [](double a, double b) { return G * (a - 1 / (a * a * a * b * b)); },
             [](double g) { return G * g; }},
            {"skalak", only(skalak()),
             [](double a, double b) { return G * a * (a * a - 1 + C * b * b * (a * a * b * b - 1)); },
             [](double g) { return G * (g * g * g + g); }},
            {"linear", only(linear()),
             [](double a, double b) { return a * (0.5 * (K - G) * (a * a + b * b - 2) + G * (a * a - 1)); },
             [](double g) { return 0.5 * (K - G) * g * g * g + G * (g * g * g + g); }},
            {"lattice", only(lattice()),
             [=](double a, double b) {
                 return overDirections(directions, [&](double c, double s) {
                     const double l = std::hypot(a * c, b * s);
                     return 8 * G * (l - 1) / l * a * c * c;
                 });
             },
             [=](double g) {
                 return overDirections(directions, [&](double c, double s) {
                     const double l = std::hypot(c + g * s, s);
                     return 8 * G * (l - 1) / l * (c + g * s) * s;
                 });
             }}};
}

// The width at which a sheet stretched by l1 is free of lateral tension.
double freeWidth(const Response& law, double l1) {
    double low = 0.4, high = 1.2;
    for (int k = 0; k < 60; ++k) {
        const double middle = 0.5 * (low + high);
        (law.stretch(middle, l1) < 0 ? low : high) = middle;
    }
    return low;
}

// On the regular patch the twelve directions of the lattice law are the same in all triangles. On the irregular one
// each triangle has its own directions, and the result agrees with the mean over all directions within the error that
// the law's header states: 1e-5 of the energy at a stretch of 1.6.
TEST(InPlaneLaws, TriangleLawsAtFiniteStrain) {
    for (const bool regular : {true, false}) {
        const Mesh mesh = regular ? hexagonalPatch(5) : jitteredPatch(5);
        for (const Response& law : responses(regular ? 12 : 720)) {
            const bool isLattice = law.name == std::string("lattice");
            const double tolerance = (isLattice && !regular ? 1e-4 : 1e-9) * G;
            double worst = 0;
            const auto near = [&](double found, double wanted, const char* what) {
                EXPECT_NEAR(found, wanted, tolerance * std::max(1.0, std::abs(wanted) / G)) << law.name << ' ' << what;
                worst = std::max(worst, std::abs(found - wanted) / std::max(G, std::abs(wanted)));
            };
            for (const double l : {0.85, 1.2, 1.6}) {
                const double width = freeWidth(law, l);
                const Mat2 uniaxial = nominalStress(mesh, law.laws, Eigen::Vector2d(l, width).asDiagonal());
                near(uniaxial(0, 0), law.stretch(l, width), "uniaxial");
                near(uniaxial(1, 1), 0, "uniaxial, across");
                const Mat2 equal = nominalStress(mesh, law.laws, l * Mat2::Identity());
                near(equal(0, 0), law.stretch(l, l), "equibiaxial");
                near(equal(1, 1), law.stretch(l, l), "equibiaxial");
                const Mat2 pure = nominalStress(mesh, law.laws, Eigen::Vector2d(l, 1 / l).asDiagonal());
                near(pure(0, 0), law.stretch(l, 1 / l), "pure shear");
                near(pure(1, 1), law.stretch(1 / l, l), "pure shear");
            }
            const Mat2 simple = nominalStress(mesh, law.laws, (Mat2() << 1, 0.7, 0, 1).finished());
            near(simple(0, 1), law.shear(0.7), "simple shear");
            RecordProperty(law.name + std::string(regular ? ", regular" : ", irregular"), std::to_string(worst));

            // The same tension from principalTensions, which needs no bonds: T1 = l1/(l1 l2) dW/dl1.
            const Network network(mesh.nodes, mesh.triangles);
            const auto t = principalTensions(network, law.laws, mapped(mesh, Eigen::Vector2d(1.3, 0.9).asDiagonal()));
            near(t.tension1[7], law.stretch(1.3, 0.9) / 0.9, "tension1");
            near(t.tension2[7], law.stretch(0.9, 1.3) / 1.3, "tension2");
        }
    }
}

struct BondResponse {
    const char* name;
    MembraneSettings laws;
    std::function<double(double, double)> tension;  // of l, l0
};

std::vector<BondResponse> bondResponses() {
    const auto wlc = [](double x) { return 0.25 / ((1 - x) * (1 - x)) - 0.25 + x; };
    const auto fene = [](double l, double x) { return 0.8 * l / (1 - x * x); };
    return {{"harmonic", only(harmonic(2)), [](double l, double l0) { return 2 * (l - l0); }},
            {"wlcPow", only(wlcByLength()),
             [=](double l, double l0) {
                 const double x0 = 0.4545, kp = 1.3 / 0.9 * wlc(x0) * l0 * l0;
                 return 1.3 / 0.9 * wlc(x0 * l / l0) - kp / (l * l);
             }},
            {"fenePow", only(feneBySpring()), [=](double l, double l0) {
                 const double x0 = 0.45, kp = fene(l0, x0) * std::pow(l0, 2.5);
                 return fene(l, x0 * l / l0) - kp / std::pow(l, 2.5);
             }}};
}

// Nominal stress of a network: 1/A sum over edges of E'(l) l (F n)(n)^T l0^2/l^2, each edge once.
TEST(InPlaneLaws, BondLawsAtFiniteStrain) {
    for (const Mesh& mesh : {hexagonalPatch(5), jitteredPatch(5)}) {
        std::map<std::pair<int, int>, int> edges;
        for (const Index3& t : mesh.triangles) {
            for (int k = 0; k < 3; ++k) {
                ++edges[std::minmax(t[k], t[(k + 1) % 3])];
            }
        }
        for (const BondResponse& law : bondResponses()) {
            for (const Mat2& F : {Mat2(Eigen::Vector2d(1.5, 0.8).asDiagonal()), Mat2(0.8 * Mat2::Identity()),
                                  Mat2(1.4 * Mat2::Identity()), (Mat2() << 1, 0.6, 0, 1).finished()}) {
                Mat2 wanted = Mat2::Zero();
                for (const auto& [edge, count] : edges) {
                    const Eigen::Vector2d R = (mesh.nodes[edge.second] - mesh.nodes[edge.first]).head<2>(), r = F * R;
                    wanted += law.tension(r.norm(), R.norm()) / r.norm() * r * R.transpose() / areaOf(mesh);
                }
                const Mat2 found = nominalStress(mesh, law.laws, F);
                EXPECT_LT((found - wanted).cwiseAbs().maxCoeff(), 1e-10 * wanted.cwiseAbs().maxCoeff()) << law.name;
            }
        }
    }
}

// Pressure of a sphere of radius a inflated l times: dE/dV of a uniform radial scaling. Its nodes are displaced from
// those of the mesher along the surface by up to a quarter of an edge; its mean edge is a/15.2.
TEST(InPlaneLaws, InflationOfASphere) {
    const geometry::TriangleMesh made = geometry::meshSurface(geometry::Sphere(1), 1 / 15.5);
    Mesh mesh{made.nodes, made.triangles};
    jitter(mesh.nodes, 0.25 / 15.5, 3);
    for (Vec3& x : mesh.nodes) {
        x.normalize();
    }
    struct Row {
        const char* name;
        MembraneSettings laws;
        std::function<double(double)> pressure;
    };
    const std::vector<Row> rows{
        {"neoHookean", only(neoHookean()), [](double l) { return 2 * G * (1 - std::pow(l, -6)) / l; }},
        {"skalak", only(skalak()), [](double l) { return 2 * G * (l - 1 / l + C * l * (std::pow(l, 4) - 1)); }},
        {"linear", only(linear()), [](double l) { return 2 * K * (l * l - 1) / l; }},
        {"lattice", only(lattice()), [](double l) { return 8 * G * (l - 1) / (l * l); }}};
    for (const Row& row : rows) {
        const auto membrane = makeMembrane(mesh, row.laws);
        EXPECT_LE(membrane->network().meanBondLength(), 1.0 / 15);
        EXPECT_GE(membrane->network().meanBondLength(), 1.0 / 15.6);
        double worst = 0;
        for (const double l : {1.05, 1.2, 1.5}) {
            for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
                membrane->position[n] = l * mesh.nodes[n];
            }
            membrane->computeForces();
            double work = 0;  // dE/dl
            for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
                work -= membrane->force[n].dot(mesh.nodes[n]);
            }
            const double pressure = work / (3 * membrane->volume() / l), wanted = row.pressure(l);
            EXPECT_NEAR(pressure, wanted, 5e-3 * wanted) << row.name;
            worst = std::max(worst, std::abs(pressure / wanted - 1));
        }
        RecordProperty(std::string(row.name), std::to_string(worst));
    }
    RecordProperty("edge",
                   "a/" + std::to_string(1 / makeMembrane(mesh, rows.front().laws)->network().meanBondLength()));
    // The number in the capsule table of the reference data: Skalak, C = 1, l = 1.2.
    EXPECT_NEAR(2 * (1.2 - 1 / 1.2 + 1.2 * (std::pow(1.2, 4) - 1)), 3.3100, 5e-5);
}

}  // namespace
}  // namespace corpuscle::membrane
