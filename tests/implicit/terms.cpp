// Terms of the implicit system: they are symmetric, semi-definite, and linear about their load. The defect of the
// membranes, and steps that the membranes reject. Lengths in spacings, density 1.
#include <gtest/gtest.h>

#include "coupling/fluidScene.hpp"
#include "coupling/sphereScene.hpp"
#include "implicit/fluidTerm.hpp"
#include "implicit/membraneTerm.hpp"

using namespace corpuscle;
using namespace corpuscle::implicit;
using particles::ParticleStore;
using particles::RealArray;

namespace {

constexpr double duration = 0.2;
using Field = Term<double>::Field;

// The particles of a scene, with the shared particles of other ranks for a term that needs them.
struct Particles {
    const ParticleStore& store;
    particles::SharedParticles* shared = nullptr;
    std::size_t entries() const { return shared ? shared->entries() : store.size(); }
};

// Random numbers that do not depend on the number of ranks.
Field field(const Particles& p, unsigned seed, double size) {
    const ParticleStore& s = p.store;
    Field v(4 * p.entries(), 0.0);
    for (std::size_t i = 0; i < s.size(); ++i) {
        std::mt19937_64 random(seed + 7919 * static_cast<unsigned>(s.id[i]));
        std::uniform_real_distribution<double> d(-size, size);
        for (std::size_t k = 0; k < 3; ++k) v[4 * i + k] = d(random);
    }
    if (p.shared) p.shared->distribute(v.data(), 4);
    return v;
}

double product(const Particles& p, const Field& a, const RealArray& b) {
    double sum = 0;
    for (std::size_t k = 0; k < 4 * p.store.size(); ++k) sum += a[k] * b[k];
    return sph::testing::sumOverRanks(sum);
}

RealArray times(Term<double>& term, const Field& v) {  // -A v
    RealArray forces(v.size(), 0.0);
    term.addProduct(v, forces);
    return forces;
}

void expectSymmetricAndLinear(Term<double>& term, const Particles& p) {
    const Field v = field(p, 1, 1e-3), w = field(p, 2, 1e-3), none(v.size(), 0.0);
    const RealArray Av = times(term, v), Aw = times(term, w);
    const double cross = product(p, w, Av), own = product(p, v, Av);
    EXPECT_NEAR(product(p, v, Aw), cross, 1e-12 * std::abs(own));
    EXPECT_LT(own, 0);
    EXPECT_GT(std::abs(cross), 1e-6 * std::abs(own)) << "a sum that vanishes shows nothing";
    RealArray load(v.size(), 0.0), forces(v.size(), 0.0);
    term.addForces(none, load), term.addForces(v, forces);
    double worst = 0, largest = 0;
    for (std::size_t k = 0; k < v.size(); ++k)
        worst = std::max(worst, std::abs(forces[k] - load[k] - Av[k])), largest = std::max(largest, std::abs(Av[k]));
    EXPECT_LE(worst, 1e-11 * largest);
}

// With a lead, A is that of a reach of both durations together. The force at the extrapolated velocity is the same as
// without a lead; from there it changes by -A times the change of velocity.
void expectLeadFromTheExtrapolated(Term<double>& term, const Particles& p) {
    const Field v0 = field(p, 1, 1e-3), v = field(p, 2, 1e-3);
    RealArray without(v.size(), 0.0), first(v.size(), 0.0), forces(v.size(), 0.0), again(v.size(), 0.0);
    term.prepare({duration}), term.addForces(v0, without);
    term.prepare({duration, 0.3 * duration}), term.addFirstForces(v0, first);
    term.addForces(v, forces), term.addForces(v0, again);
    const RealArray Av = times(term, v), Av0 = times(term, v0);
    term.prepare({1.3 * duration});
    const RealArray asLong = times(term, v);
    term.prepare({duration});
    const RealArray shorter = times(term, v);
    double worst = 0, largest = 0, longer = 0;
    for (std::size_t k = 0; k < v.size(); ++k) {
        largest = std::max(largest, std::abs(Av[k])), longer = std::max(longer, std::abs(Av[k] - shorter[k]));
        worst = std::max({worst, std::abs(first[k] - without[k]), std::abs(again[k] - without[k]),
                          std::abs(forces[k] - first[k] - Av[k] + Av0[k]), std::abs(Av[k] - asLong[k])});
    }
    EXPECT_GT(longer, 0.01 * largest);
    EXPECT_LE(worst, 1e-11 * largest);
}

struct Fluid : coupling::testing::FluidScene {
    FluidTerm<double> term{scene, {}};
    Particles particles{scene.store(), &term.operators().shared()};

    Fluid()
        : FluidScene(coupling::testing::still({8, 8, 10}, 0.2), {8, 8, 10}, sph::testing::model("wendlandC2", "linear"),
                     1e-4, 0, MPI_COMM_WORLD, corpuscle::particles::Precision::full) {
        term.prepare({duration});
    }
};

struct Membranes : coupling::testing::SphereScene {
    coupling::Immersed immersed;
    std::vector<double> volumes;
    ImplicitSettings settings;
    MembraneTerm<double> term;

    Membranes()
        : SphereScene({10, 10, 10}, {Vec3(5, 5, 5)}, true),
          immersed(cells, corpuscle::sph::testing::model("wendlandC2"), *system),
          volumes(system->store().size(), 1.0),
          term(immersed, *system, volumes, settings) {
        for (Vec3& x : cells[0].membrane.position) x[0] += 0.05 * (x[0] - 5);
        cells[0].initialVolume = cells[0].membrane.volume();
        begin({duration}, stretching(0));
    }
    void begin(const Reach& reach, const Field& v0) {
        term.prepare(reach);
        RealArray forces(v0.size(), 0.0);
        term.addFirstForces(v0, forces);
    }
    Field stretching(double rate) const {
        const ParticleStore& s = system->store();
        Field v(4 * s.size(), 0.0);
        for (std::size_t i = 0; i < s.size(); ++i) v[4 * i] = rate * (s.x[i] - 5), v[4 * i + 2] = -rate * (s.z[i] - 5);
        return v;
    }
    // Largest force of the defect when nodes have moved by `strain`, at the rate `strain/duration`.
    double defect(double strain) {
        EXPECT_EQ(term.whyNot(stretching(strain / duration), 0), "");
        RealArray forces(4 * system->store().size(), 0.0);
        term.addDefect(forces);
        double largest = 0;
        for (const double f : forces) largest = std::max(largest, std::abs(f));
        MPI_Allreduce(MPI_IN_PLACE, &largest, 1, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
        return largest;
    }
};

}  // namespace

TEST(Terms, fluidIsSymmetricAndLinear) {
    Fluid f;
    expectSymmetricAndLinear(f.term, f.particles);
    EXPECT_TRUE(f.term.isLinear());
    for (std::size_t i = 0; i < f.scene.store().size(); ++i) EXPECT_GT(f.term.diagonal(i), 0);
    expectLeadFromTheExtrapolated(f.term, f.particles);
}

// Forces that an earlier term added to own particles stay in the sum; the entries of ghosts equal those on their owners
// to the last bit.
TEST(Terms, forcesOnOthersParticlesAreThoseOfTheirRanks) {
    Fluid f;
    const Field v = field(f.particles, 1, 1e-3);
    RealArray earlier(v.size(), 0.0);
    for (std::size_t i = 0; i < f.scene.store().size(); ++i) earlier[4 * i] = 1e-3 * std::sin(f.scene.store().id[i]);
    RealArray forces = earlier;
    f.term.addProduct(v, forces);
    RealArray owners = forces;
    f.particles.shared->distribute(owners.data(), 4);
    EXPECT_EQ(forces, owners);
    const RealArray alone = times(f.term, v);
    double worst = 0, largest = 0;
    for (std::size_t k = 0; k < 4 * f.scene.store().size(); ++k) {
        worst = std::max(worst, std::abs(forces[k] - alone[k] - earlier[k]));
        largest = std::max(largest, std::abs(alone[k]));
    }
    EXPECT_GT(largest, 0);
    EXPECT_LE(worst, 1e-13 * (largest + 1e-3));
}

TEST(Terms, membranesAreSymmetricAndLinearAboutTheirLoad) {
    Membranes m;
    const Particles particles{m.system->store()};
    expectSymmetricAndLinear(m.term, particles);
    EXPECT_FALSE(m.term.isLinear());
    const Field v = m.stretching(0.01), w = field(particles, 3, 1e-3);
    RealArray forces(v.size(), 0.0);
    m.term.addForces(v, forces);
    const double power = product(particles, w, forces);
    EXPECT_NEAR(sph::testing::sumOverRanks(m.term.power(v, w)), power, 1e-10 * std::abs(power));
    expectLeadFromTheExtrapolated(m.term, particles);
}

// What the linear force leaves out is of second order in the displacement. Partwise stiffness also leaves out parts
// that are not positive semi-definite, so the defect has a part of first order too (membrane/stiffness.hpp), small
// compared with the force.
TEST(Terms, defectOfMembranesGoesWithTheDisplacement) {
    Membranes m;
    const double small = m.defect(0.001), large = m.defect(0.1);
    EXPECT_GT(small, 0);
    EXPECT_GT(large, 100 * small);
    m.defect(0.1);
    m.term.takeDefect();
    EXPECT_LT(m.defect(0.1), 1e-12) << "what has been taken into the load is no defect any more";
}

// At the extrapolated velocity a lead changes neither the linear force nor the positions at which the defect is
// evaluated.
TEST(Terms, defectAtTheExtrapolatedVelocityIsThatWithoutALead) {
    Membranes m;
    const double without = m.defect(0.1);
    m.begin({duration, 0.3 * duration}, m.stretching(0.1 / duration));
    EXPECT_NEAR(m.defect(0.1), without, 1e-9 * without);
}

TEST(Terms, membranesRefuseAStepThatStretchesABondTooFar) {
    Membranes m;
    const Field v = m.stretching(1);
    EXPECT_EQ(m.term.whyNot(v, 0.05), "");
    EXPECT_NE(m.term.whyNot(v, 0.2).find("bondStrain"), std::string::npos);
}
