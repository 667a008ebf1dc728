// sphFlow: a viscous fluid alone, by weakly compressible SPH.
//
// Sample runs:
//     sphFlow -case tutorials/couette
//     mpirun -np 2 sphFlow -case tutorials/couette -steps 100
//     sphFlow -case tutorials/couette -dry-run
#include "simulation/retreat.hpp"

using namespace corpuscle;

int main(int argc, char* argv[]) {
    Application app("sphFlow", "Viscous flow by weakly compressible SPH.", argc, argv,
                    simulation::solverUsage("sphFlow"));  // options, MPI, log, exit codes
    return app.run([&] {
        app.announce();
        const simulation::Case input = simulation::Case::read(app);  // 1. strict dictionaries, SI from here on
        Problems problems;
        if (!input.mesh.cells.empty())
            problems.add({"system/mesh.yaml", 0, 0}, "cells",
                         "the case has cells, and sphFlow is for a fluid alone: run dmpFlow");
        if (!input.mesh.bodies.empty())
            problems.add({"system/mesh.yaml", 0, 0}, "bodies",
                         "the case has bodies, and sphFlow is for a fluid alone: run dmpFlow");
        problems.throwIfAny();
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
            if (step.advance())  // Eqs 5, 6, 12-17; back where it fails
                after.afterStep(scene, time);
        return after.end(scene, time);
    });
}
