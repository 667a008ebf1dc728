// Bond and triangle laws: their limits, rupture, and that laws that are not named cost nothing.
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "inPlaneCases.hpp"
#include "membrane/bondStretch.hpp"
#include "membrane/diagnostics.hpp"
#include "membrane/moduli.hpp"

namespace corpuscle::membrane {
namespace {

using namespace testing;

TEST(InPlaneLaws, BondsAtTheirContourLength) {
    for (const MembraneSettings& laws : {only(contour<WlcPow>(0.5, 2)), only(contour<FenePow>(0.5, 2))}) {
        const Mesh mesh = hexagonalPatch(2);
        const auto membrane = makeMembrane(mesh, laws);
        membrane->position = mapped(mesh, 1.999 * Mat2::Identity());
        EXPECT_NO_THROW(membrane->computeForces());
        EXPECT_TRUE(std::isfinite(membrane->energy()));
        membrane->position = mapped(mesh, 2.001 * Mat2::Identity());
        EXPECT_TRUE(std::isinf(membrane->energy()));
        try {
            membrane->computeForces();
            FAIL() << "no failure beyond the contour length";
        } catch (const Failure& failure) {
            EXPECT_EQ(failure.code(), ExitCode::numerics);
            EXPECT_NE(std::string(failure.what()).find("contour length"), std::string::npos);
        }
        membrane->position[3].x() = std::numeric_limits<double>::quiet_NaN();
        EXPECT_THROW(membrane->computeForces(), Failure);
    }
}

TEST(InPlaneLaws, BrokenTrianglesLetGo) {
    const Mesh mesh = irregular(2);
    Network network(mesh.nodes, mesh.triangles);
    const auto term = skalak().makeTerm(network);
    const auto x = deformed(mesh.nodes, 0.28);
    const double before = term->energy(x);
    std::vector<int> around;
    for (const Bond& bond : network.bonds()) {
        if (bond.node[0] == 20 || bond.node[1] == 20) {
            around.push_back(bond.number);
        }
    }
    double lost = 0;
    for (const Index3& t : mesh.triangles) {
        if (t[0] == 20 || t[1] == 20 || t[2] == 20) {
            const RestTriangle rest(mesh.nodes, t);
            lost += rest.area * skalak().energy(rest.strain(edgeProducts(x[t[1]] - x[t[0]], x[t[2]] - x[t[0]])));
        }
    }
    network.breakBonds(around);
    EXPECT_GT(lost, 0);
    EXPECT_NEAR(term->energy(x), before - lost, 1e-12 * before);
    std::vector<Vec3> f(x.size(), Vec3::Zero());
    term->addForces(x, f);
    EXPECT_EQ(f[20].norm(), 0);
    Vec3 sum = Vec3::Zero();
    for (const Vec3& force : f) {
        sum += force;
    }
    EXPECT_LT(sum.norm(), 1e-10);
}

// Bonds are the network's edges: also where no law acts on them, they break, and their stretch is measured.
TEST(InPlaneLaws, RuptureAndDiagnosticsWithoutBondLaw) {
    const Mesh mesh = icosphere(2);
    MembraneSettings laws = only(neoHookean());
    auto rupture = std::make_shared<BondStretch>();
    rupture->limit = 1.3;
    laws.rupture = {"bondStretch", rupture};
    const auto membrane = makeMembrane(mesh, laws);
    EXPECT_NEAR(membrane->scale().shearModulus, G, 1e-15);
    for (Vec3& x : membrane->position) {
        x.x() *= 1.4;
    }
    EXPECT_GT(maxBondStrain(membrane->network(), membrane->position), 0.3);
    EXPECT_GT(principalTensions(membrane->network(), laws, membrane->position).tension1[0], 0);
    const double before = membrane->energy();
    const auto broken = membrane->findBroken(0);
    membrane->breakBonds(broken);
    EXPECT_GT(broken.size(), 10u);
    EXPECT_GT(membrane->network().brokenTriangles(), 10);
    EXPECT_LT(membrane->energy(), before);
    const auto tensions = principalTensions(membrane->network(), laws, membrane->position);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        EXPECT_EQ(tensions.tension1[t] == 0, membrane->network().isBroken(static_cast<int>(t)));
    }
}

class CountElements : public Stiffness {
  public:
    std::map<std::size_t, int> byNodes;
    void add(std::span<const int> nodes, const Eigen::Ref<const Eigen::MatrixXd>&) override { ++byNodes[nodes.size()]; }
    void addRankOne(double, std::span<const Vec3>) override { FAIL(); }
};

// Passes over elements are counted by the element matrices; storage by what the network and the terms hold.
TEST(InPlaneLaws, WhatIsNotNamedCostsNothing) {
    const Mesh mesh = icosphere(1);
    for (const ModuliCase& c : moduliCases()) {
        const auto membrane = makeMembrane(mesh, c.laws);
        CountElements count;
        membrane->addStiffness(Definiteness::exact, count);
        const auto wanted = c.laws.bonds ? std::map<std::size_t, int>{{2, 120}} : std::map<std::size_t, int>{{3, 80}};
        EXPECT_EQ(count.byNodes, wanted) << c.name;
        EXPECT_TRUE(membrane->network().corners().empty());
        EXPECT_TRUE(membrane->network().hinges().empty());
    }
    static_assert(sizeof(BondTerm<Harmonic>) == sizeof(Term) + sizeof(const Network*) + sizeof(Harmonic),
                  "bonds that are not scaled keep nothing for it");
}

TEST(InPlaneLaws, ConstantsArePrinted) {
    EXPECT_NE(describeConstants(only(wlcByLength()), 1).find("p 0.9 m"), std::string::npos);
    EXPECT_NE(describeConstants(only(skalak()), 1).find("Ks 7.7 N/m"), std::string::npos);
    MembraneSettings both = only(skalak());
    both.bonds = only(harmonic(2, true)).bonds;
    const std::string text = describeConstants(both, 1);
    EXPECT_NE(text.find("k 2 N/m, scaled"), std::string::npos) << text;
    EXPECT_NE(text.find("Gs 1.966 N/m"), std::string::npos) << text;  // 1.1 + 0.866
}

}  // namespace
}  // namespace corpuscle::membrane
