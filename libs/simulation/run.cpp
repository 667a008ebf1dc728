#include "simulation/run.hpp"

#include "simulation/liveSettings.hpp"
#include "simulation/rollback.hpp"

namespace corpuscle::simulation {

ExitCode run(Application& app, const RunHooks& hooks) {
    app.announce();
    LiveSettings live(app);
    Case input = Case::read(app);  // 1. strict dictionaries, SI from here on
    hooks.check(input);
    StartingPoint start = prepare(app, input);  // 2. only what the case names exists
    if (start.isFinished) return ExitCode::done;
    coupling::Scene& scene = start.scene;
    Time& time = start.time;
    Integrator integrator(input, scene);  // 3. the scheme, its terms fixed once
    startIntegrator(start, integrator, time);
    Schedule after(app, input, start, integrator);  // 4. observers, writers, checkpoints
    if (app.has("dry-run")) return after.dryRun(scene, time);

    after.begin(scene, time);
    Rollback step(input, scene, time, integrator, after, app.log());
    while (time.running() && !after.stopRequested(scene, time)) {
        if (live.update(input, scene, time, after)) {
            step.forget();
            continue;  // the end may be another
        }
        hooks.beforeStep(scene, time, integrator);
        if (step.advance()) after.afterStep(scene, time);  // false: rolled back
    }
    return after.end(scene, time);
}

}  // namespace corpuscle::simulation
