// A solute that leaves cells through pores: against closed forms, on several ranks, kept to rounding.
#include "coupling/soluteTransport.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/communicator.hpp"
#include "core/error.hpp"
#include "membrane/excessArea.hpp"
#include "sphereScene.hpp"

using namespace corpuscle;
using namespace corpuscle::coupling;
using namespace corpuscle::coupling::testing;

namespace {

struct Options {
    double diffusivity = 1, share = 0.01, stretch = 1.05;
    bool immersed = true;
    double margin = Cells::everywhere;
    double areaModulus = 0;  // of the whole
};
constexpr double poreRadius = 1e-3, poreLength = 1e-9;  // of pores that are hardly more than mouths

// A law by which a sheet stretched by `stretch` has this share of pores.
Choice<membrane::PoreLaw> pores(double share, double stretch) {
    auto law = choice<membrane::PoreLaw>("{type: excessArea, onset: 0, radius: 1 um, length: 1 nm}");
    auto own = std::make_shared<membrane::ExcessArea>(dynamic_cast<const membrane::ExcessArea&>(*law.model));
    own->radius = poreRadius;
    own->onset = stretch > 1 ? 0 : 0.01;
    own->share = stretch > 1 ? share / (1 - 1 / (stretch * stretch)) : 1;
    law.model = own;
    return law;
}
double permeability(double share, double diffusivity) {
    return share * diffusivity / (0.5 * std::numbers::pi * poreRadius + poreLength);
}

// Inflated spheres full of a solute of concentration 1: their pores have the same share of the area everywhere.
struct Sample {
    SphereScene f;
    sph::FluidModel model;
    std::unique_ptr<SoluteTransport> transport;

    Sample(const Options& o, const std::vector<Vec3>& centres)
        : f(
              {14, 10, 10}, centres, o.immersed, o.margin,
              [&](membrane::MembraneSettings& laws) {
                  laws.pores = pores(o.share, o.stretch);
                  if (o.areaModulus == 0) return;
                  laws.bonds = choice<membrane::BondLaw>("{type: harmonic, k: 1e-9 N/m}");
                  laws.bending = {};
                  laws.area.emplace().global = o.areaModulus;
              },
              true),
          model(sph::testing::model("wendlandC2")) {
        model.solute = sph::Solute{0, o.diffusivity, 0};
        for (Cell& cell : f.cells) {
            const Vec3 middle = middleOf(cell);
            for (Vec3& x : cell.membrane.position) x = middle + o.stretch * (x - middle);
        }
        transport = std::make_unique<SoluteTransport>(model, *f.system);
        ParticleStore& s = f.system->store();
        for (std::size_t i = 0; i < s.size(); ++i)
            s.solute[i] = s.kindOf(i) == Kind::fluid && s.side[i] > 0 ? transport->volume(s, i) : 0;
    }
    struct Content {
        double inside = 0, outside = 0, volumeInside = 0, volumeOutside = 0, least = 0, cubes = 0;
    };
    Content content() const {
        const ParticleStore& s = f.system->store();
        Content c;
        for (std::size_t i = 0; i < s.size(); ++i) {
            if (s.kindOf(i) != Kind::fluid) continue;
            (s.side[i] > 0 ? c.inside : c.outside) += s.solute[i];
            (s.side[i] > 0 ? c.volumeInside : c.volumeOutside) += transport->volume(s, i);
            c.least = std::min(c.least, s.solute[i]);
            c.cubes += std::pow(s.solute[i], 3);
        }
        const Communicator ranks;
        ranks.addUp({&c.inside, 4});
        c.least = ranks.min(c.least), c.cubes = ranks.sum(c.cubes);
        return c;
    }
    double area() const {
        double sum = 0;
        const Communicator ranks;
        for (const Cell& cell : f.cells)
            if (cell.isOwnedBy(ranks.rank())) sum += cell.membrane.area();
        return ranks.sum(sum);
    }
};

const std::vector<Vec3> two{{2.9, 5, 5}, {11.4, 5, 5}};  // the second one lies across the periodic face

}  // namespace

// Where the fluid is well mixed on each side, dm/dt = -P A (m/V - (m0 - m)/Vo): an exponential decay.
TEST(SoluteTransport, isReleasedAsInTheClosedForm) {
    for (const bool immersed : {true, false}) {
        Options o{.diffusivity = 4, .share = 4e-6, .immersed = immersed};
        Sample sample(o, two);
        const Sample::Content start = sample.content();
        const double P = permeability(o.share, o.diffusivity),
                     rate = P * sample.area() * (1 / start.volumeInside + 1 / start.volumeOutside);
        const double dt = 0.02 / rate;
        double last = start.inside;
        for (int step = 1; step <= 60; ++step) {
            sample.transport->advance(sample.f.cells, *sample.f.system, dt);
            const Sample::Content now = sample.content();
            const double end = start.inside * start.volumeInside / (start.volumeInside + start.volumeOutside),
                         expected = end + (start.inside - end) * std::exp(-rate * step * dt);
            EXPECT_NEAR(now.inside / expected, 1, 0.01) << step;
            EXPECT_LT(now.inside, last);
            EXPECT_NEAR((now.inside + now.outside) / start.inside, 1, 1e-13);
            EXPECT_GE(now.least, 0);
            last = now.inside;
        }
        EXPECT_LT(last, 0.5 * start.inside);
    }
}

// Nothing is lost, and no particle has less than nothing, whatever the step; and ranks agree (the figures are those of
// one rank).
TEST(SoluteTransport, keepsItsMassInLongSteps) {
    Sample sample({.diffusivity = 0.3, .share = 0.01, .margin = SoluteTransport::margin(1, skin)}, two);
    const Sample::Content start = sample.content();
    for (int step = 0; step < 5; ++step) sample.transport->advance(sample.f.cells, *sample.f.system, 3);
    const Sample::Content now = sample.content();
    EXPECT_NEAR((now.inside + now.outside) / start.inside, 1, 1e-13);
    EXPECT_GE(now.least, 0);
    EXPECT_GT(sample.transport->mostParts(), 3);
    EXPECT_NEAR(now.inside, 10.422168083198520, 1e-10);
    EXPECT_NEAR(now.cubes, 0.565437962152796, 1e-10);
}

// Without diffusion, the flow through the pores passes the solute: Laplace's pressure behind the membrane, through
// Sampson's orifices.
TEST(SoluteTransport, flowsWithThePressure) {
    Options o{.diffusivity = 0, .share = 1e-3};
    o.areaModulus = 3;
    Sample sample(o, two);
    const membrane::Membrane& m = sample.f.cells[0].membrane;  // work of a small inflation: T dA = pressure dV
    const double T = o.areaModulus * (o.stretch * o.stretch - 1), pressure = T * 2 * m.area() / (3 * m.volume()),
                 resistance = 8 * poreLength / (poreRadius * poreRadius) + 3 * std::numbers::pi / poreRadius,
                 q = o.share * pressure / (sample.model.viscosity * resistance), start = sample.content().inside,
                 dt = 0.01 * start / (q * sample.area());
    sample.transport->advance(sample.f.cells, *sample.f.system, dt);
    EXPECT_NEAR((start - sample.content().inside) / (0.01 * start), 1, 0.01);
}

TEST(SoluteTransport, refusesStepsOfTooManyParts) {
    Sample sample({}, two);
    EXPECT_THROW(sample.transport->advance(sample.f.cells, *sample.f.system, 1e6), Failure);
    EXPECT_THROW(sample.transport->advance(sample.f.cells, *sample.f.system, std::nan("")), Failure);
}

// A membrane without strain has no pores, and a solute that does not diffuse stays where it is.
TEST(SoluteTransport, staysInClosedCells) {
    Sample closed({.stretch = 1}, two), still({.diffusivity = 0, .areaModulus = 1e-9}, two);
    const Sample::Content start = closed.content();
    for (int step = 0; step < 3; ++step) {
        closed.transport->advance(closed.f.cells, *closed.f.system, 1);
        still.transport->advance(still.f.cells, *still.f.system, 1);
    }
    EXPECT_NEAR(still.content().inside, start.inside, 1e-12) << "without diffusion and pressure";
    EXPECT_NEAR(closed.content().inside, start.inside, 1e-12);
    EXPECT_EQ(closed.content().outside, 0);
}

// The same by finite volumes in radial shells, implicit in time: what is left in a sphere of radius 1, with D = 1, the
// speed of passage B and fluid outside up to the radius `end`, at each of `count` times `dt` apart.
std::vector<double> leftInShells(double B, double end, double dt, int count) {
    constexpr int inner = 400, parts = 50;
    const double width = 1.0 / inner;
    const int n = static_cast<int>(std::lround(end * inner));
    std::vector<double> volume, c(n, 0.0), left;
    for (int k = 0; k < n; ++k) volume.push_back((std::pow(k + 1.0, 3) - std::pow(k, 3)) * std::pow(width, 3) / 3);
    std::fill(c.begin(), c.begin() + inner, 1.0);
    const auto conductance = [&](int k) {  // between the shells k - 1 and k
        if (k == 0 || k == n) return 0.0;
        return std::pow(k * width, 2) / (width + (k == inner ? 1 / B : 0));
    };
    for (int step = 0; step < count; ++step) {
        for (int part = 0; part < parts; ++part) {  // (V/h + L) c = V/h c_before, by elimination
            const double h = dt / parts;
            std::vector<double> diagonal(n), right(n);
            for (int k = 0; k < n; ++k) {
                diagonal[k] = volume[k] / h + conductance(k) + conductance(k + 1), right[k] = volume[k] / h * c[k];
                if (k == 0) continue;
                const double g = conductance(k), factor = g / diagonal[k - 1];
                diagonal[k] -= factor * g, right[k] += factor * right[k - 1];
            }
            for (int k = n - 1; k >= 0; --k)
                c[k] = (right[k] + (k + 1 < n ? conductance(k + 1) * c[k + 1] : 0)) / diagonal[k];
        }
        double sum = 0;
        for (int k = 0; k < inner; ++k) sum += 3 * volume[k] * c[k];
        left.push_back(sum);
    }
    return left;
}

// Diffusion and passage together, where neither is fast: against the solution in shells.
TEST(SoluteTransport, diffusesOutOfASphere) {
    constexpr double D = 1, stretch = 1.000001;
    double error[2];
    for (int level = 0; level < 2; ++level) {
        const double a = level == 0 ? 4 : 8;
        const int n = level == 0 ? 18 : 36;
        const Index3 size{n, n, n};
        ParticleSystem system(MPI_COMM_WORLD, sph::testing::cube(size), {.side = true, .solute = true}, 2.4, skin, 1);
        sph::testing::deal(sph::testing::lattice(size, 0.1), system);
        auto mesh = membrane::testing::icosphere(level + 2);
        for (Vec3& x : mesh.nodes) x *= a;
        membrane::MembraneSettings laws;
        laws.bonds = choice<membrane::BondLaw>("{type: harmonic, k: 2 N/m}");
        constexpr double B = 2;
        const double share = B * D / a / permeability(1, D);
        laws.pores = pores(share, stretch);
        CellType type{.name = "sphere",
                      .laws = "sphere",
                      .nodes = mesh.nodes,
                      .triangles = mesh.triangles,
                      .settings = laws,
                      .radius = a};
        const Vec3 middle = Vec3::Constant(0.5 * n);
        type.places.push_back({.centre = middle});
        Cells cells({type});
        cells.placeAtStart(system);
        for (Cell& cell : cells)
            for (Vec3& x : cell.membrane.position) x = middle + stretch * (x - middle);
        sph::FluidModel model = sph::testing::model("wendlandC2");
        model.solute = sph::Solute{0, D, 0};
        SoluteTransport transport(model, system);
        ParticleStore& s = system.store();
        for (std::size_t i = 0; i < s.size(); ++i)
            s.side[i] = (s.position(i) - middle).norm() < a ? 1 : 0, s.solute[i] = static_cast<double>(s.side[i]);
        const Communicator ranks;
        const auto inside = [&] {
            double sum = 0;
            for (std::size_t i = 0; i < s.size(); ++i) sum += s.side[i] > 0 ? s.solute[i] : 0;
            return ranks.sum(sum);
        };
        // The sphere of the same ratio of volume to area as these particles and this mesh.
        constexpr double interval = 0.02;  // D t/radius^2
        const double volume = inside(), radius = 3 * volume / cells[0].membrane.area(), end = n / std::cbrt(volume);
        error[level] = 0;
        for (const double expected : leftInShells(B * radius / a, end, interval, 10)) {
            transport.advance(cells, system, interval * radius * radius / D);
            error[level] = std::max(error[level], std::abs(inside() / volume - expected));
        }
    }
    EXPECT_LT(error[0], 0.008) << "a = 4 dx";
    EXPECT_LT(error[1], 0.002) << "a = 8 dx";
}
