// dmpFlow: red blood cells and capsules in a viscous fluid, coupled in one particle system, with membranes that can
// rupture.
//
// Sample runs:
//     dmpFlow -case tutorials/rbcShear/Ca0.02
//     mpirun -np 2 dmpFlow -case tutorials/rbcShear/Ca0.02 -steps 100
//     dmpFlow -case tutorials/rbcShear/Ca0.02 -dry-run
#include "simulation/run.hpp"

using namespace corpuscle;

int main(int argc, char* argv[]) {
    Application app("dmpFlow", "Red blood cells and capsules in flow: SPH fluid, mass-spring membranes, rupture.", argc,
                    argv,
                    simulation::solverUsage("dmpFlow"));  // options, MPI, log, exit codes
    return app.run([&] { return simulation::run(app); });
}
