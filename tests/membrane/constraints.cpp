// Area and volume constraints: moduli, targets, and their end on an open cell.
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "membrane/areaConstraint.hpp"
#include "membrane/membrane.hpp"
#include "membrane/surface.hpp"
#include "membrane/volumeConstraint.hpp"
#include "meshes.hpp"

namespace corpuscle::membrane {
namespace {

using testing::Mesh;

constexpr double pi = std::numbers::pi;

double areaOf(const std::vector<Vec3>& x, const Mesh& mesh) {
    double sum = 0;
    for (const Index3& t : mesh.triangles) {
        sum += areaVector(x, t).norm();
    }
    return sum;
}

double volumeOf(const std::vector<Vec3>& x, const Mesh& mesh) {
    double sum = 0;
    for (const Index3& t : mesh.triangles) {
        sum += tetrahedron(x[t[0]], x[t[1]], x[t[2]], Vec3::Zero());
    }
    return sum;
}

double energyOf(const AreaConstraint& law, Network& network, const std::vector<Vec3>& x) {
    double sum = 0;
    for (const auto& term : law.makeTerms(network)) {
        sum += term->energy(x);
    }
    return sum;
}

// E/A = K/2 (e1 + e2)^2 for small strains, with K = local + global, and nothing in shear.
TEST(Area, ModuliOfAFlatSheet) {
    const Mesh mesh = testing::hexagonalPatch(5);
    Network network(mesh.nodes, mesh.triangles);
    const double e = 1e-4, area = areaOf(mesh.nodes, mesh);
    const auto strained = [&](double xx, double yy) {
        std::vector<Vec3> x = mesh.nodes;
        for (Vec3& p : x) {
            p = Vec3((1 + xx) * p.x(), (1 + yy) * p.y(), 0);
        }
        return x;
    };
    for (const AreaConstraint& law : {AreaConstraint{.local = 3}, {.global = 3}, {.local = 1, .global = 2}}) {
        EXPECT_NEAR(energyOf(law, network, strained(e, e)) / (2 * e * e * area), 3, 3e-3);
        EXPECT_NEAR(energyOf(law, network, strained(e, 0)) / (0.5 * e * e * area), 3, 3e-3);
        EXPECT_NEAR(energyOf(law, network, strained(e, -e)) / (e * e * area), 0, 1e-6);
    }
}

// Two triangles change by +10 % and -10 %; the total area does not change.
TEST(Area, LocalSeesWhatGlobalDoesNot) {
    const Mesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}}, {{0, 1, 2}, {0, 3, 1}}};
    Network network(mesh.nodes, mesh.triangles);
    std::vector<Vec3> x = mesh.nodes;
    x[2].y() = 1.1;
    x[3].y() = -0.9;
    EXPECT_NEAR(energyOf({.local = 3}, network, x), 2 * 1.5 * 0.05 * 0.05 / 0.5, 1e-14);
    EXPECT_NEAR(energyOf({.global = 3}, network, x), 0, 1e-14);
}

TEST(Area, Targets) {
    const Mesh mesh = testing::irregular(2);
    Network network(mesh.nodes, mesh.triangles);
    const double own = areaOf(mesh.nodes, mesh), target = 1.21 * own;
    std::vector<Vec3> x = mesh.nodes;
    for (Vec3& p : x) {
        p *= 1.1;
    }
    for (const AreaConstraint& law : {AreaConstraint{.local = 3, .rest = target}, {.global = 3, .rest = target}}) {
        EXPECT_NEAR(energyOf(law, network, x), 0, 1e-12);
        EXPECT_NEAR(energyOf(law, network, mesh.nodes), 1.5 * (target - own) * (target - own) / target, 1e-12);
    }
}

TEST(Volume, TargetsAndPressure) {
    const Mesh mesh = testing::irregular(2);
    Network network(mesh.nodes, mesh.triangles);
    const double V = volumeOf(mesh.nodes, mesh), A = areaOf(mesh.nodes, mesh), K = 5;
    const auto energy = [&](const VolumeConstraint& law, double restArea) {
        return law.makeTerm(network, restArea)->energy(mesh.nodes);
    };
    const auto expected = [&](double target) { return 0.5 * K * (V - target) * (V - target) / target; };
    EXPECT_EQ(energy({.modulus = K}, A), 0);
    EXPECT_NEAR(energy({.modulus = K, .rest = 0.7 * V}, A), expected(0.7 * V), 1e-12);
    EXPECT_NEAR(energy({.modulus = K, .reducedVolume = 0.6}, A),
                expected(0.6 * 4 * pi / 3 * std::pow(A / (4 * pi), 1.5)), 1e-12);
    EXPECT_NEAR(energy({.modulus = K, .reducedVolume = 0.6}, 1.2 * A),
                expected(0.6 * 4 * pi / 3 * std::pow(1.2 * A / (4 * pi), 1.5)), 1e-12);

    // Virial of a pressure P = K (1 - V/V0): sum of F.x = 3 P V, wherever the cell is.
    const double target = 1.3 * V, P = K * (1 - V / target);
    for (const Vec3& away : {Vec3(0, 0, 0), Vec3(40, -70, 10)}) {
        std::vector<Vec3> x = mesh.nodes, f(x.size(), Vec3::Zero());
        for (Vec3& p : x) {
            p += away;
        }
        VolumeConstraint{.modulus = K, .rest = target}.makeTerm(network, A)->addForces(x, f);
        double virial = 0;
        for (std::size_t n = 0; n < x.size(); ++n) {
            virial += f[n].dot(mesh.nodes[n]);
        }
        EXPECT_NEAR(virial, 3 * P * V, 1e-11);
    }
}

TEST(Volume, NeedsAClosedMeshWithNormalsOutward) {
    const VolumeConstraint law{.modulus = 1};
    const Mesh patch = testing::hexagonalPatch(3);
    Network open(patch.nodes, patch.triangles);
    EXPECT_THROW(law.makeTerm(open, 1), Failure);
    Mesh inward = testing::icosphere(1);
    for (Index3& t : inward.triangles) {
        std::swap(t[0], t[1]);
    }
    Network turned(inward.nodes, inward.triangles);
    EXPECT_THROW(law.makeTerm(turned, 1), Failure);
}

TEST(OpenCell, GlobalTermsLetGoAndTheLocalOneOfBrokenTriangles) {
    const Mesh mesh = testing::icosphere(2);
    Network network(mesh.nodes, mesh.triangles);
    const auto volume = VolumeConstraint{.modulus = 1}.makeTerm(network, 1);
    const auto terms = AreaConstraint{.local = 1, .global = 1}.makeTerms(network);
    std::vector<Vec3> x = mesh.nodes;
    for (Vec3& p : x) {
        p *= 1.05;
    }
    const double local = terms[0]->energy(x), part = 0.5 * (1.05 * 1.05 - 1) * (1.05 * 1.05 - 1);
    EXPECT_NEAR(local, part * areaOf(mesh.nodes, mesh), 1e-12);
    EXPECT_GT(terms[1]->energy(x), 0);
    EXPECT_GT(volume->energy(x), 0);

    network.breakBonds(std::vector<int>{7});
    EXPECT_NEAR(local - terms[0]->energy(x), part * network.holeRestArea(), 1e-12);
    for (const Term* term : {terms[1].get(), volume.get()}) {
        std::vector<Vec3> f(x.size(), Vec3::Zero());
        term->addForces(x, f);
        AssembledStiffness stiffness(x.size());
        term->addStiffness(x, Definiteness::exact, stiffness);
        EXPECT_EQ(term->energy(x), 0);
        EXPECT_EQ(term->maxStiffness(x), 0);
        EXPECT_EQ(stiffness.sparse().nonZeros(), 0);
        EXPECT_TRUE(stiffness.rankOne().empty());
        for (const Vec3& force : f) {
            EXPECT_EQ(force.norm(), 0);
        }
    }
}

// A membrane from a case's settings: the target of the volume follows that of the area, and a constraint that is not
// named has no effect.
TEST(MembraneLaws, AreaAndVolume) {
    const Mesh mesh = testing::icosphere(2);
    const auto energyWith = [&](const std::string& text) {
        Problems problems;
        const auto settings = read<MembraneSettings>(
            parseDictionary("bonds: {type: harmonic, k: 1 N/m}\n" + text, "constant/membranes.yaml", problems),
            problems);
        problems.throwIfAny();
        return Membrane("cell", 1, mesh.nodes, mesh.triangles, settings, 1).energy();
    };
    const double A = areaOf(mesh.nodes, mesh), V = volumeOf(mesh.nodes, mesh);
    const double sphere = 4 * pi / 3 * std::pow(A / (4 * pi), 1.5), target = 0.5 * sphere;
    EXPECT_EQ(energyWith(""), 0);
    EXPECT_EQ(energyWith("area: {local: 2 N/m, global: 3 N/m}\nvolume: {modulus: 4 Pa}\n"), 0);
    EXPECT_NEAR(energyWith("volume: {modulus: 4 Pa, reducedVolume: 0.5}\n"), 2 * (V - target) * (V - target) / target,
                1e-12);
    const double wide = 0.5 * 8 * sphere;  // four times the area
    EXPECT_NEAR(energyWith("area: {global: 1e-90 N/m, rest: " + std::to_string(4 * A) +
                           " m^2}\nvolume: {modulus: 4 Pa, reducedVolume: 0.5}\n"),
                2 * (V - wide) * (V - wide) / wide, 1e-4);
}

}  // namespace
}  // namespace corpuscle::membrane
