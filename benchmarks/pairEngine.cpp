// Speed of the pair engine: particle-steps per core-second and per second of wall clock of the whole explicit loop.
//
// A periodic cube of n^3 particles jittered by 0.1 dx; pressure, Morris viscosity and continuity with Tait's equation
// of state, velocity Verlet, skin 0.3 dx; sorted and listed every 10 steps. Warm-up of 10 steps, then `steps`.
//     pairEngine [n] [support in dx] [steps] [kernel] [double|mixed]        default: 80 2.5 50 lucy double
//     mpirun -np 2 pairEngine 80
#include <mpi.h>
#include <sys/resource.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <random>

#include "core/registry.hpp"
#include "core/startMpi.hpp"
#include "particles/isa.hpp"
#include "sph/velocityVerlet.hpp"

using namespace corpuscle;
using namespace corpuscle::particles;

namespace {

constexpr int stepsPerList = 10;
constexpr double skin = 0.3, dt = 0.02;

double cpuSeconds() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    const auto seconds = [](const timeval& t) {
        return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
    };
    return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

double sum(double value) {
    MPI_Allreduce(MPI_IN_PLACE, &value, 1, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
    return value;
}

// A flow slow enough that nothing moves by half of the skin in ten steps. Every rank draws the same numbers and keeps
// its share.
void fill(ParticleStore& store, int n, int rank, int size) {
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> d(-1, 1);
    const std::int64_t total = static_cast<std::int64_t>(n) * n * n;
    const std::int64_t begin = total * rank / size, end = total * (rank + 1) / size;
    store.resize(static_cast<std::size_t>(end - begin));
    for (std::int64_t id = 0; id < total; ++id) {
        const auto x = static_cast<double>(id % n), y = static_cast<double>(id / n % n),
                   z = static_cast<double>(id / n / n);
        const Vec3 place(x + 0.37 + 0.1 * d(random), y + 0.37 + 0.1 * d(random), z + 0.37 + 0.1 * d(random));
        const Vec3 velocity(0.05 * std::sin(2 * std::numbers::pi * y / n), 0.005 * d(random), 0.005 * d(random));
        const double density = 1 + 0.005 * d(random);
        if (id < begin || id >= end) continue;
        const auto i = static_cast<std::size_t>(id - begin);
        store.setPosition(i, place), store.setVelocity(i, velocity);
        store.density[i] = density;
        store.id[i] = id;
    }
}

// Counts what is spent in list building.
struct Timed {
    double list = 0;
    void rebuild(ParticleSystem& system) {
        const double before = cpuSeconds();
        system.rebuild();
        list += cpuSeconds() - before;
    }
};

template <class Family>
std::shared_ptr<const Family> choose(const std::string& text) {
    Problems problems;
    auto choice = readChoice<Family>(parseValue(text, "pairEngine", problems), problems);
    problems.throwIfAny();
    return choice.model;
}

}  // namespace

int main(int argc, char* argv[]) {
    corpuscle::startMpi(argc, argv);
    const int n = argc > 1 ? std::atoi(argv[1]) : 80;
    const double support = argc > 2 ? std::atof(argv[2]) : 2.5;
    const int steps = argc > 3 ? std::atoi(argv[3]) : 50;
    const std::string kernel = argc > 4 ? argv[4] : "lucy";
    int rank = 0, size = 1;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    MPI_Comm_size(MPI_COMM_WORLD, &size);

    const Box box{Vec3::Zero(), Vec3::Constant(n), {true, true, true}};
    const std::string terms = argc > 5 ? argv[5] : "double";
    ParticleSystem system(MPI_COMM_WORLD, box, {}, support, skin, 1,
                          terms == "mixed" ? Precision::mixed : Precision::full);
    fill(system.store(), n, rank, size);
    system.start();
    sph::FluidModel fluid;
    fluid.kernel = choose<sph::Kernel>(kernel);
    fluid.equationOfState = choose<sph::EquationOfState>("tait");
    fluid.density = fluid.mass = fluid.soundSpeed = 1;
    fluid.viscosity = 0.1;
    sph::FluidForces forces(fluid, system);
    sph::VelocityVerlet integrator(system, forces, nullptr, {});
    integrator.start();

    Timed timed;
    double forceTime = 0;
    double cpuStart = 0, wallStart = 0;
    long rebuildsOfOwnAccord = 0;
    for (int step = -stepsPerList; step < steps; ++step) {
        if (step == 0) {
            MPI_Barrier(MPI_COMM_WORLD);
            timed.list = 0;
            cpuStart = cpuSeconds(), wallStart = MPI_Wtime();
        }
        if (step % stepsPerList == 0) timed.rebuild(system);
        const long before = system.rebuilds();
        integrator.advance(dt);
        rebuildsOfOwnAccord += system.rebuilds() - before;
    }
    const double cpu = sum(cpuSeconds() - cpuStart), wall = MPI_Wtime() - wallStart;
    // Forces alone, repeated on the last state.
    constexpr int repeats = 10;
    const double before = cpuSeconds();
    for (int k = 0; k < repeats; ++k) forces.evaluate(system, 0.5 * dt);
    forceTime = sum(cpuSeconds() - before) / repeats * steps;

    const double total = sum(system.owned()), work = total * steps, list = sum(timed.list);
    const double entries = sum(static_cast<double>(system.list().entries())) * system.list().lanes();
    const double ghosts = sum(system.ghosts());
    if (rank == 0) {
        const auto ns = [&](double seconds) { return 1e9 * seconds / work; };
        std::printf(
            "%s, %s, %s, support %g dx, %.0f particles, %d ranks, %d steps; %.1f lanes per particle, %.1f %% ghosts\n",
            kernel.c_str(), instructionSetName().c_str(), terms.c_str(), support, total, size, steps, entries / total,
            100 * ghosts / total);
        std::printf("million particle-steps: %.2f per core-second, %.2f per second\n", 1e-6 * work / cpu,
                    1e-6 * work / wall);
        std::printf("ns per particle-step: forces %.1f, sort and list %.1f (%.0f per build), integrator %.1f\n",
                    ns(forceTime), ns(list), ns(list) * stepsPerList, ns(cpu - list - forceTime));
        if (rebuildsOfOwnAccord > 0)
            std::printf("attention: %ld lists were built between those of the schedule\n", rebuildsOfOwnAccord);
    }
    MPI_Finalize();
}
