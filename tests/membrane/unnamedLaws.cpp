// A law that the case does not name costs nothing. Costs are counted, not timed: the element matrices give the elements
// that a membrane processes, the bytes what it stores.
#include <gtest/gtest.h>

#include "membrane/membrane.hpp"
#include "membrane/restTriangle.hpp"
#include "meshes.hpp"
#include "settingsText.hpp"
#include "storage.hpp"

namespace corpuscle::membrane {
namespace {

using testing::Mesh;

// Number of element matrices, by the number of their nodes, and of rank-one parts.
struct Count : Stiffness {
    std::map<std::size_t, std::size_t> matrices;
    std::size_t rankOne = 0;

    void add(std::span<const int> nodes, const Eigen::Ref<const Eigen::MatrixXd>&) override {
        ++matrices[nodes.size()];
    }
    void addRankOne(double, std::span<const Vec3>) override { ++rankOne; }
};

struct Cost {
    Count elastic = {}, damping = {};
    std::size_t corners = 0, hinges = 0, damage = 0, bytes = 0;

    Cost& operator+=(const Cost& other) {
        for (const auto& [nodes, count] : other.elastic.matrices) {
            elastic.matrices[nodes] += count;
        }
        for (const auto& [nodes, count] : other.damping.matrices) {
            damping.matrices[nodes] += count;
        }
        elastic.rankOne += other.elastic.rankOne;
        corners += other.corners, hinges += other.hinges, damage += other.damage, bytes += other.bytes;
        return *this;
    }
};

void expectSameButBytes(const Cost& found, const Cost& wanted, const std::string& what) {
    EXPECT_EQ(found.elastic.matrices, wanted.elastic.matrices) << what;
    EXPECT_EQ(found.elastic.rankOne, wanted.elastic.rankOne) << what;
    EXPECT_EQ(found.damping.matrices, wanted.damping.matrices) << what;
    EXPECT_EQ(found.damping.rankOne, 0u) << what;
    EXPECT_EQ(found.corners, wanted.corners) << what;
    EXPECT_EQ(found.hinges, wanted.hinges) << what;
    EXPECT_EQ(found.damage, wanted.damage) << what;
}

const Mesh& mesh() {
    static const Mesh sphere = testing::icosphere(2);
    return sphere;
}

Cost costOf(const MembraneSettings& laws) {
    Cost cost;
    const Mesh& sphere = mesh();
    const std::size_t before = testing::storedBytes();
    const Membrane membrane("cell", 1, sphere.nodes, sphere.triangles, laws, 1);
    cost.bytes = testing::storedBytes() - before;
    membrane.addStiffness(Definiteness::exact, cost.elastic);
    membrane.addDamping(cost.damping);
    cost.corners = membrane.network().corners().size();
    cost.hinges = membrane.network().hinges().size();
    cost.damage = membrane.damage().size();
    return cost;
}

constexpr std::size_t object = 96;  // bytes of a term without lists, at most

const std::string bonds = "bonds: {type: harmonic, k: 2 N/m}";

MembraneSettings settings(const std::string& law) {
    return testing::parsed<MembraneSettings>("{" + bonds + (law.empty() ? "" : ", ") + law + "}");
}

// A law in addition to bonds. `wanted` is the additional cost of the law; its bytes are an upper bound, as lists grow
// by doubling.
struct Law {
    const char* text;
    Cost wanted;
};

std::vector<Law> laws() {
    const std::size_t nodes = mesh().nodes.size(), triangles = mesh().triangles.size(), edges = triangles * 3 / 2;
    const std::size_t cornerBytes = 2 * 3 * triangles * sizeof(Corner), hingeBytes = 2 * edges * sizeof(Hinge);
    const auto elastic = [](std::size_t ofNodes, std::size_t count, std::size_t rankOne = 0) {
        Count made;
        made.matrices[ofNodes] = count;
        made.rankOne = rankOne;
        return made;
    };
    Cost curvature{.hinges = edges, .bytes = hingeBytes + object + nodes * sizeof(int)};
    // A node with its ring of neighbours: twelve nodes of the icosphere have five neighbours.
    curvature.elastic.matrices = {{6, 12}, {7, nodes - 12}};
    return {
        {"triangles: {type: skalak, Gs: 1 N/m, C: 1}",
         {.elastic = elastic(3, triangles), .bytes = object + triangles * sizeof(RestTriangle)}},
        {"angles: {type: harmonic, k: 1 J}",
         {.elastic = elastic(3, 3 * triangles), .corners = 3 * triangles, .bytes = cornerBytes + object}},
        {"bending: {type: dihedral, kappa: 1 J}",
         {.elastic = elastic(4, edges), .hinges = edges, .bytes = hingeBytes + object}},
        {"bending: {type: helfrich, kappa: 1 J}", curvature},
        {"area: {local: 1 N/m}", {.elastic = elastic(3, triangles), .bytes = object}},
        {"area: {global: 1 N/m}", {.elastic = elastic(3, triangles, 1), .bytes = object}},
        {"volume: {modulus: 1 Pa}", {.elastic = elastic(2, edges, 1), .bytes = object}},
        {"viscosity: {shear: 1 N s/m}", {.damping = elastic(3, triangles)}},
        {"rupture: {type: bondStretch, limit: 1.05}", {}},
        {"rupture: {type: arealStrain, limit: 0.05}", {}},
        {"rupture: {type: tension, limit: 1 N/m}", {}},
        {"rupture: {type: damage, onset: 0.01, scale: 0.02, time: 1 s, exponent: 2}",
         {.damage = triangles, .bytes = triangles * sizeof(double)}},
        {"interior: {viscosityRatio: 5}", {}},
    };
}

TEST(UnnamedLaws, BondsAloneAreOneTermWithoutListsOfItsOwn) {
    const Cost network = costOf(MembraneSettings{}), found = costOf(settings(""));
    expectSameButBytes(network, {}, "no law");
    Cost wanted;
    wanted.elastic.matrices[2] = mesh().triangles.size() * 3 / 2;
    expectSameButBytes(found, wanted, bonds);
    EXPECT_GT(found.bytes, network.bytes);
    EXPECT_LE(found.bytes, network.bytes + object);
}

TEST(UnnamedLaws, EachLawThatIsNamedAddsItsOwnAndNoMore) {
    const Cost base = costOf(settings(""));
    for (const Law& law : laws()) {
        const Cost found = costOf(settings(law.text));
        Cost wanted = base;
        wanted += law.wanted;
        expectSameButBytes(found, wanted, law.text);
        EXPECT_GE(found.bytes, base.bytes) << law.text;
        EXPECT_LE(found.bytes, wanted.bytes) << law.text;
        RecordProperty(law.text, std::to_string(found.bytes - base.bytes) + " bytes");
    }
}

TEST(UnnamedLaws, TogetherTheyCostTheSum) {
    std::string all;
    Cost wanted = costOf(settings(""));
    for (const Law& law : laws()) {
        const std::string key = std::string(law.text).substr(0, std::string(law.text).find(':') + 1);
        if (all.find(key) == std::string::npos) {  // only one law for each key
            all += (all.empty() ? "" : ", ") + std::string(law.text);
            wanted += law.wanted;
        }
    }
    const Cost found = costOf(settings(all));
    expectSameButBytes(found, wanted, all);
    EXPECT_LE(found.bytes, wanted.bytes);
}

// Velocities and rupture, which no law needs, are not evaluated: NaN would show in the results.
TEST(UnnamedLaws, VelocitiesAndTearsAreNotLookedAt) {
    const double none = std::numeric_limits<double>::quiet_NaN();
    Membrane membrane("cell", 1, mesh().nodes, mesh().triangles, settings("bending: {type: dihedral, kappa: 1 J}"), 1);
    membrane.velocity.assign(mesh().nodes.size(), Vec3::Constant(none));
    membrane.computeForces();
    for (const Vec3& f : membrane.force) {
        EXPECT_TRUE(f.allFinite());
    }
    membrane.position = testing::deformed(mesh().nodes, 0.3);
    const std::size_t before = testing::storedBytes();
    EXPECT_TRUE(membrane.findBroken(none).empty());
    EXPECT_EQ(testing::storedBytes(), before);
}

}  // namespace
}  // namespace corpuscle::membrane
