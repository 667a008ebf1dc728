#!/usr/bin/env python3
"""Ends of steps: exactly at results, curves and ends, for any number of ranks and wherever a run is split; strain over restarts; runs without progress.

    steppingRuns.py BIN TEST    BIN: directory of the applications
"""
import json
import pathlib
import sys
import tempfile

import runs
from runs import CELL_CASE, FLUID_CASE, copied, last_checkpoint, prepared, run, same_checkpoint, same_in_parts, table

# The capsule of runs.py, smaller and in a smaller box.
SMALL = {**runs.IMPLICIT_CASE, "system/mesh.yaml": """domain: {size: [10 um, 10 um, 10 um], periodic: [true, true, false]}
cells: [{name: rbc, shape: {type: sphere, radius: 3 um}, edge: 1 um, centre: [3 um, 0.3 um, 0 um]}]
"""}
PHYSICAL = "type: shear\nshearRate: 300 1/s\n"


def record(case):
    return json.loads((case / "run.json").read_text())


def strains(case, observer):
    return [row["strain"] for row in table(case, observer)]


def multiples(interval, end):
    return [k * interval for k in range(round(end / interval) + 1)]


def test_events(folder):
    start = prepared(folder / "start", SMALL, **{
        "system/control.yaml": "application: dmpFlow\nendStrain: 0.5\nwrite: {strain: 0.25}\ncheckpoint: {wallClock: never}\n",
        "system/numerics.yaml": SMALL["system/numerics.yaml"].replace("step: 0.05", "step: 0.07"),
        "system/observers.yaml": "deformation: {type: shape, every: 0.1 strain}\nbalance: {type: conservation, every: 0.02 strain}\n"})
    steps = []
    for ranks in (1, 2, 4):
        whole = copied(start, folder / f"whole{ranks}")
        run(whole, "dmpFlow", ranks=ranks)
        assert strains(whole, "deformation") == multiples(0.1, 0.5), strains(whole, "deformation")
        assert record(whole)["result"]["strain"] == 0.5, record(whole)["result"]
        assert (whole / "results/fluid.pvd").read_text().count("timestep=") == 3
        steps.append(record(whole)["performance"]["steps"])
        assert len(strains(whole, "balance")) == steps[-1] + 1, "an interval below the step: after each step"
        if ranks == 2:
            same_in_parts(whole, start, "dmpFlow", 5, ranks=ranks, observers=("deformation", "balance"))
    assert steps == [steps[0]] * 3 and steps[0] <= 10, steps  # events at 0.1, 0.2, 0.25, 0.3 ...
    often = copied(start, folder / "often")  # a checkpoint after each step changes none
    run(often, "dmpFlow", "-set", "system/control.yaml:/checkpoint/wallClock=1 us", ranks=1)
    same_checkpoint(last_checkpoint(folder / "whole1"), last_checkpoint(often))

    explicit = prepared(folder / "explicit", CELL_CASE, **{
        "system/control.yaml": CELL_CASE["system/control.yaml"].replace("0.12", "0.05").replace("strain: 0.05", "strain: 0.025"),
        "system/observers.yaml": "deformation: {type: shape, every: 0.0125 strain}\n"})
    parts = copied(explicit, folder / "explicitParts")
    run(explicit, "dmpFlow")
    assert strains(explicit, "deformation") == multiples(0.0125, 0.05), strains(explicit, "deformation")
    run(parts, "dmpFlow", "-steps", "23")
    run(parts, "dmpFlow")
    same_checkpoint(last_checkpoint(explicit), last_checkpoint(parts))

    fluid = prepared(folder / "fluid", FLUID_CASE, **{
        "system/control.yaml": "application: sphFlow\nendTime: 0.1 s\nwrite: {time: 0.05 s}\n",
        "system/observers.yaml": "wall: {type: wallStress, every: 0.03 s}\n"})
    for integrator in ("velocityVerlet", "rkl2"):
        case = copied(fluid, folder / integrator)
        run(case, "sphFlow", "-set", f"system/numerics.yaml:/integrator={integrator}")
        if integrator == "velocityVerlet":  # steps of the other integrator are longer than the interval
            assert [row["time_s"] for row in table(case, "wall")] == multiples(0.03, 0.09)
        assert record(case)["result"]["time_s"] == 0.1, integrator


def test_strain(folder):
    """Another shear rate after a checkpoint: strain, curves, results and end continue from those of the checkpoint; a rollback does not change this."""
    case = prepared(folder / "case", SMALL, **{
        "system/control.yaml": "application: dmpFlow\nendStrain: 0.3\nwrite: {strain: 0.3}\ncheckpoint: {wallClock: never}\n",
        "constant/flow.yaml": PHYSICAL, "system/observers.yaml": "deformation: {type: shape, every: 0.1 strain}\n"})
    run(case, "dmpFlow")
    first = record(case)["result"]["time_s"]
    assert abs(first - 0.3 / 300) < 1e-12
    harmed = copied(case, folder / "harmed")
    on = ("-set", "constant/flow.yaml:/shearRate=600 1/s", "-set", "system/control.yaml:/endStrain=0.6")
    for where, application, more in ((case, "dmpFlow", ()), (harmed, "faultInjection", ("-kind", "nan", "-at", "8"))):
        run(where, application, *on, *more, ranks=2)
        rows = [[float(v) for v in row] for row in runs.series(where, "deformation")]
        assert len(rows) == 7 and all(abs(row[1] - k * 0.1) < 1e-12 for k, row in enumerate(rows)), rows  # 0.3 was an end
        assert abs(rows[-1][0] - rows[-2][0] - 0.1 / 600) < 1e-12, rows
        assert abs(record(where)["result"]["strain"] - 0.6) < 1e-15
        assert abs(record(where)["result"]["time_s"] - first - 0.3 / 600) < 1e-12
    assert record(harmed)["performance"]["rollbacks"] == 1
    # Back at the first rate, no strain is left: the end has already been reached.
    run(case, "dmpFlow", "-set", "system/control.yaml:/endStrain=0.5")
    assert abs(record(case)["result"]["strain"] - 0.6) < 1e-15


def test_creeping(folder):
    """A run without progress, or that would never end, ends with exit code 3, the decisive limit and what to change; a fault of the geometry is not
    tried again; a non-finite state is not written."""
    start = prepared(folder / "start", SMALL)
    for what, error, ranks in (("the step has fallen to", "1e-8", 1), ("tries have brought the run", "2e-6", 2)):
        case = copied(start, folder / error)
        terms = "{tolerance: 1e-3, step: 0.5, method: backwardEuler, error: " + error + "}"
        said = run(case, "dmpFlow", "-set", f"system/numerics.yaml:/implicit={terms}", ranks=ranks, code=3).stderr
        assert what in said and "the limit 'error'" in said and "'implicit.error'" in said and "checkpoint" in said, said
        assert said.count("would never end") == 1 and record(case)["fault"]["text"], said
    case = copied(start, folder / "sound")
    said = run(case, "dmpFlow", "-set", "system/numerics.yaml:/integrator=velocityVerlet", "-set", "system/numerics.yaml:/implicit={}",
               "-set", "constant/fluid.yaml:/equationOfState={type: tait, soundSpeed: 1e9 m/s}", ranks=2, code=3).stderr
    assert "the run would take" in said and "'acoustic'" in said and "soundSpeed" in said, said

    explicit = prepared(folder / "explicit")
    for kind, at in (("nan", "3"), ("nan", "4")):  # between two checks of the state
        case = copied(explicit, folder / f"{kind}{at}")
        said = run(case, "faultInjection", "-kind", kind, "-at", at, "-seed", at, "-steps", "5", "-set", "system/numerics.yaml:/rollbacks=0", code=3).stderr
        assert "no finite" in said, said
        assert not list(case.glob("checkpoints/*.h5")), kind


def test_burst(folder):
    """checkCase ends its burst of steps where the run ends, rolls back as the solver does, and finds no fault in a case that the solver runs."""
    short = prepared(folder / "short", SMALL)
    hard = copied(short, folder / "hard")
    terms = ("-set", "system/numerics.yaml:/implicit={step: 0.4, tolerance: 1e-3, error: 1, bondStrain: 0.004}", "-set", "constant/flow.yaml:/Ca=1.5")
    for case, more in ((short, ("-set", "system/control.yaml:/endStrain=0.2")), (hard, terms)):
        before = sorted(str(p) for p in case.rglob("*") if not p.name.startswith("log."))
        found = run(case, "checkCase", *more, "-json")
        assert json.loads(found.stdout)["predicted_s"] > 0
        assert before == sorted(str(p) for p in case.rglob("*") if not p.name.startswith("log.")), "nothing is written"
        run(case, "dmpFlow", *more)
        print(case.name, record(case)["performance"]["rollbacks"], found.stderr)
        assert (record(case)["performance"]["rollbacks"] > 0) == ("Back to step" in found.stderr), found.stderr


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as temporary:
        globals()["test_" + sys.argv[2]](pathlib.Path(temporary))
    print("passed")
