// dmpFlow: red blood cells and capsules in a viscous fluid, coupled in one particle system, until they rupture.
//
// Sample runs:
//     dmpFlow -case tutorials/rbcShear/Ca0.02
//     mpirun -np 2 dmpFlow -case tutorials/rbcShear/Ca0.02 -steps 100
//     dmpFlow -case tutorials/rbcShear/Ca0.02 -dry-run
#include "simulation/retreat.hpp"

using namespace corpuscle;

int main(int argc, char* argv[]) {
    Application app("dmpFlow", "Red blood cells and capsules in flow: SPH fluid, mass-spring membranes, rupture.", argc,
                    argv,
                    simulation::solverUsage("dmpFlow"));  // options, MPI, log, exit codes
    return app.run([&] {
        app.announce();
        const simulation::Case input = simulation::Case::read(app);         // 1. strict dictionaries, SI from here on
        simulation::StartingPoint start = simulation::prepare(app, input);  // 2. only what the case names exists
        if (start.isFinished) return ExitCode::done;
        coupling::Scene& scene = start.scene;
        Time& time = start.time;
        simulation::Integrator integrator(input, scene);  // 3. terms fixed once
        simulation::startIntegrator(start, integrator, scene, time);
        simulation::Schedule after(app, input, start, integrator);  // 4. observers, writers, checkpoints
        if (app.has("dry-run")) return after.dryRun(scene, time);

        after.begin(scene, time);
        simulation::Retreat step(input, scene, time, integrator, after, app.log());
        while (time.running() && !after.stopRequested(scene, time))
            if (step.advance())  // Eqs 5, 6, 8, 12-17; rupture; leakage guard; back where it fails
                after.afterStep(scene, time);
        return after.end(scene, time);
    });
}
