// sphFlow: a viscous fluid alone, by weakly compressible SPH.
//
// Sample runs:
//     sphFlow -case tutorials/couette
//     mpirun -np 2 sphFlow -case tutorials/couette -steps 100
//     sphFlow -case tutorials/couette -dry-run
#include "simulation/run.hpp"

using namespace corpuscle;

namespace {
void requireFluidAlone(const simulation::Case& input) {
    Problems problems;
    if (!input.mesh.cells.empty())
        problems.add({"system/mesh.yaml", 0, 0}, "cells",
                     "the case has cells, and sphFlow is for a fluid alone: run dmpFlow");
    if (!input.mesh.bodies.empty())
        problems.add({"system/mesh.yaml", 0, 0}, "bodies",
                     "the case has bodies, and sphFlow is for a fluid alone: run dmpFlow");
    problems.throwIfAny();
}
}  // namespace

int main(int argc, char* argv[]) {
    Application app("sphFlow", "Viscous flow by weakly compressible SPH.", argc, argv,
                    simulation::solverUsage("sphFlow"));  // options, MPI, log, exit codes
    return app.run([&] {
        simulation::RunHooks hooks;
        hooks.check = requireFluidAlone;
        return simulation::run(app, hooks);
    });
}
