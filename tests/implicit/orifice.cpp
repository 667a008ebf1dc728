// A torn elastic shell under tension drives the fluid out, in implicit steps: as many particles must leave as volume is
// lost, none through the membrane. Lengths in spacings, density and viscosity 1.
#include <gtest/gtest.h>

#include "core/communicator.hpp"
#include "geometry/insideTest.hpp"
#include "implicit/implicitStep.hpp"
#include "tornSphere.hpp"

using namespace corpuscle;
using namespace corpuscle::implicit;
using namespace corpuscle::implicit::testing;
using Vectors = std::vector<Vec3>;

namespace {

// An elastic shell, stretched by a tenth, whose tension drives the fluid out through what is missing of it.
struct Shell {
    static constexpr double rate = 5e-4, dt = 100;  // a twentieth of strain a step
    sph::FluidModel model = fluid(1.5);
    coupling::testing::FluidScene f;
    std::unique_ptr<ImplicitStep> step;
    double count, volume;  // particles and volume inside at the start

    // alive: of the bonds of the TornSphere, made of its mesh.
    template <class Alive>
    Shell(double radius, int level, int length, MPI_Comm comm, Alive&& alive)
        : f(coupling::testing::still({length, length, length}, 0.1), {length, length, length}, model, rate, 0.3, comm,
            particles::Precision::full, {.side = true}) {
        TornSphere torn(level);
        for (Vec3& x : torn.mesh.nodes) x = radius * x + middleOf(length);
        membrane::MembraneSettings laws;
        laws.bonds = coupling::testing::choice<membrane::BondLaw>("{type: harmonic, k: 0.1 N/m}");
        laws.bending = coupling::testing::choice<membrane::BendingLaw>("{type: dihedral, kappa: 0.02 J}");
        Vectors rest = torn.mesh.nodes;
        for (Vec3& x : rest) x /= 1.1;
        membrane::Membrane m("shell", 1, torn.mesh.nodes, torn.mesh.triangles, laws, radius, rest);
        m.restore(alive(torn, m.network()));
        f.scene.cells.add({.membrane = std::move(m), .radius = radius});
        if (comm == MPI_COMM_SELF) cell().holders = {0};
        cell().initialVolume = volume = closedSurface(cell().membrane).volume();
        particles::ParticleStore& s = f.scene.store();
        const geometry::InsideTest inside(closedSurface(cell().membrane));
        for (std::size_t i = 0; i < s.size(); ++i)
            s.setVelocity(i, Vec3::Zero()), s.density[i] = 1,
                                            s.side[i] = inside.inside(s.position(i), f.scene.system->periodicity());
        count = inner();
        ImplicitStep::Options options;
        options.settings = {.step = 1, .tolerance = 1e-4, .error = 1, .bondStrain = 1};
        options.shifting = 1;
        step = ImplicitStep::make(f.scene, options);
    }
    coupling::Cell& cell() { return f.scene.cells[0]; }
    double volumeNow() { return closedSurface(cell().membrane).volume(); }
    double inner() {  // particles inside
        const geometry::InsideTest inside(closedSurface(cell().membrane));
        const particles::ParticleStore& s = f.scene.store();
        double sum = 0;
        for (std::size_t i = 0; i < s.size(); ++i)
            sum += inside.inside(s.position(i), f.scene.system->periodicity()) ? 1 : 0;
        return Communicator(f.scene.system->comm()).sum(sum);
    }
    // Pressure that the tension exerts, a mean over the surface.
    double pressure() {
        const membrane::Membrane& m = cell().membrane;
        Vectors force(m.position.size(), Vec3::Zero());
        m.addElasticForces(m.position, force);
        const Vectors g = membrane::volumeGradient(m.position, m.network().triangles());
        return -dot(g, force) / dot(g, g);
    }
    void run(int steps) {
        for (int k = 0; k < steps; ++k) step->advance(dt);
    }
    double crossings() { return Communicator(f.scene.system->comm()).sum(double(step->noFlux()->crossings())); }
};

}  // namespace

// Through a hole of radius 3.
TEST(Orifice, particlesLeaveAsVolumeIsLost) {
    Shell shell(7.5, 3, 24, MPI_COMM_WORLD,
                [](const TornSphere& torn, const membrane::Network&) { return torn.alive; });
    for (int k = 0; k < 4; ++k) {
        shell.run(10);
        const double lost = shell.volume - shell.volumeNow(), left = shell.count - shell.inner();
        std::printf("strain %.2f: volume lost %.2f, particles %.0f, pressure %.3e, moved back %.0f\n",
                    Shell::rate * Shell::dt * 10 * (k + 1), lost, left, shell.pressure(), shell.crossings());
    }
    const double lost = shell.volume - shell.volumeNow(), left = shell.count - shell.inner();
    EXPECT_GT(lost, 0.06 * shell.volume);
    EXPECT_NEAR(left / lost, 1, 0.03);
    EXPECT_EQ(shell.crossings(), 0);
}

// One bond is missing, or it was: the opening is too small for the fluid, and the sheet does not leak.
TEST(Orifice, aSlitHoldsTheFluid) {
    for (const char state : {'\0', '\2'}) {
        Shell shell(7.5, 3, 24, MPI_COMM_WORLD, [&](const TornSphere&, const membrane::Network& network) {
            std::vector<char> alive(network.allBonds().size(), 1);
            alive[777] = state;
            return alive;
        });
        shell.run(10);
        const double lost = 1 - shell.volumeNow() / shell.volume, scale = shell.pressure() * 10 * Shell::dt;
        std::printf("bond %s: part of the volume lost %.3e, flux per pressure %.4f, particles %.0f\n",
                    state == 0 ? "broken" : "resealed", lost, lost * shell.volume / scale, shell.count - shell.inner());
        EXPECT_LT(std::abs(lost), 1e-4);
    }
}

TEST(Orifice, isTheSameOnOneRankAndOnAll) {
    const auto shell = [](MPI_Comm comm) {
        auto made = std::make_unique<Shell>(
            5, 2, 16, comm, [](const TornSphere& torn, const membrane::Network&) { return torn.alive; });
        made->run(3);
        return made;
    };
    const auto alone = shell(MPI_COMM_SELF), shared = shell(MPI_COMM_WORLD);
    EXPECT_GT(1 - alone->volumeNow() / alone->volume, 1e-3);
    EXPECT_NEAR(alone->volumeNow() / shared->volumeNow(), 1, 1e-7);
    const auto &one = alone->cell().membrane.position, &all = shared->cell().membrane.position;
    for (std::size_t n = 0; n < one.size(); ++n) EXPECT_LT((one[n] - all[n]).norm(), 1e-4) << n;
}
