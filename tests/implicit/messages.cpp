// Messages between ranks: one to each neighbour for each iteration of the solver, whatever its preconditioner and the
// contents of the scene, and one to each other holder of a cell each time that velocities are interpolated to its
// nodes. They are counted by a replacement of MPI's own function (its profiling interface).
#include <gtest/gtest.h>
#include <mpi.h>

#include "core/communicator.hpp"
#include "coupling/sphereScene.hpp"
#include "implicit/rigidSphereScene.hpp"

namespace {
long sent = 0;
}

extern "C" int MPI_Isend(const void* data, int count, MPI_Datatype type, int rank, int tag, MPI_Comm comm,
                         MPI_Request* request) {
    ++sent;
    return PMPI_Isend(data, count, type, rank, tag, comm, request);
}

using namespace corpuscle;
using namespace corpuscle::implicit;
using namespace corpuscle::implicit::testing;

namespace {

struct Counts {
    long messages, iterations, innerIterations, refinements;
};

Counts ofAStep(coupling::Scene& scene, const char* preconditioner, double tolerance) {
    ImplicitStep::Options options;
    options.settings = {.step = 1, .tolerance = tolerance, .error = 1, .bondStrain = 1};
    options.settings.preconditioner = preconditioner;
    const auto step = ImplicitStep::make(scene, options);
    const long before = sent;
    step->advance(1);
    return {sent - before, step->statistics.iterations, step->statistics.innerIterations, step->statistics.refinements};
}

long neighbours(particles::ParticleSystem& system) {
    particles::SharedParticles shared;
    shared.plan(system);
    std::vector<double> values(shared.entries(), 0.0);
    const long before = sent;
    shared.distribute(values.data(), 1);
    return sent - before;
}

// The number of messages that additional iterations cost. make() returns an object with the member `scene`.
// otherHolders: of its cell.
template <class Make>
void expectOneMessageAnIteration(Make&& make, const char* preconditioner, long otherHolders) {
    auto rough = make(), fine = make();
    const long ranks = rough.scene.system->decomposition().size(), each = neighbours(*rough.scene.system);
    const Counts few = ofAStep(rough.scene, preconditioner, 1e-2), many = ofAStep(fine.scene, preconditioner, 1e-8);
    EXPECT_GT(each, 0);
    EXPECT_LT(each, ranks);
    EXPECT_GE(many.iterations, few.iterations + 4) << preconditioner;
    EXPECT_EQ(many.refinements, few.refinements);
    const long more = many.iterations - few.iterations;
    long asked = more;  // by the system; by withMembrane once and in each inner iteration
    if (preconditioner == std::string("withMembrane")) asked += more + many.innerIterations - few.innerIterations;
    EXPECT_EQ(many.messages - few.messages, each * more + otherHolders * asked) << preconditioner;
}

struct PulledSphere {
    coupling::Scene scene =
        coupling::testing::SphereScene({10, 10, 10}, {Vec3(5, 5, 5)}, true).immersedScene(0.02, [](const Vec3& d) {
            return Vec3(1.01 * d[0], d[1], d[2]);
        });
};

}  // namespace

TEST(Messages, oneToEachNeighbourForAnIterationWithAMembrane) {
    for (const char* preconditioner : {"blockJacobi", "twoLevel", "withMembrane"})
        expectOneMessageAnIteration([] { return PulledSphere(); }, preconditioner, Communicator().size() - 1);
}

TEST(Messages, oneToEachNeighbourForAnIterationWithABody) {
    for (const char* preconditioner : {"blockJacobi", "twoLevel"})
        expectOneMessageAnIteration(
            [] {
                bodies::testing::SphereInFluid f({12, 12, 12}, Vec3(6, 6, 6), "free", 2.5);
                f.setVelocities([](std::size_t, const Vec3&) { return Vec3(Vec3::Zero()); },
                                {Vec3(0.02, 0, 0), Vec3::Zero()});
                return RigidSphereScene(std::move(f), 0.02);
            },
            preconditioner, 0);
}
