#!/usr/bin/env python3
"""Whole runs of small cases: restart, kill, ranks, stopping, exit codes, skipping, rupture.

    runs.py BIN TEST    BIN: directory of the applications
"""
import cmath
import csv
import json
import math
import os
import pathlib
import re
import shutil
import signal
import statistics
import subprocess
import sys
import tempfile
import time

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "validation"))
import vtp

BIN = pathlib.Path(sys.argv[1])

# Pair terms are in double precision where runs are compared up to rounding.
CELL_CASE = {
    "system/control.yaml": """application: dmpFlow
endStrain: 0.12
write: {strain: 0.05}
checkpoint: {wallClock: never, keep: 5}
""",
    "system/numerics.yaml": """spacing: 1 um
precision: double
kernel: {type: wendlandC2, support: 2.4 dx}
integrator: velocityVerlet
coupling: dualIdentity
shifting: {coefficient: 0.5, steps: 7}
""",
    "system/mesh.yaml": """domain: {size: [12 um, 11 um, 10 um], periodic: [true, true, false]}
cells: [{name: rbc, shape: {type: kuchelFackerell, d: 8 um, h: 2.12 um, b: 1 um}, edge: 0.8 um, centre: [5 um, 0 um, 0 um], axis: [0.3, 0, 1]}]
""",
    "system/observers.yaml": """deformation: {type: shape, every: 0.01 strain}
balance: {type: conservation, every: 0.01 strain}
""",
    "constant/fluid.yaml": """density: 1000 kg/m^3
viscosity: 1.0e-3 Pa s
""",
    "constant/membranes.yaml": """rbc:
  bonds: {type: harmonic, k: 5e-4 N/m}
  bending: {type: dihedral, Eb: 0.01}
  viscosity: {shear: 2e-9 N s/m}
""",
    "constant/flow.yaml": """type: shear
Ca: 0.1
inertia: {Re: 0.5}
""",
}
FLUID_CASE = {
    "system/control.yaml": "application: sphFlow\nendTime: 1 s\n",
    "system/numerics.yaml": "spacing: 62.5 um\nprecision: double\nintegrator: velocityVerlet\n",
    "system/mesh.yaml": "domain: {size: [0.5 mm, 0.5 mm, 1 mm], periodic: [true, true, false]}\n",
    "constant/fluid.yaml": "density: 1000 kg/m^3\nviscosity: 1e-3 Pa s\n",
    "constant/flow.yaml": "type: shear\nshearRate: 0.025 1/s\n",
}


BODY_CASE = {
    **{name: text for name, text in CELL_CASE.items() if name != "constant/membranes.yaml"},
    "system/mesh.yaml": """domain: {size: [12 um, 11 um, 10 um], periodic: [true, true, false]}
bodies: [{name: bead, shape: {type: spheroid, a: 3 um, c: 2 um}, edge: 0.7 um, centre: [5 um, 0 um, 0 um], axis: [0.3, 0, 1]}]
""",
    "system/observers.yaml": "motion: {type: body, every: 0.01 strain}\nbalance: {type: conservation, every: 0.01 strain}\n",
    "constant/bodies.yaml": "bead: {density: 1200 kg/m^3, motion: free}\n",
    "constant/flow.yaml": "type: shear\nshearRate: 200 1/s\ninertia: {Re: 0.5}\n",
}

# A free rigid sphere inside a capsule.
INCLUSION_CASE = {
    **CELL_CASE,
    "system/control.yaml": CELL_CASE["system/control.yaml"].replace("0.12", "0.4"),
    "system/numerics.yaml": "spacing: 0.6 um\nprecision: double\nkernel: {type: wendlandC2, support: 2.4 dx}\nintegrator: velocityVerlet\ncoupling: dualIdentity\n",
    "system/mesh.yaml": """domain: {size: [12 um, 9 um, 9.6 um], periodic: [true, true, false]}
cells: [{name: capsule, shape: {type: sphere, radius: 3 um}, edge: 0.7 um, centre: [0 um, 0 um, 0 um]}]
bodies: [{name: bead, shape: {type: sphere, radius: 1.2 um}, edge: 0.5 um, centre: [0.3 um, 0 um, 0 um]}]
""",
    "system/observers.yaml": CELL_CASE["system/observers.yaml"] + "motion: {type: body, every: 0.02 strain}\n",
    "constant/membranes.yaml": "capsule:\n  triangles: {type: skalak, Gs: 4 uN/m, C: 1}\n  bending: {type: dihedral, Eb: 0.01}\n",
    "constant/bodies.yaml": "bead: {motion: free}\n",
}

# A capsule of four particles along its radius.
IMPLICIT_CASE = {
    **CELL_CASE,
    "system/control.yaml": "application: dmpFlow\nendStrain: 0.6\nwrite: {strain: 0.3}\ncheckpoint: {wallClock: never}\n",
    "system/numerics.yaml": """spacing: 1 um
precision: double
kernel: {type: wendlandC2, support: 2.4 dx}
integrator: implicit
coupling: immersed
operators: corrected
implicit: {step: 0.05, tolerance: 1e-5, error: 1}
shifting: {coefficient: 1}
""",
    "system/mesh.yaml": """domain: {size: [16 um, 16 um, 16 um], periodic: [true, true, false]}
cells: [{name: rbc, shape: {type: spheroid, a: 4 um, c: 4 um}, edge: 1 um, centre: [5 um, 0.3 um, 0 um]}]
""",
    "constant/membranes.yaml": "rbc:\n  triangles: {type: skalak, Gs: 5e-6 N/m, C: 1}\n",
    "constant/flow.yaml": "type: shear\nCa: 0.3\ninertia: {Re: 0.1}\n",
}
THINNING = "  viscosity: {shear: 1.6e-8 N s/m, thinning: {rate: 100 1/s, index: 0.5}}\n"  # at a shear rate of 375 1/s

# The same with velocity Verlet and the same operators, for a shorter time.
ADJOINT_CASE = {
    **IMPLICIT_CASE,
    "system/control.yaml": IMPLICIT_CASE["system/control.yaml"].replace("0.6", "0.15").replace("{strain: 0.3}", "{strain: 0.1}"),
    "system/numerics.yaml": IMPLICIT_CASE["system/numerics.yaml"].replace("implicit\n", "velocityVerlet\n"),
}


def make(folder, files, **changes):
    for name, text in {**files, **changes}.items():
        path = pathlib.Path(folder) / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    return pathlib.Path(folder)


def run(case, application, *options, ranks=1, code=0, env=None):
    command = [str(BIN / application), "-case", str(case), "-quiet", *options]
    if ranks > 1:
        command = ["mpirun", "--oversubscribe", "-np", str(ranks), *command]
    done = subprocess.run(command, capture_output=True, text=True, env={**os.environ, **(env or {})})
    assert done.returncode == code, f"{' '.join(command)}: exit code {done.returncode}, expected {code}\n{done.stdout}\n{done.stderr}"
    return done


def prepared(folder, files=CELL_CASE, **changes):
    case = make(folder, files, **changes)
    if "constant/membranes.yaml" in files or "constant/bodies.yaml" in files:
        run(case, "membraneMesh")
    run(case, "particleFill")
    return case


FILE = {"balance": "conservation.csv"}  # default file of observers that write several


def lines(case, observer, name=None):
    """Lines of an observer's table, without comments."""
    (path,) = (case / "postProcessing" / observer).glob(name or FILE.get(observer, "*.csv"))
    return [line for line in path.read_text().splitlines() if not line.startswith("#")]


def series(case, observer, name=None):
    """All rows of an observer, as text from its table."""
    return list(csv.reader(lines(case, observer, name)))[1:]


def table(case, observer, name=None):
    """Rows of an observer by the names of its columns."""
    return [{key: float(value) for key, value in row.items()} for row in csv.DictReader(lines(case, observer, name))]


def last_checkpoint(case):
    return max((case / "checkpoints").glob("*.h5"))


def same_checkpoint(a, b, apart=()):
    """apart: data sets that may differ; if there are any, the checksum of all contents may differ too."""
    excluded = [word for name in apart for word in ("--exclude-path", name)]
    done = subprocess.run(["h5diff", *excluded, str(a), str(b)], capture_output=True, text=True)
    said = done.stdout.strip()
    if apart and said == "attribute: <contents of </>> and <contents of </>>\n1 differences found":
        return
    assert done.returncode == 0, f"{a} and {b} differ:\n{said[:2000]}{done.stderr[:500]}"


def copied(start, case):
    shutil.copytree(start, case)
    return case


def same_in_parts(whole, start, application, steps, *options, ranks=1, observers=()):
    """A run in two parts, the first of `steps` steps, ends with the bits of the run `whole`; the observers' rows are those of one run."""
    parts = copied(start, whole.with_name("parts" + whole.name))
    run(parts, application, "-steps", str(steps), *options, ranks=ranks)
    run(parts, application, *options, ranks=ranks)
    same_checkpoint(last_checkpoint(whole), last_checkpoint(parts))
    for observer in observers:
        assert series(whole, observer) == series(parts, observer), observer
        if observer == "balance":
            assert series(whole, observer, "budget.csv") == series(parts, observer, "budget.csv"), "budget"
    return parts


def test_restart(folder):
    """A run in two parts ends with the bits of a run in one, on 1 and 2 ranks, in either precision; the observers' rows are those of one run."""
    start = prepared(folder / "start")
    for ranks, precision in ((1, "double"), (2, "double"), (2, "mixed")):
        whole = copied(start, folder / f"whole{ranks}{precision}")
        terms = ("-set", f"system/numerics.yaml:/precision={precision}")
        run(whole, "dmpFlow", *terms, ranks=ranks)
        same_in_parts(whole, start, "dmpFlow", 37, *terms, ranks=ranks, observers=("deformation", "balance"))
        assert all(len(series(whole, observer)) >= 12 for observer in ("deformation", "balance"))
    # On another number of ranks: the same to rounding.
    other = copied(start, folder / "other")
    run(other, "dmpFlow", "-steps", "37", ranks=1)
    run(other, "dmpFlow", ranks=2)
    close(series(folder / "whole1double", "balance"), series(other, "balance"), 1e-7)


def fluid(case):
    """The last results of the fluid, of all ranks, by id."""
    found = {}
    for piece in sorted((case / "results/fluid").glob("fluid_*/"))[-1].glob("*.vtp"):
        arrays = vtp.File(piece).arrays
        found |= {number: {name: values[k] for name, values in arrays.items()} for k, number in enumerate(arrays["id"])}
    return found


def test_implicit(folder):
    """The implicit step: the same on 1, 2 and 4 ranks to ten times its tolerance, restarts to the same bits in either precision, volume
    kept, the cell deforms; a checkpoint of the other integrator is refused."""
    start = prepared(folder / "start", IMPLICIT_CASE)
    cases = {}
    for ranks in (1, 2, 4):
        case = cases[ranks] = copied(start, folder / f"np{ranks}")
        run(case, "dmpFlow", ranks=ranks)
        record = json.loads((case / "run.json").read_text())
        assert record["performance"]["steps"] == 12 and 1 <= record["performance"]["iterationsPerStep"] < 100, record["performance"]
        for observer, tolerance in (("deformation", 1e-4), ("balance", 1e-4)):
            close(series(cases[1], observer), series(case, observer), tolerance)
    last = table(cases[1], "deformation")[-1]
    assert 0.1 < last["D12_inertia"] < 0.35, last
    rows = table(cases[1], "balance")
    for row in rows:
        assert abs(row["volumeChange"]) < 1e-8 and row["changedSide"] == 0, row
        assert abs(row["density_mean"] - rows[0]["density_mean"]) < 1e-3, row
    # Smoothed pressure for pictures: less noise inside and outside, the same on any number of ranks, and no effect on the state.
    means = {}
    for ranks in (1, 2):
        case = copied(start, folder / f"pictures{ranks}")
        run(case, "dmpFlow", "-set", "system/control.yaml:/write={strain: 0.3, fields: [pressure, meanPressure]}", ranks=ranks)
        found = fluid(case)
        for side in (0, 1):
            noise, mean = (statistics.stdev(row[name] for row in found.values() if row["side"] == side) for name in ("pressure", "meanPressure"))
            assert 0 < mean < 0.9 * noise, (side, mean, noise)
        means[ranks] = {number: row["meanPressure"] for number, row in found.items()}
        same_checkpoint(last_checkpoint(cases[ranks]), last_checkpoint(case))
    spread = statistics.stdev(means[1].values())
    assert means[1].keys() == means[2].keys() and max(abs(means[2][k] - p) for k, p in means[1].items()) < 0.02 * spread, spread
    # The preconditioner changes the number of iterations, not the result; fluid alone goes through its density balance too.
    iterations = {}
    for preconditioner in ("blockJacobi", "twoLevel", "withMembrane"):
        case = copied(start, folder / preconditioner)
        run(case, "dmpFlow", "-set", f"system/numerics.yaml:/implicit/preconditioner={preconditioner}", ranks=2)
        close(series(cases[1], "deformation"), series(case, "deformation"), 1e-4)
        iterations[preconditioner] = json.loads((case / "run.json").read_text())["performance"]["iterationsPerStep"]
    assert iterations["withMembrane"] <= iterations["twoLevel"] + 1 < 0.7 * iterations["blockJacobi"], iterations
    # By default it includes the membrane where that is stiff, up to the stiffest one here: no step is taken back.
    for Ca, onNodes in ((0.3, False), (0.01, True), (1e-4, True), (1e-5, True)):
        case = copied(start, folder / f"automatic{Ca}")
        run(case, "dmpFlow", "-steps", "4", "-set", f"constant/flow.yaml:/Ca={Ca}")
        done = json.loads((case / "run.json").read_text())["performance"]
        assert (done["innerIterationsPerStep"] > 0) == onNodes and done["halvings"] == 0, (Ca, done)
    case = prepared(folder / "alone", FLUID_CASE)
    run(case, "sphFlow", "-steps", "12", "-set", "system/numerics.yaml:/integrator=implicit")
    # Membrane viscosity slows the deformation, less so with thinning; bonds break at the same step on any number of ranks, and the run goes on.
    sheet = "rbc:\n  bonds: {type: harmonic, k: 5e-5 N/m}\n  bending: {type: dihedral, Eb: 0.01}\n"
    D = []
    for name, law in (("viscous", THINNING.replace(", thinning: {rate: 100 1/s, index: 0.5}", "")), ("thinning", THINNING), ("elastic", "")):
        case = prepared(folder / name, {**IMPLICIT_CASE, "constant/membranes.yaml": sheet + law})
        run(case, "dmpFlow", ranks=2)
        D.append(float(series(case, "deformation")[-1][3]))
    print("viscous, thinning, elastic", D)
    assert 0.05 < D[0] < 0.98 * D[1] < 0.98**2 * D[2], D
    whole = prepared(folder / "tearing", {**IMPLICIT_CASE, "constant/membranes.yaml": sheet + "  rupture: {type: bondStretch, limit: 1.1}\n"})
    losses = []
    for ranks in (1, 2):
        case = copied(whole, folder / f"tearing{ranks}")
        run(case, "dmpFlow", ranks=ranks)
        losses.append(json.loads((case / "run.json").read_text())["result"]["brokenBonds"])
    assert losses[0] == losses[1] > 0, losses
    # Second order in the step. Particles start on a lattice, since shifting evens out jittered ones at a rate that depends on the step. Steps are
    # so long that their error dominates: the random positions of particles change D12 by 2e-5.
    lattice = IMPLICIT_CASE["system/mesh.yaml"] + "fill: {jitter: 0}\n"
    start = prepared(folder / "lattice", {**IMPLICIT_CASE, "system/mesh.yaml": lattice})
    D = []
    for step in (0.15, 0.075, 0.0375):
        case = copied(start, folder / f"step{step}")
        run(case, "dmpFlow", "-set", f"system/numerics.yaml:/implicit/step={step}", "-set", "system/observers.yaml:/deformation/every=0.6 strain")
        D.append(float(series(case, "deformation")[-1][3]))
    assert 3 < (D[0] - D[1]) / (D[1] - D[2]) < 5, D
    for ranks, precision in ((1, "double"), (2, "mixed")):
        terms = ("-set", f"system/numerics.yaml:/precision={precision}")
        whole = copied(start, folder / f"whole{precision}")
        run(whole, "dmpFlow", *terms, ranks=ranks)
        same_in_parts(whole, start, "dmpFlow", 5, *terms, ranks=ranks)
    # Fluid alone starts from either integrator's files, but not from its checkpoints.
    for first, second in (("velocityVerlet", "implicit"), ("implicit", "velocityVerlet")):
        case = prepared(folder / first, FLUID_CASE)
        run(case, "sphFlow", "-steps", "3", "-set", f"system/numerics.yaml:/integrator={first}")
        said = run(case, "sphFlow", "-steps", "3", "-set", f"system/numerics.yaml:/integrator={second}", code=2).stderr
        assert f"integrator: the case now has {second}, but " in said and f"was written with {first}; start from firstTime" in said, said


def test_budget(folder):
    """The budget of energy and momentum closes with every scheme: its residual is small and the sum of its parts, it is the same on 1 and 2 ranks and
    after a restart on another number of them, and what the log and run.json say is its last row. (Restarts to the same bits: restart, implicit, adjoint.)"""
    sheet = "rbc:\n  bonds: {type: harmonic, k: 5e-5 N/m}\n  viscosity: {shear: 1e-9 N s/m}\n"
    short = IMPLICIT_CASE["system/control.yaml"].replace("0.6", "0.12").replace("{strain: 0.3}", "{strain: 0.12}")
    implicit = "spacing: 1 um\nprecision: double\nkernel: {type: wendlandC2, support: 2.4 dx}\nintegrator: implicit\nimplicit: {step: 0.01, tolerance: 1e-5}\n"
    every = "balance: {type: conservation, every: 0.06 strain}\n"
    explicit = {**ADJOINT_CASE, "system/control.yaml": short, "system/observers.yaml": every}
    body = {**BODY_CASE, "system/control.yaml": short, "system/observers.yaml": every}
    driven = BODY_CASE["constant/bodies.yaml"].replace("free", "{type: driven, velocity: [0 m/s, 0 m/s, 0 m/s], angularVelocity: [0 1/s, 300 1/s, 0 1/s]}")
    rows = {}
    for name, files, allowed, agree in (
            ("implicit", {**IMPLICIT_CASE, "system/observers.yaml": every}, 1e-3, 1e-3),
            ("adjoint", {**explicit, "constant/membranes.yaml": sheet}, 1e-4, 1e-6),
            ("tearing", {**explicit, "constant/membranes.yaml": sheet.split("  viscosity")[0] + "  rupture: {type: bondStretch, limit: 1.02}\n"}, 1e-4, 1e-6),
            ("dualIdentity", {**CELL_CASE, "system/observers.yaml": every}, 1e-3, 1e-6),
            ("drivenBody", {**body, "constant/bodies.yaml": driven}, 0.01, 1e-6),
            ("implicitBody", {**body, "system/numerics.yaml": implicit}, 1e-3, 1e-3)):
        start = prepared(folder / name, files)
        for ranks in (1, 2):
            case = copied(start, folder / f"{name}{ranks}")
            run(case, "dmpFlow", ranks=ranks)
        last = rows[name] = table(folder / f"{name}1", "balance", "budget.csv")[-1]
        print(name, {key: value for key, value in last.items() if key.endswith("_J") or key == "residualShare"})
        given = sum(last.get(key, 0) for key in ("workOfWalls_J", "workOfBodyForce_J", "workOfBodies_J"))
        taken = sum(last.get(key, 0) for key in ("dissipated_J", "stored_J", "released_J", "compressed_J", "kineticEnergy_J"))
        parts = sum(last.get(key, 0) for key in ("residualOfInertia_J", "residualOfMembranes_J", "residualOfCompression_J", "residualOfSolver_J"))
        assert given > 0 and last["dissipated_J"] > 0.3 * given, last
        assert abs(given - taken - last["residual_J"]) < 1e-12 * given and abs(parts - last["residual_J"]) < 1e-9 * given, last
        assert last["residualShare"] < allowed and abs(last["massChange"]) < 1e-13 and abs(last["volumeChange"]) < 2e-3, last
        drift = math.hypot(*(last[f"momentumDrift_{k}_Ns"] for k in "xyz"))
        exchanged = sum(math.hypot(*(last[f"impulseOfWall_{wall}_{k}_Ns"] for k in "xyz")) for wall in ("lower", "upper"))
        assert drift < (2e-3 if "mplicit" in name else 1e-3) * exchanged, (name, drift / exchanged)
        other = table(folder / f"{name}2", "balance", "budget.csv")[-1]
        for key in ("workOfWalls_J", "dissipated_J", "stored_J", "residual_J", "kineticEnergy_J"):
            if key in last:
                assert abs(last[key] - other[key]) <= agree * given, (name, key, last[key], other[key])
        record = json.loads((folder / f"{name}1" / "run.json").read_text())["observers"]["balance"]
        assert record["residualShare"] == last["residualShare"] and record["workOfWalls_J"] == last["workOfWalls_J"], record
        assert record["momentumDriftShare"] < 2e-3, record
        assert "energy budget: walls put in" in (folder / f"{name}1" / "log.dmpFlow").read_text()
    assert rows["tearing"]["released_J"] > 0 and "released_J" not in rows["implicit"], rows["tearing"]
    assert rows["adjoint"]["dissipatedInMembranes_J"] > 1e-4 * rows["adjoint"]["dissipated_J"], rows["adjoint"]
    assert rows["drivenBody"]["workOfBodies_J"] > 0, rows["drivenBody"]
    # In two parts on another number of ranks.
    whole = table(folder / "adjoint1", "balance", "budget.csv")[-1]
    case = copied(folder / "adjoint", folder / "parts")
    run(case, "dmpFlow", "-steps", "30", ranks=2)
    run(case, "dmpFlow", ranks=1)
    ends = [float(value) for value in series(case, "balance", "budget.csv")[-1]]
    for key, value in zip(["time_s", "strain"] + list(whole)[2:], ends):
        if key in ("workOfWalls_J", "dissipated_J", "stored_J", "residual_J"):
            assert abs(value - whole[key]) < 1e-6 * whole["workOfWalls_J"], (key, value, whole[key])
    # RKL2: a fluid alone.
    case = prepared(folder / "rkl2", {**FLUID_CASE, "system/observers.yaml": "balance: {type: conservation, every: 0.1 s}\n"})
    run(case, "sphFlow", "-set", "system/numerics.yaml:/integrator=rkl2")
    last = table(case, "balance", "budget.csv")[-1]
    print("rkl2", last)
    assert last["residualShare"] < 1e-4 and "stored_J" not in last and last["dissipated_J"] > 0, last


def test_stepControl(folder):
    """The implicit step becomes shorter where the positions of nodes or a bond require it, is taken back where a bond would change too much, and
    is refined where membranes are far from linear: results come closer to those of short steps. Restarts give the same bits."""
    start = prepared(folder / "start", IMPLICIT_CASE)
    def at(rows, strain):
        after = next(k for k, row in enumerate(rows) if row["strain"] > strain - 1e-9)
        a, b = rows[after - 1], rows[after]
        return a["D12_inertia"] + (strain - a["strain"]) / (b["strain"] - a["strain"]) * (b["D12_inertia"] - a["D12_inertia"])
    D, performance = {}, {}
    for name, terms in {"fine": "step: 0.0125, error: 1", "coarse": "step: 0.1, error: 1", "error": "step: 0.1, error: 2e-5",
                        "bonds": "step: 0.1, error: 1, bondStrain: 0.02", "long": "step: 0.3, error: 1, bondStrain: 1"}.items():
        case = copied(start, folder / name)
        settings = ("-set", "system/numerics.yaml:/implicit={tolerance: 1e-5, " + terms + "}",
                    "-set", "system/observers.yaml:/deformation/every=1 steps")
        run(case, "dmpFlow", *settings, ranks=2)
        performance[name] = json.loads((case / "run.json").read_text())["performance"]
        D[name] = at(table(case, "deformation"), 0.6)
        print(name, D[name], performance[name])
        if name in ("error", "bonds"):
            same_in_parts(case, start, "dmpFlow", 4, *settings, ranks=2, observers=("deformation",))
    assert performance["coarse"]["steps"] == 6 and performance["error"]["steps"] >= 12, performance
    assert performance["bonds"]["halvings"] > 0 == performance["coarse"]["halvings"], performance
    assert performance["long"]["refinements"] > 0 == performance["fine"]["refinements"], performance
    assert abs(D["error"] - D["fine"]) < 0.2 * abs(D["coarse"] - D["fine"]), D
    assert abs(D["bonds"] - D["fine"]) < 0.02 * D["fine"] and abs(D["long"] - D["fine"]) < 0.03 * D["fine"], D


def test_adjoint(folder):
    """The explicit step on corrected operators with an immersed membrane: the same on 1, 2 and 4 ranks, restarts to the same bits in either
    precision, volume kept, no particle through the membrane, bonds break alike; checkpoints of the other coupling are refused."""
    start = prepared(folder / "start", ADJOINT_CASE)
    cases = {}
    for ranks in (1, 2, 4):
        case = cases[ranks] = copied(start, folder / f"np{ranks}")
        run(case, "dmpFlow", ranks=ranks)
        for observer, names in (("deformation", ("D12_extent", "D12_inertia", "inclination_rad", "angleTurned_rad", "length_m")),
                                ("balance", ("density_mean", "density_min", "density_max", "kineticEnergy_J", "momentum_x_Ns",
                                             "membraneEnergy_J"))):
            close(*([[row[name] for name in names] for row in table(c, observer)] for c in (cases[1], case)), 1e-7)
        close(*([[row[name] for name in ("area_m2", "volume_m3")] for row in table(c, "balance", "rbc.csv")] for c in (cases[1], case)), 1e-7)
    first, *_, last = table(cases[1], "balance")
    assert last["changedSide"] == last["guardMoves"] == 0 and abs(last["volumeChange"]) < 1e-12, last
    assert abs(last["density_mean"] / first["density_mean"] - 1) < 1e-4, last
    for ranks, precision in ((1, "double"), (2, "mixed")):
        terms = ("-set", f"system/numerics.yaml:/precision={precision}")
        whole = copied(start, folder / f"whole{precision}")
        run(whole, "dmpFlow", *terms, ranks=ranks)
        same_in_parts(whole, start, "dmpFlow", 57, *terms, ranks=ranks, observers=("deformation", "balance"))
    said = run(cases[1], "dmpFlow", "-set", "system/numerics.yaml:/coupling=dualIdentity", "-set", "system/numerics.yaml:/operators=plain",
               "-set", "system/control.yaml:/endStrain=1", code=2).stderr
    assert "coupling: the case now has dualIdentity, but " in said and "was written with immersed; start from firstTime" in said, said
    # Membrane viscosity slows the deformation and is included in the step limit; bonds break at the same step on any number of ranks.
    sheet = "rbc:\n  bonds: {type: harmonic, k: 5e-5 N/m}\n  bending: {type: dihedral, Eb: 0.01}\n"
    slow = prepared(folder / "viscous", ADJOINT_CASE, **{"constant/membranes.yaml": sheet + "  viscosity: {shear: 1e-8 N s/m}\n"})
    swift = prepared(folder / "elastic", ADJOINT_CASE, **{"constant/membranes.yaml": sheet})
    for case in (slow, swift):
        run(case, "dmpFlow", ranks=2)
    assert 0.02 < table(slow, "deformation")[-1]["D12_inertia"] < 0.98 * table(swift, "deformation")[-1]["D12_inertia"]
    assert json.loads((slow / "run.json").read_text())["extremes"]["largestStep_s"] < json.loads((swift / "run.json").read_text())["extremes"]["smallestStep_s"]
    tearing = prepared(folder / "tearing", ADJOINT_CASE, **{"constant/membranes.yaml": sheet + "  rupture: {type: bondStretch, limit: 1.03}\n"})
    losses = []
    for ranks in (1, 2):
        case = copied(tearing, folder / f"tearing{ranks}")
        run(case, "dmpFlow", ranks=ranks)
        losses.append(json.loads((case / "run.json").read_text())["result"]["brokenBonds"])
    assert losses[0] == losses[1] > 0, losses
    parts = copied(tearing, folder / "tearingParts")
    run(parts, "dmpFlow", "-set", "system/control.yaml:/stop/firstBreak=true", code=5)
    run(parts, "dmpFlow")
    same_checkpoint(last_checkpoint(folder / "tearing1"), last_checkpoint(parts))
    # Plain operators, and a more viscous inside, which slows the deformation.
    thick = prepared(folder / "thick", ADJOINT_CASE, **{
        "system/numerics.yaml": ADJOINT_CASE["system/numerics.yaml"].replace("corrected", "plain"),
        "constant/membranes.yaml": ADJOINT_CASE["constant/membranes.yaml"] + "  interior: {viscosityRatio: 5}\n"})
    run(thick, "dmpFlow", ranks=2)
    last = table(thick, "balance")[-1]
    assert last["changedSide"] == 0 and abs(last["volumeChange"]) < 1e-12, last
    assert 0.02 < table(thick, "deformation")[-1]["D12_inertia"] < 0.95 * table(cases[1], "deformation")[-1]["D12_inertia"]
    record = json.loads((thick / "run.json").read_text())
    assert record["extremes"]["mostNodesWithoutLinearWeights"] == 0, record["extremes"]
    # Particles keep the viscosity with which they were made.
    said = run(thick, "dmpFlow", "-set", "constant/membranes.yaml:/rbc/interior/viscosityRatio=10", "-set", "system/control.yaml:/endStrain=9", code=2).stderr
    assert "interior.viscosityRatio: the case now has 10" in said and "start from firstTime" in said, said
    # Fluid alone, on either form of operators.
    case = prepared(folder / "alone", FLUID_CASE)
    run(case, "sphFlow", "-steps", "12", "-set", "system/numerics.yaml:/operators=corrected", "-set", "system/numerics.yaml:/shifting={coefficient: 1}")
    said = run(case, "sphFlow", "-steps", "3", code=2).stderr
    assert "operators: the case now has plain, but " in said and "was written with corrected" in said, said


def integrators_agree(folder, name, files, step, since):
    """The implicit step and velocity Verlet solve the same discrete equations: D12, inclination and area to 0.5 % to strain 1, at steps where both have
    converged."""
    observers = "deformation: {type: shape, every: 0.2 strain}\nbalance: {type: conservation, every: 0.2 strain}\n"
    files = {**files, "system/observers.yaml": observers, "system/control.yaml": files["system/control.yaml"].replace("0.6", "1")}
    start = prepared(folder / name, files)
    found = []
    for change in (f"/implicit={{step: {step}, tolerance: 1e-5, error: 1}}", "/integrator=velocityVerlet"):
        case = copied(start, folder / f"{name}{len(found)}")
        run(case, "dmpFlow", "-set", "system/numerics.yaml:" + change)
        found.append([{**shape, **balance} for shape, balance in zip(table(case, "deformation"), table(case, "balance"))])
    for a, b in zip(*found):
        late = b["strain"] - a["strain"]  # rows fall on the first step past their time
        print(name, *(f"{row[key]:.5f}" for key in ("strain", "D12_inertia", "inclination_rad", "areaChange") for row in (a, b)))
        assert abs(late) < 2e-3
        assert abs(b["D12_inertia"] / a["D12_inertia"] - 1) < 0.005 or a["strain"] < since
        assert abs(b["inclination_rad"] - a["inclination_rad"]) < 0.005 * math.pi / 4 and abs(b["areaChange"] - a["areaChange"]) < 5e-4
    assert len(found[0]) == 6 and found[0][-1]["changedSide"] == found[1][-1]["changedSide"] == 0


def test_integrators(folder):
    """A capsule by both. A red cell, and one that tears: long.integratorsOfCells."""
    integrators_agree(folder, "capsule", IMPLICIT_CASE, 0.025, 0.1)


def test_integratorsOfCells(folder):
    """A red cell and a capsule of a thinning fluid by the implicit step and velocity Verlet; a red cell that tears. The implicit step uses a thinning viscosity one
    step late: an error of first order, and a delay at the start."""
    red = {**IMPLICIT_CASE,
           "system/mesh.yaml": "domain: {size: [20 um, 16 um, 16 um], periodic: [true, true, false]}\n" + CELL_CASE["system/mesh.yaml"].splitlines()[1]
           .replace("[5 um, 0 um, 0 um], axis: [0.3, 0, 1]", "[0 um, 0 um, 0 um]") + "\n",
           "constant/membranes.yaml": "rbc:\n  bonds: {type: harmonic, k: 5e-4 N/m}\n  bending: {type: dihedral, Eb: 0.01}\n",
           "constant/flow.yaml": "type: shear\nCa: 0.02\ninertia: {Re: 0.1}\n"}
    viscous = {**IMPLICIT_CASE, "constant/membranes.yaml": IMPLICIT_CASE["constant/membranes.yaml"] + THINNING}
    integrators_agree(folder, "redCell", red, 0.025, 0.1)
    integrators_agree(folder, "thinning", viscous, 0.0125, 0.3)
    # A cell that tears: the same bond breaks first, at the same strain whatever the step, and as many bonds break and as much fluid is lost.
    start = prepared(folder / "torn", {
        **red, "system/observers.yaml": "tear: {type: rupture, every: 0.05 strain}\nbalance: {type: conservation, every: 0.25 strain}\n",
        "system/control.yaml": red["system/control.yaml"].replace("0.6", "0.25"),
        "constant/membranes.yaml": red["constant/membranes.yaml"] + "  rupture: {type: bondStretch, limit: 1.05}\n",
        "constant/flow.yaml": "type: shear\nCa: 2\ninertia: {Re: 0.1}\n"})
    ends = []
    for change in ("/integrator=velocityVerlet", *(f"/implicit={{step: {step}, tolerance: 1e-4, error: 1}}" for step in (0.1, 0.05, 0.025, 0.0125))):
        case = copied(start, folder / f"torn{len(ends)}")
        run(case, "dmpFlow", "-set", "system/numerics.yaml:" + change)
        ends.append(table(case, "tear", "rbc.csv")[-1])
        print("torn", *(f"{ends[-1][key]:.6g}" for key in ("bondsBroken", "holeRestArea_m2", "releasedVolume_m3", "firstBreak_strain")))
        assert table(case, "balance", "budget.csv")[-1]["residualShare"] < 1e-3
    exact = ends[0]
    for end in ends[1:]:
        assert end["firstBreak_bond"] == exact["firstBreak_bond"] and abs(end["firstBreak_strain"] / exact["firstBreak_strain"] - 1) < 0.005, ends
        for key in ("bondsBroken", "holeRestArea_m2", "releasedVolume_m3"):
            assert exact[key] > 0 and abs(end[key] / exact[key] - 1) < 0.02, (key, ends)
    same_in_parts(case, start, "dmpFlow", 12, "-set", "system/numerics.yaml:" + change)  # the parts meet after the first breaks


# Transient flows of fluid alone: 32 particles across a gap of 1 mm, 16 along a wavelength of 1 mm.
PLATES = {
    "system/control.yaml": "application: sphFlow\nendTime: 0.1 s\ncheckpoint: {wallClock: never}\n",
    "system/numerics.yaml": "spacing: 31.25 um\nprecision: double\nkernel: {type: wendlandC2, support: 3.0 dx}\nintegrator: velocityVerlet\nshifting: {coefficient: 1, steps: 10}\n",
    "system/mesh.yaml": "domain: {size: [0.25 mm, 0.25 mm, 1 mm], periodic: [true, true, false]}\n",
    "system/observers.yaml": "profile: {type: profile, every: 0.02 s, axis: z, bins: 32}\nwall: {type: wallStress, every: 0.02 s}\n"
                             "balance: {type: conservation, every: 0.02 s}\n",
    "constant/fluid.yaml": "density: 1000 kg/m^3\nviscosity: 1e-3 Pa s\n",
}
COUETTE = {**PLATES, "constant/flow.yaml": "type: shear\nshearRate: 0.0125 1/s\nstart: rest\n"}
POISEUILLE = {**PLATES, "constant/flow.yaml": "type: poiseuille\nbodyForce: 1e-4 m/s^2\n"}
VORTICES = {
    **PLATES,
    "system/control.yaml": "application: sphFlow\nendTime: 0.02 s\ncheckpoint: {wallClock: never}\n",
    "system/numerics.yaml": PLATES["system/numerics.yaml"].replace("31.25", "62.5"),
    "system/mesh.yaml": "domain: {size: [1 mm, 0.5 mm, 1 mm], periodic: [true, true, true]}\n",
    "system/observers.yaml": "balance: {type: conservation, every: 0.002 s}\n",
    "constant/flow.yaml": "type: taylorGreen\nspeed: 1 mm/s\n",
}


def couette(z, t):  # velocity over the relative speed of the walls; z over the gap
    n = range(1, 60)
    return z + math.fsum((-1) ** k / (k * math.pi) * math.sin(2 * k * math.pi * z) * math.exp(-((2 * k * math.pi) ** 2) * t) for k in n)


def poiseuille(z, t):  # velocity over F L^2/nu
    y, n = z + 0.5, range(1, 60, 2)
    return 0.5 * y * (1 - y) - math.fsum(4 / (k * math.pi) ** 3 * math.sin(k * math.pi * y) * math.exp(-((k * math.pi) ** 2) * t) for k in n)


def largest(errors):
    errors = list(errors)
    assert errors and all(map(math.isfinite, errors)), errors
    return max(errors)


def profile_error(case, exact, scale):
    """Largest, over the times, of the mean square error of u over that of the exact one; L = 1 mm, nu = 1e-6 m^2/s."""
    errors = []
    rows = table(case, "profile")
    for t in sorted({row["time_s"] for row in rows} - {0.0}):
        pairs = [(row["u_m_s"], scale * exact(row["position_m"] / 1e-3, t)) for row in rows if row["time_s"] == t]
        errors.append(math.sqrt(sum((u - e) ** 2 for u, e in pairs) / sum(e * e for _, e in pairs)))
    assert len(errors) == 5, errors
    return largest(errors)


def decay_error(case):
    rows, rate = table(case, "balance"), 4e-6 * (2 * math.pi / 1e-3) ** 2
    energy = [row["kineticEnergy_J"] for row in rows]
    return largest(abs(e / energy[0] - math.exp(-rate * row["time_s"])) for e, row in zip(energy, rows))


def oscillating_mean(t, mean, amplitude, omega, phase):
    """Mean velocity over F L^2/nu between planes at rest, from rest, under the force F (mean + amplitude sin(omega t + phase)); t in L^2/nu."""
    total = 0
    for k in range(1, 80, 2):
        rate = (k * math.pi) ** 2
        steady = mean * (1 - math.exp(-rate * t)) / rate
        swing = (rate * math.sin(omega * t + phase) - omega * math.cos(omega * t + phase)
                 - math.exp(-rate * t) * (rate * math.sin(phase) - omega * math.cos(phase))) / (rate**2 + omega**2)
        total += 8 / (k * math.pi) ** 2 * (steady + amplitude * swing)
    return total


def oscillating_couette(z, t, omega):
    """Velocity over the speed of the walls, which move as sin(omega t), developed; z over the gap, from the middle; t in L^2/nu."""
    kappa = cmath.sqrt(1j * omega)
    return (cmath.sinh(kappa * z) / cmath.sinh(0.5 * kappa) * cmath.exp(1j * omega * t)).imag


def test_drive(folder):
    """Drives that change in time: a body force and walls that oscillate, by each scheme, against exact solutions; a table of a sine gives what the sine
    gives; 1, 2 and 4 ranks agree, restarts continue bit for bit, also with cells; a given flow rate is held."""
    sine, omega = {"mean": 0.5, "amplitude": 1, "phase": math.pi / 6}, 2 * math.pi * 10  # 1/s; L^2/nu is 1 s
    pushed = {**PLATES, "system/control.yaml": "application: sphFlow\nendTime: 0.2 s\ncheckpoint: {wallClock: never}\n",
              "system/observers.yaml": "flow: {type: flowRate, every: 10 ms}\nbalance: {type: conservation, every: 10 ms}\n",
              "constant/flow.yaml": "type: poiseuille\nbodyForce: 1e-4 m/s^2\ndrive: {type: sine, frequency: 10 Hz, mean: 0.5, phase: 0.083333333333}\n"}
    shorn = {**pushed, "system/observers.yaml": "profile: {type: profile, every: 25 ms, axis: z, bins: 32}\nbalance: {type: conservation, every: 10 ms}\n",
             "system/control.yaml": pushed["system/control.yaml"].replace("0.2", "0.25"),
             "constant/flow.yaml": "type: shear\nshearRate: 0.025 1/s\ndrive: {type: sine, frequency: 10 Hz}\n"}
    schemes = {"verlet": ("velocityVerlet", ""), "adjoint": ("velocityVerlet", "operators: corrected\n"), "rkl2": ("rkl2", ""), "implicit": ("implicit", "")}
    for name, (scheme, more) in schemes.items():
        numerics = PLATES["system/numerics.yaml"].replace("velocityVerlet", scheme).replace("31.25", "62.5") + more
        if scheme == "implicit":
            numerics = numerics.replace(", steps: 10", "")
        if name == "adjoint":
            numerics = numerics.replace(", steps: 10", "")
        case = prepared(folder / f"pushed-{name}", {**pushed, "system/numerics.yaml": numerics})
        run(case, "sphFlow")
        rows = table(case, "flow")
        scale = 1e-4 * 1e-6 / 1e-6
        pairs = [(row["meanVelocity_m_s"], scale * oscillating_mean(row["time_s"], omega=omega, **sine)) for row in rows[1:]]
        error = math.sqrt(sum((u - e) ** 2 for u, e in pairs) / sum(e * e for _, e in pairs))
        drops = [abs(row["pressureDrop_Pa"] / (1000 * 1e-4 * 0.25e-3) - (0.5 + math.sin(omega * row["time_s"] + math.pi / 6))) for row in rows]
        budget = table(case, "balance", "budget.csv")[-1]["residualShare"]
        moved = prepared(folder / f"shorn-{name}", {**shorn, "system/numerics.yaml": numerics.replace("62.5", "31.25")})  # 5.6 dx in a Stokes layer
        run(moved, "sphFlow")
        profile = [row for row in table(moved, "profile") if row["time_s"] > 0.16]
        differences = [row["u_m_s"] / 12.5e-6 - oscillating_couette(row["position_m"] / 1e-3, row["time_s"], omega) for row in profile]
        print(name, len(pairs), f"force {error:.4f}", f"drop {max(drops):.2g}", f"budget {budget:.2g}", f"walls {max(map(abs, differences)):.4f}")
        assert len(pairs) == 20 and error < 0.02 and max(drops) < 1e-4 and budget < 2e-3
        assert len(differences) == 4 * 32 and max(map(abs, differences)) < 0.015
    same_in_parts(case, prepared(folder / "again", {**pushed, "system/numerics.yaml": numerics}), "sphFlow", 17, observers=("flow",))

    # A sine by its table; the same on several ranks.
    rows = "".join(f"{k / 4000:.10g},{0.5 + math.sin(omega * k / 4000 + math.pi / 6):.12g}\n" for k in range(401))
    by_table = prepared(folder / "table", {**pushed, "system/numerics.yaml": numerics, "constant/drive.csv": "time_s,factor\n" + rows,
                                           "constant/flow.yaml": "type: poiseuille\nbodyForce: 1e-4 m/s^2\ndrive: {type: table, file: constant/drive.csv, repeat: true}\n"})
    runs = {"whole": case, "table": by_table}
    for ranks in (2, 4):
        runs[f"np{ranks}"] = prepared(folder / f"np{ranks}", {**pushed, "system/numerics.yaml": numerics})
    for name, other in runs.items():
        if name != "whole":
            run(other, "sphFlow", ranks=int(name[2:]) if name.startswith("np") else 1)
        for one, two in zip(table(case, "flow"), table(other, "flow")):
            assert abs(one["flowRate_m3_s"] - two["flowRate_m3_s"]) < (2e-3 if name == "table" else 1e-5) * 2e-12, (name, one, two)

    # A capsule between walls that oscillate: by the implicit step and by velocity Verlet on the same operators.
    files = {**IMPLICIT_CASE, "system/control.yaml": IMPLICIT_CASE["system/control.yaml"].replace("0.6", "0.5"),
             "system/numerics.yaml": IMPLICIT_CASE["system/numerics.yaml"].replace("step: 0.05, ", ""),  # 100 in a period
             "system/observers.yaml": "deformation: {type: shape, every: 0.05 strain}\nbalance: {type: conservation, every: 0.1 strain}\n",
             "constant/flow.yaml": "type: shear\nCa: 0.3\ninertia: {Re: 0.1}\ndrive: {type: sine, frequency: 1 kHz, phase: 0.25}\n"}
    start = prepared(folder / "capsule", files)
    shapes = {}
    for name, change, ranks in (("implicit", "implicit", 1), ("implicit2", "implicit", 2), ("verlet", "velocityVerlet", 1)):
        done = copied(start, folder / f"capsule-{name}")
        run(done, "dmpFlow", "-set", f"system/numerics.yaml:/integrator={change}", ranks=ranks)
        shapes[name] = [row["D12_inertia"] for row in table(done, "deformation")]
        print("capsule", name, *(f"{d:.5f}" for d in shapes[name]))
    most = max(shapes["implicit"])
    assert most > 0.02 and len(shapes["implicit"]) == 11 and shapes["implicit"][-1] < 0.9 * most, "the capsule goes back when the walls do"
    assert max(abs(a - b) for a, b in zip(shapes["implicit"], shapes["implicit2"])) < 1e-4
    assert max(abs(a - b) for a, b in zip(shapes["implicit"], shapes["verlet"])) < 0.03 * most
    same_in_parts(folder / "capsule-implicit", start, "dmpFlow", 9, observers=("deformation",))

    # A given flow rate: with a capsule in a tube, and of fluid alone by explicit steps, from rest and oscillating.
    tube = {**IMPLICIT_CASE, "system/control.yaml": "application: dmpFlow\nendTime: 4 ms\ncheckpoint: {wallClock: never}\n",
            "system/mesh.yaml": """domain: {size: [16 um, 12 um, 12 um], periodic: [true, false, false]}
cells: [{name: rbc, shape: {type: spheroid, a: 4 um, c: 4 um}, edge: 1 um, centre: [0 um, 0.3 um, 0 um]}]
""",
            "system/observers.yaml": "flow: {type: flowRate, every: 0.2 ms}\n",
            "constant/flow.yaml": "type: poiseuille\nflowRate: 200000 um^3/s\nwalls: {type: tube, diameter: 12 um}\n"}
    start = prepared(folder / "tube", tube)
    ends = {}
    for name, ranks in (("tube1", 1), ("tube2", 2)):
        done = copied(start, folder / name)
        run(done, "dmpFlow", ranks=ranks)
        ends[name] = table(done, "flow")
        print(name, *(f"{row['flowRate_m3_s'] / 2e-13:.5f}" for row in ends[name]), f"{ends[name][-1]['pressureDrop_Pa']:.5g} Pa")
        assert all(abs(row["flowRate_m3_s"] / 2e-13 - 1) < 5e-3 for row in ends[name][4:])
    newtonian = 128 * 1e-3 * 2e-13 * 16e-6 / (math.pi * 12e-6**4)
    assert ends["tube1"][-1]["pressureDrop_Pa"] > 1.05 * newtonian, "the capsule hinders the flow"
    assert abs(ends["tube1"][-1]["pressureDrop_Pa"] / ends["tube2"][-1]["pressureDrop_Pa"] - 1) < 2e-3
    same_in_parts(folder / "tube1", start, "dmpFlow", 7, observers=("flow",))
    # This pressure drop drives this flow rate.
    given = prepared(folder / "given", {**tube, "constant/flow.yaml": tube["constant/flow.yaml"].replace(
        "flowRate: 200000 um^3/s", f"pressureDrop: {ends['tube1'][-1]['pressureDrop_Pa']} Pa")})
    run(given, "dmpFlow")
    assert abs(table(given, "flow")[-1]["flowRate_m3_s"] / 2e-13 - 1) < 0.01
    for name, drive in (("steady", ""), ("swinging", "drive: {type: sine, frequency: 10 Hz, mean: 2}\n")):
        plain = prepared(folder / f"explicit-{name}", {**pushed, "system/numerics.yaml": PLATES["system/numerics.yaml"].replace("31.25", "62.5"),
                                                       "constant/flow.yaml": "type: poiseuille\nflowRate: 2e-12 m^3/s\n" + drive})
        run(plain, "sphFlow")
        rows = [row for row in table(plain, "flow") if row["time_s"] > 0.05]
        errors = [row["flowRate_m3_s"] / 2e-12 - (2 + math.sin(omega * row["time_s"]) if drive else 1) for row in rows]
        print("explicit", name, *(f"{e:.5f}" for e in errors))
        assert len(errors) >= 14 and max(map(abs, errors)) < 5e-3


def test_rkl2(folder):
    """Super-time-stepping: as accurate as velocity Verlet in fewer steps, the same on 1, 2 and 4 ranks, restarts to the same bits in
    either precision; a checkpoint of velocity Verlet is accepted, one of the implicit step is rejected."""
    rkl2 = ("-set", "system/numerics.yaml:/integrator=rkl2")
    errors = {"couette": lambda case: profile_error(case, couette, 1.25e-5), "poiseuille": lambda case: profile_error(case, poiseuille, 1e-4),
              "vortices": decay_error}
    for name, files, fewer in (("couette", COUETTE, 3), ("poiseuille", POISEUILLE, 3), ("vortices", VORTICES, 0.2)):
        verlet = prepared(folder / f"{name}Verlet", files)
        case = copied(verlet, folder / name)
        run(verlet, "sphFlow")
        run(case, "sphFlow", *rkl2)
        found, reference = errors[name](case), errors[name](verlet)
        steps = [json.loads((c / "run.json").read_text())["performance"]["steps"] for c in (case, verlet)]
        print(name, found, reference, steps)
        assert found < 1.1 * reference + 2e-4, (name, found, reference)
        assert fewer * steps[0] < steps[1], (name, steps)
    start = prepared(folder / "start", COUETTE)
    cases = {}
    for ranks, precision in ((1, "double"), (2, "double"), (4, "double"), (2, "mixed")):
        terms = (*rkl2, "-set", f"system/numerics.yaml:/precision={precision}")
        whole = copied(start, folder / f"whole{ranks}{precision}")
        run(whole, "sphFlow", *terms, ranks=ranks)
        for observer, columns in (("balance", 6), ("wall", 4), ("profile", 4)):  # the others are noise
            one, other = ([row[:columns] for row in series(c, observer)] for c in (folder / "whole1double", whole))
            close(one, other, 1e-12 if precision == "double" else 1e-5)
        if ranks < 4:
            same_in_parts(whole, start, "sphFlow", 23, *terms, ranks=ranks)
    other = copied(start, folder / "other")
    run(other, "sphFlow", "-steps", "9")
    run(other, "sphFlow", "-steps", "9", *rkl2)
    implicit = ("-set", "system/numerics.yaml:/integrator=implicit", "-set", "system/numerics.yaml:/operators=plain", "-set", "system/numerics.yaml:/shifting=none")
    assert "integrator: the case now has implicit, but " in run(other, "sphFlow", *implicit, code=2).stderr


def test_layers(folder):
    """Couette flow of three layers, viscosities 1, 5 and 2, converges to the exact one with every scheme and form of operators; the same on two ranks; the
    layers lie across the walls' normal; a checkpoint of other layers is rejected."""
    mu, U, end = (1e-3, 5e-3, 2e-3), 6.25e-6, (-0.5e-3, -0.125e-3, 0.25e-3, 0.5e-3)
    layers = "layers: [{above: -0.125 mm, viscosity: 5 mPa s}, {above: 0.25 mm, viscosity: 2 mPa s}]\n"
    stress = 2 * U / sum((high - low) / m for m, low, high in zip(mu, end, end[1:]))
    def exact(z):
        return -U + stress * sum(max(0, min(z, high) - low) / m for m, low, high in zip(mu, end, end[1:]))
    files = {**COUETTE, "system/control.yaml": "application: sphFlow\nendTime: 0.35 s\ncheckpoint: {wallClock: never}\n",
             "system/numerics.yaml": "spacing: 62.5 um\nprecision: double\nintegrator: velocityVerlet\n",
             "system/mesh.yaml": "domain: {size: [0.5 mm, 0.5 mm, 1 mm], periodic: [true, true, false]}\n",
             "system/observers.yaml": "profile: {type: profile, every: 0.35 s, bins: 16}\nwall: {type: wallStress, every: 0.35 s}\n",
             "constant/fluid.yaml": COUETTE["constant/fluid.yaml"] + layers}
    def compare(case):
        rows = [row for row in table(case, "profile") if row["time_s"] > 0.1]
        error = math.sqrt(sum((row["u_m_s"] - exact(row["position_m"])) ** 2 for row in rows) / sum(exact(row["position_m"]) ** 2 for row in rows))
        felt = table(case, "wall")[-1]["effectiveViscosity"] * mu[0] * 0.0125
        print(case.name, error, felt / stress)
        assert len(rows) == 16 and error < 0.01 and abs(felt / stress - 1) < 0.015, (case.name, error, felt / stress)
        return rows
    start = prepared(folder / "start", files)
    corrected, implicit = {"operators": "corrected", "shifting": "{coefficient: 1}"}, {"integrator": "implicit", "implicit": "{step: 1e-4, tolerance: 1e-6}"}
    for name, words in (("verlet", {}), ("verletCorrected", corrected), ("rkl2", {"integrator": "rkl2"}), ("implicit", {**implicit, **corrected}),
                        ("implicitPlain", {**implicit, "operators": "plain"})):
        case = copied(start, folder / name)
        terms = [option for key, value in words.items() for option in ("-set", f"system/numerics.yaml:/{key}={value}")]
        run(case, "sphFlow", *terms)
        rows = compare(case)
        if "Corrected" in name or name == "rkl2":
            other = copied(start, folder / f"{name}2")
            run(other, "sphFlow", *terms, ranks=2)
            assert all(abs(a["u_m_s"] - b["u_m_s"]) < 1e-9 * U for a, b in zip(rows, compare(other)))
    across = prepared(folder / "across", {**files, "system/mesh.yaml": "domain: {size: [0.5 mm, 1 mm, 0.5 mm], periodic: [true, false, true]}\n",
                                          "system/observers.yaml": files["system/observers.yaml"].replace("profile,", "profile, axis: y,"),
                                          "constant/flow.yaml": files["constant/flow.yaml"] + "walls: {normal: y}\n"})
    run(across, "sphFlow", "-set", "system/numerics.yaml:/integrator=rkl2")
    compare(across)
    apart = "constant/fluid.yaml:/layers=[{above: -0.125 mm, viscosity: 21 mPa s}]"
    said = run(copied(start, folder / "apart"), "sphFlow", "-set", apart, "-set", "system/numerics.yaml:/operators=corrected", code=2).stderr
    assert "layers: found viscosities from 1 mPa s to 21 mPa s" in said, said
    run(copied(start, folder / "apartPlain"), "sphFlow", "-set", apart, "-set", "system/control.yaml:/endTime=0.001 s")
    changed = "constant/fluid.yaml:/layers=[{above: -0.125 mm, viscosity: 5 mPa s}, {above: 0.25 mm, viscosity: 3 mPa s}]"
    said = run(folder / "verlet", "sphFlow", "-set", changed, "-set", "system/control.yaml:/endTime=0.4 s", code=2).stderr
    assert "layers" in said and "start from firstTime" in said, said


def test_automatic(folder):
    """`integrator: automatic` selects the scheme with the lowest predicted cost; reasons why a scheme cannot do a case are given; a named one has priority."""
    automatic = ("-set", "system/numerics.yaml:/integrator=automatic")
    def predicted(case, *options):
        return json.loads(run(case, "checkCase", "-json", *options).stdout)
    case = prepared(folder / "couette", {**COUETTE, "system/control.yaml": COUETTE["system/control.yaml"].replace("0.1 s", "1 s")})
    said = predicted(case, *automatic)
    costs = said["integrators"]
    assert said["integrator"] == "rkl2" == min((name for name in costs if not costs[name]["whyNot"]), key=lambda name: costs[name]["cost"])
    assert not costs["implicit"]["whyNot"], "its steps follow the flow by themselves"
    assert math.isclose(costs["implicit"]["step_s"], (1e-3 / (2 * math.pi)) ** 2 / 1e-6 / 40, rel_tol=1e-6), costs
    long = "system/numerics.yaml:/implicit={step: 0.05}"
    assert "do not follow the flow" in predicted(case, *automatic, "-set", long)["integrators"]["implicit"]["whyNot"]
    brief = predicted(case, *automatic, "-set", "system/control.yaml:/endTime=0.05 s")
    assert brief["integrator"] == "velocityVerlet", "the first steps are as short as those of velocity Verlet"
    assert 0.7 < costs["velocityVerlet"]["step_s"] / predicted(case, "-set", "system/numerics.yaml:/integrator=velocityVerlet")["limits_s"]["viscous"] < 1.1
    run(case, "sphFlow", "-steps", "2", *automatic, "-set", long)
    assert json.loads((case / "run.json").read_text())["parameters"]["integrator"] == "rkl2"
    log = (case / "log.sphFlow").read_text()
    assert "passes a step" in log and "chosen automatically" in log and "do not follow the flow" in log, log
    run(case, "sphFlow", "-steps", "2", "-set", "system/control.yaml:/startFrom=firstTime")
    assert json.loads((case / "run.json").read_text())["parameters"]["integrator"] == "velocityVerlet"
    assert "chosen by the case" in (case / "log.sphFlow").read_text()
    # The acoustic limit is decisive, so stages gain nothing. Vortices get corrected operators, unless plain ones are named.
    swift = prepared(folder / "vortices", {**VORTICES, "constant/flow.yaml": "type: taylorGreen\nspeed: 50 mm/s\n"})
    assert predicted(swift, *automatic, "-set", "system/numerics.yaml:/operators=plain")["integrator"] == "velocityVerlet"
    said = predicted(swift, *automatic)
    assert said["integrator"] == "implicit" and "plain operators" in said["integrators"]["velocityVerlet"]["whyNot"], said
    # The scheme that automatic selects depends on other settings: at a restart the message says which one to name.
    swift = copied(swift, folder / "restarted")
    run(swift, "sphFlow", "-steps", "1", *automatic)
    said = run(swift, "sphFlow", "-steps", "1", *automatic, "-set", "system/numerics.yaml:/operators=plain", code=2).stderr
    assert "integrator: the case now has velocityVerlet" in said and "what 'automatic' stands for" in said and "write 'integrator: implicit'" in said, said
    # Cells with dual identity require velocity Verlet; immersed ones get the implicit step.
    cell = make(folder / "cell", CELL_CASE)
    said = predicted(cell, *automatic)
    assert said["integrator"] == "velocityVerlet", said
    assert "fluid alone" in said["integrators"]["rkl2"]["whyNot"] and "dualIdentity" in said["integrators"]["implicit"]["whyNot"], said
    said = predicted(make(folder / "immersed", IMPLICIT_CASE), *automatic)
    assert said["integrator"] == "implicit", said
    # A case that names no scheme: at low Reynolds number the implicit step with corrected operators and immersed membranes; with rigid
    # bodies velocity Verlet with dual identity.
    def settled(name, files, application, numerics, **changes):
        case = prepared(folder / name, files, **{"system/numerics.yaml": numerics}, **changes)
        run(case, application, "-steps", "1")
        used = (case / "used.yaml").read_text()
        return [line.strip() for line in used.splitlines()]
    low = {"constant/flow.yaml": "type: shear\nCa: 0.3\ninertia: {Re: 0.1}\n"}
    used = settled("plainWords", IMPLICIT_CASE, "dmpFlow", "spacing: 1 um\n", **low)
    assert {"integrator: implicit", "coupling: immersed", "operators: corrected", "coefficient: 1", "support: 2.4 dx", "precision: mixed"} <= set(used), used
    used = settled("explicit", IMPLICIT_CASE, "dmpFlow", "spacing: 1 um\nintegrator: velocityVerlet\n", **low)
    assert {"integrator: velocityVerlet", "coupling: immersed", "operators: corrected", "coefficient: 1"} <= set(used), used
    used = settled("bodies", BODY_CASE, "dmpFlow", "spacing: 1 um\nkernel: {type: wendlandC2, support: 2.4 dx}\n")
    assert {"integrator: velocityVerlet", "coupling: dualIdentity", "operators: plain", "shifting: none"} <= set(used), used
    used = settled("inclusion", INCLUSION_CASE, "dmpFlow", "spacing: 0.6 um\n")
    assert {"integrator: implicit", "coupling: immersed", "operators: corrected", "coefficient: 1", "jitter: 0.1"} <= set(used), used
    used = settled("inclusionByVerlet", INCLUSION_CASE, "dmpFlow", "spacing: 0.6 um\nintegrator: velocityVerlet\n")
    assert {"integrator: velocityVerlet", "coupling: dualIdentity", "operators: plain", "jitter: 0", "support: 3 dx"} <= set(used), used
    used = settled("fluid", FLUID_CASE, "sphFlow", "spacing: 62.5 um\nintegrator: implicit\n")
    assert {"operators: corrected", "coefficient: 1", "support: 2.4 dx", "jitter: 0"} <= set(used), used
    vortices = {"constant/flow.yaml": "type: taylorGreen\nspeed: 1 mm/s\ndimensions: 3\n", "system/mesh.yaml": "domain: {size: [1 mm, 1 mm, 1 mm], periodic: [true, true, true]}\n"}
    used = settled("vortices", FLUID_CASE, "sphFlow", "spacing: 62.5 um\nkernel: {type: quintic}\noperators: plain\n", **vortices)
    assert {"support: 2.8 dx", "jitter: 0.1"} <= set(used), used


def close(a, b, tolerance):
    """Whether tables have the same shape, and every number of b is within `tolerance` of that of a, relative to the largest of its column in a."""
    assert len(a) == len(b) > 0, (len(a), len(b))
    assert {len(row) for row in (*a, *b)} == {len(a[0])}, "rows of unequal width"
    for k, (mine, theirs) in enumerate(zip(zip(*a), zip(*b))):
        mine, theirs = ([float(v) for v in column] for column in (mine, theirs))
        scale = max(map(abs, mine)) or 1.0
        off = [(row, x, y) for row, (x, y) in enumerate(zip(mine, theirs)) if not abs(x - y) <= tolerance * scale]
        assert not off, f"column {k}, allowed {tolerance} of {scale:.6g}; row, number and other number: {off[:3]}"


def same_motions(motions, length, rate, tolerance=1e-6):
    """Rows of the observer body: place, axis and rotation, velocity (of the order of 1 mm/s), angular velocity."""
    scales = 3 * [length] + 7 * [1] + 3 * [1e-3] + 3 * [rate]
    for other in motions[1:]:
        assert len(other) == len(motions[0]) > 0
        for a, b in zip(motions[0], other):
            assert len(a) == len(b) >= 18, (len(a), len(b))
            assert all(abs(x - y) < tolerance * scale for x, y, scale in zip(a[2:18], b[2:18], scales)), (a, b)


def motions_on_ranks(folder, start, steps):
    """Motion of the body on 1, 2 and 4 ranks; on 1 and 2, a run in two parts, the first of `steps`, ends with the bits of a run in one."""
    motions = []
    for ranks in (1, 2, 4):
        whole = copied(start, folder / f"whole{ranks}")
        run(whole, "dmpFlow", ranks=ranks)
        motions.append([[float(v) for v in row] for row in series(whole, "motion")])
        if ranks < 4:
            same_in_parts(whole, start, "dmpFlow", steps, ranks=ranks, observers=("motion",))
        assert list((whole / "results" / "bead").glob("*.pvtp")), "the body's surface is among the results"
    return motions


def test_bodies(folder):
    """A free body across a periodic face: a run in two parts ends with the bits of a run in one, on 1 and 2 ranks; 4 ranks see the same motion."""
    start = prepared(folder / "start", BODY_CASE)
    run(start, "checkMesh")
    run(start, "checkCase")
    motions = motions_on_ranks(folder, start, 37)
    first, last = motions[0][0], motions[0][-1]
    turned, rate = last[5], last[16] / 200  # x of the axis, angular velocity about y over gammadot
    assert len(motions[0]) >= 12 and abs(first[16] - 100) < 1e-6, "it starts with half the curl of the flow"
    assert 0.2 < rate < 0.6 and turned > first[5], (turned, rate)
    same_motions(motions, 5e-6, 200)


def test_implicitBodies(folder):
    """A free body by the implicit step: in one run and in two the same bits, on 1, 2 and 4 ranks the same to ten times the tolerance, and
    both schemes near the motion that fine resolutions give it; it may lie inside an immersed capsule."""
    scheme = "kernel: {type: wendlandC2, support: 2.4 dx}\nintegrator: implicit\nimplicit: {step: 0.01, tolerance: 1e-6}\n"
    start = prepared(folder / "start", BODY_CASE, **{"system/numerics.yaml": "spacing: 1 um\nprecision: double\n" + scheme})
    run(start, "checkCase")
    motions = motions_on_ranks(folder, start, 5)
    same_motions(motions, 5e-6, 200, 1e-5)
    whole = copied(start, folder / "mixed")
    run(whole, "dmpFlow", "-set", "system/numerics.yaml:/precision=mixed", ranks=2)
    same_in_parts(whole, start, "dmpFlow", 5, "-set", "system/numerics.yaml:/precision=mixed", ranks=2)
    # After the start, in which the body, at first rotating at half the curl of the flow, is slowed down by fluid that is not yet disturbed by it.
    on = ("-set", "system/control.yaml:/endStrain=0.4")
    explicit, implicit = prepared(folder / "explicit", BODY_CASE), copied(start, folder / "on")
    for case in (explicit, implicit):
        run(case, "dmpFlow", *on, ranks=2)
    # Values computed with Corpuscle, implicit, dx 1/3 um (0.06379 and 65.73 at 1/2 um); velocity Verlet has 0.06488 and 66.29 at 1/2 um.
    limit = {"rotation": 0.06358, "rate": 65.50}
    for name, case, allowed in (("velocity Verlet", explicit, 0.06), ("implicit", implicit, 0.025)):
        rows = table(case, "motion")
        turned = rows[-1]["rotation_y"] / limit["rotation"] - 1
        rate = statistics.mean(row["angularVelocity_y_1_s"] for row in rows if row["strain"] > 0.2) / limit["rate"] - 1
        print(f"{name}, 4 particles across, over the limit of fine ones: rotation {turned:+.4f}, rate {rate:+.4f}")
        assert abs(turned) < allowed and abs(rate) < allowed, (name, turned, rate)
    case = prepared(folder / "inclusion", INCLUSION_CASE, **{
        "system/numerics.yaml": "spacing: 0.6 um\nprecision: double\n" + scheme.replace("step: 0.01, tolerance: 1e-6", "step: 0.05, tolerance: 1e-3")})
    run(case, "dmpFlow", ranks=2)
    last = table(case, "balance")[-1]
    assert last["changedSide"] == 0 and last["guardMoves"] == 0 and abs(last["volumeChange"]) < 1e-8, last
    rate = 0.1 * 4e-6 / (1e-3 * 3e-6)
    assert 0.3 < table(case, "motion")[-1]["angularVelocity_y_1_s"] / rate < 0.6, rate
    # With another viscosity around the bead: that of the outside in the limit, on 1 and 2 ranks; a thick interior turns it more slowly.
    turned = {}
    for ratio, ranks in ((1, 1), (1.001, 1), (1.001, 2), (5, 1)):
        other = copied(case, folder / f"ratio{ratio}on{ranks}")
        run(other, "dmpFlow", "-set", f"constant/membranes.yaml:/capsule/interior={{viscosityRatio: {ratio}}}", "-set", "system/control.yaml:/startFrom=firstTime",
            ranks=ranks)
        turned[ratio, ranks] = table(other, "motion")[-1]["angularVelocity_y_1_s"] / rate
        assert abs(table(other, "balance", "budget.csv")[-1]["residualShare"]) < 0.01
    print("angular velocity of a bead inside, over the shear rate:", turned)
    assert abs(turned[1.001, 1] - turned[1, 1]) < 0.01 and abs(turned[1.001, 2] - turned[1.001, 1]) < 1e-5
    assert turned[5, 1] < turned[1, 1] - 0.005


def test_inclusion(folder):
    """A free rigid sphere inside a capsule, off its middle, stays inside, turns with the flow and lets nothing through; the same on 1, 2 and 4 ranks."""
    radius, bead = 3e-6, 1.2e-6
    start = prepared(folder / "start", INCLUSION_CASE)
    run(start, "checkMesh")
    rate = 0.1 * 4e-6 / (1e-3 * radius)  # Ca Gs/(mu a)
    motions = []
    for ranks in (1, 2, 4):
        case = copied(start, folder / f"np{ranks}")
        run(case, "dmpFlow", ranks=ranks)
        motions.append([[float(v) for v in row] for row in series(case, "motion")])
        for row in table(case, "balance"):
            assert row["changedSide"] == 0 and row["guardMoves"] == 0, "particles changed side"
            assert abs(row["volumeChange"]) < 0.01, "volume of the capsule"
        rows = table(case, "motion")
        assert all(math.dist([row[f"centre_{k}_m"] for k in "xyz"], (0, 0, 0)) < radius - bead for row in rows)
        assert 0.3 < rows[-1]["angularVelocity_y_1_s"] / rate < 0.6, rows[-1]["angularVelocity_y_1_s"] / rate
    same_motions(motions, radius, rate)


def test_kill(folder):
    """A run killed by SIGKILL goes on from its last checkpoint to the same bits."""
    for scheme, files, strain in (("explicit", CELL_CASE, 1), ("implicit", IMPLICIT_CASE, 3)):
        control, changes = re.subn("endStrain: [0-9.]+", f"endStrain: {strain}", files["system/control.yaml"].replace("wallClock: never", "wallClock: 0.3 s"))
        assert changes == 1 and "wallClock: 0.3 s" in control
        case = prepared(folder / f"{scheme}Killed", {**files, "system/control.yaml": control})
        whole = copied(case, folder / f"{scheme}Whole")
        process = subprocess.Popen([str(BIN / "dmpFlow"), "-case", str(case), "-quiet"])
        deadline = time.time() + 60
        while time.time() < deadline and not list((case / "checkpoints").glob("*.h5")) and process.poll() is None:
            time.sleep(0.02)
        assert process.poll() is None, f"{scheme}: the run ended before it could be killed: make it longer"
        process.send_signal(signal.SIGKILL)
        process.wait()
        run(case, "dmpFlow")
        run(whole, "dmpFlow")
        same_checkpoint(last_checkpoint(whole), last_checkpoint(case))


def test_ranks(folder):
    """The same result to rounding on 1, 2 and 4 ranks, in either precision."""
    start = prepared(folder / "start")
    for precision, tolerance in (("double", 1e-8), ("mixed", 1e-5)):
        results = {}
        for ranks in (1, 2, 4):
            case = copied(start, folder / f"{precision}{ranks}")
            run(case, "dmpFlow", "-set", f"system/numerics.yaml:/precision={precision}", ranks=ranks)
            results[ranks] = {observer: table(case, observer) for observer in ("balance", "deformation")}
        for ranks in (2, 4):
            for observer, rows in results[1].items():
                names = [name for name in rows[0] if name not in ("momentum_y_Ns", "momentum_z_Ns")]  # sums that all but cancel
                close(*([[row[name] for name in names] for row in found[observer]] for found in (results[1], results[ranks])), tolerance)


def test_stop(folder):
    """A stop file and the wall-clock limit end a run with exit code 5 and a checkpoint."""
    case = prepared(folder / "case", **{"system/control.yaml": CELL_CASE["system/control.yaml"].replace("0.12", "50")})
    process = subprocess.Popen([str(BIN / "dmpFlow"), "-case", str(case), "-quiet"])
    time.sleep(1.5)
    (case / "stop").touch()
    assert process.wait(timeout=60) == 5
    assert json.loads((case / "run.json").read_text())["status"] == "stopped"
    assert list((case / "checkpoints").glob("*.h5")) and not (case / "stop").exists()
    run(case, "dmpFlow", "-set", "system/control.yaml:/stop/wallClock=1 s", code=5)


def test_rollback(folder):
    """After a fault in the state, rollback and shorter steps, to the same final state; a fault that recurs ends the run with all that helps to find it."""
    implicit = CELL_CASE["system/numerics.yaml"].replace("integrator: velocityVerlet\ncoupling: dualIdentity\n", "integrator: implicit\n")
    implicit = implicit.replace("shifting: {coefficient: 0.5, steps: 7}\n", "implicit: {step: 0.01}\n")
    length = CELL_CASE["system/control.yaml"].replace("0.12", "0.3")
    def figures(case):
        rows = [list(map(float, row)) for row in series(case, "deformation")]
        times = [row[0] for row in rows]
        assert times == sorted(set(times)), f"rows out of order: {times}"
        return dict(zip(next(csv.reader(lines(case, "deformation"))), rows[-1])), len(rows)
    for name, numerics, at, ranks in (("implicit", implicit, 12, 2), ("verlet", CELL_CASE["system/numerics.yaml"], 93, 1)):
        case = prepared(folder / name, **{"system/numerics.yaml": numerics, "system/control.yaml": length})
        calm = copied(case, folder / (name + "Calm"))
        run(calm, "faultInjection", "-at", "1000000")
        expected, count = figures(calm)
        assert json.loads((calm / "run.json").read_text())["performance"]["rollbacks"] == 0
        for kind in ("nan", "speed", "node", "triangle"):
            harmed = copied(case, folder / f"{name}-{kind}")
            run(harmed, "faultInjection", "-kind", kind, "-at", str(at), "-seed", "5", ranks=ranks)
            record = json.loads((harmed / "run.json").read_text())
            assert record["performance"]["rollbacks"] >= 1, kind
            found, rows = figures(harmed)
            assert rows == count, f"{name}, {kind}: {rows} rows, {count} without the fault"
            for key in ("D12_extent", "inclination_rad"):
                assert abs(found[key] - expected[key]) < 0.005 * abs(expected[key]), f"{name}, {kind}: {key} {found[key]} {expected[key]}"
        harmed = copied(case, folder / (name + "Always"))
        options = ("-kind", "nan", "-at", str(at), "-seed", "5")
        said = run(harmed, "faultInjection", *options, "-always", ranks=ranks, code=3).stderr
        assert "4 rollbacks" in said and "results/fault.pvd" in said and "checkpoint" in said, said
        record = json.loads((harmed / "run.json").read_text())
        assert record["status"] == "failed" and len(record["fault"]["place_m"]) == 3 and record["performance"]["rollbacks"] == 4, record
        assert (harmed / "results/fault.pvd").exists() and (harmed / "results/fault_rbc.pvd").exists()
        run(harmed, "dmpFlow", ranks=ranks)  # from the checkpoint of the last good state
        found, _ = figures(harmed)
        assert abs(found["D12_extent"] - expected["D12_extent"]) < 0.005 * expected["D12_extent"]
        if name == "implicit":  # what renderCase takes for a membrane is one, also beside the fault files
            run(harmed, "renderCase", "-times", "0,0.3", "-output", str(harmed / "cells.png"))
        never = copied(case, folder / (name + "Never"))
        run(never, "faultInjection", *options, "-set", "system/numerics.yaml:/rollbacks=0", code=3)
        assert not list(never.glob("checkpoints/*.h5"))
    # Two cells, one of them moved into the other.
    cells = "".join(f"  - {{name: {name}, membrane: rbc, shape: {{type: sphere, radius: 2.5 um}}, edge: 1 um, centre: [{x} um, 0 um, 0 um]}}\n"
                    for name, x in (("left", -3.5), ("right", 3.5)))
    two = prepared(folder / "two", IMPLICIT_CASE, **{
        "system/mesh.yaml": "domain: {size: [16 um, 12 um, 12 um], periodic: [true, true, false]}\ncells:\n" + cells,
        "system/observers.yaml": "deformation: {type: shape, every: 0.1 strain}\n"})
    for ranks in (1, 2):  # no shorter step is tried
        harmed = copied(two, folder / f"two{ranks}")
        said = run(harmed, "faultInjection", "-kind", "cells", "-at", "7", ranks=ranks, code=3).stderr
        assert "the cells 'left' and 'right' touch or cross at (" in said and "nothing but fluid keeps them apart" in said and "take a smaller" not in said, said
        assert json.loads((harmed / "run.json").read_text())["performance"]["rollbacks"] == 0
        run(harmed, "dmpFlow", ranks=ranks)  # from the checkpoint of the last good state


def test_endings(folder):
    """Exit codes: wrong usage 1, invalid case 2, diverged 3, missing files 4; a dry run writes nothing."""
    case = make(folder / "case", CELL_CASE)
    assert "membraneMesh" in run(case, "dmpFlow", code=4).stderr
    run(case, "membraneMesh")
    assert "particleFill" in run(case, "dmpFlow", code=4).stderr
    run(case, "particleFill")
    assert "-steps" in run(case, "dmpFlow", "-step", "3", code=1).stderr
    assert "viscosity" in run(case, "dmpFlow", "-set", "constant/fluid.yaml:/viscosty=1 Pa s", code=2).stderr
    for ranks in (1, 2):  # reported once, on whichever rank it occurred
        said = run(case, "dmpFlow", "-set", "constant/fluid.yaml:/equationOfState={type: tait, soundSpeed: 1e-6 m/s}",
                   "-set", "system/control.yaml:/endStrain=20", "-set", "constant/flow.yaml:/Ca=2", "-set", "system/numerics.yaml:/rollbacks=0",
                   ranks=ranks, code=3).stderr
        assert said.count("diverged") == 1 and "[rank" not in said, said
    for extra in ("results", "postProcessing", "checkpoints"):
        shutil.rmtree(case / extra, ignore_errors=True)
    before = sorted(p for p in case.rglob("*") if "log" not in p.name)
    checked = json.loads(run(case, "dmpFlow", "-dry-run", "-json").stdout)
    assert checked["status"] == "dryRun" and checked["limits_s"]["viscous"] > 0 and checked["groups"]["Ca"] > 0, checked
    assert sorted(p for p in case.rglob("*") if "log" not in p.name) == before
    alone = run(case, "dmpFlow", "-steps", "1", "-quiet")
    assert alone.stdout == "" and alone.stderr == "", alone
    ended = json.loads(run(case, "dmpFlow", "-steps", "2", "-json", "-set", "system/control.yaml:/startFrom=firstTime", ranks=2).stdout)
    assert ended == json.loads((case / "run.json").read_text()) and ended["performance"]["steps"] == 2, ended
    assert all(ended["versions"][library] for library in ("MPI", "CGAL", "HDF5", "VTK", "Zoltan")), ended["versions"]
    assert "run dmpFlow" in run(case, "sphFlow", code=2).stderr


def test_start(folder):
    """A start in 0/ is rejected if the case has changed since it was made, except for settings on which only the run depends."""
    case = prepared(folder / "case")
    def of(application, code, *changes, **more):
        return run(case, application, *(word for change in changes for word in ("-set", change)), code=code, **more)
    def refused(place, cure, *changes, **more):
        for application in ("dmpFlow", "checkCase"):
            said = of(application, 2, *changes, **more).stderr
            assert place in said and f"; run {cure} again" in said, f"{changes}: {said}"
            assert said.count(place) == 1, said
    mesh, box = "membraneMesh and particleFill", "particleFill"
    for change, place, cure in (
            ("system/mesh.yaml:/domain/size=[13 um, 11 um, 10 um]", "-set: domain.size: the case says [1.3e-05 m, 1.1e-05 m, 1e-05 m], but 0/fluid.vtp "
                                                              "was made for [1.2e-05 m, 1.1e-05 m, 1e-05 m]", box),
            ("system/numerics.yaml:/spacing=0.5 um", "-set: spacing: ", box),
            ("system/numerics.yaml:/kernel/support=3 dx", "kernel.support: the case says 3 dx", box),
            ("system/numerics.yaml:/kernel={type: lucy, support: 2.4 dx}", "kernel.type: the case says lucy", box),
            ("system/mesh.yaml:/fill={jitter: 0.1}", "fill.jitter: ", box),
            ("system/mesh.yaml:/fill={relaxation: 5}", "fill.relaxation: ", box),
            ("system/mesh.yaml:/cells/0/edge=0.7 um", "cells[0].edge: the case says 7e-07 m, but 0/rbc.vtp was made for 8e-07 m", mesh),
            ("system/mesh.yaml:/cells/0/shape/d=7.9 um", "cells[0].shape.d: ", mesh),
            ("system/mesh.yaml:/cells/0/shape={type: sphere, radius: 3 um}", "cells[0].shape.type: the case says sphere", mesh),
            ("system/mesh.yaml:/cells/0/centre=[4 um, 0 um, 0 um]", "cells[0].centre: ", mesh),
            ("system/mesh.yaml:/cells/0/axis=[0, 0, 1]", "cells[0].axis: ", mesh)):
        refused(place, cure, change)
    # An edge in spacings is the length that it stands for.
    inSpacings = "system/mesh.yaml:/cells/0/edge=0.8 dx"
    of("checkCase", 0, inSpacings)
    refused("cells[0].edge: the case says 4e-07 m, but 0/rbc.vtp was made for 8e-07 m", mesh, inSpacings, "system/numerics.yaml:/spacing=0.5 um")
    refused("domain.periodic: ", box, "system/mesh.yaml:/domain/periodic=[true, false, true]",
            "constant/flow.yaml:/walls={normal: y}")
    of("dmpFlow", 2, "system/mesh.yaml:/domain/size=[13 um, 11 um, 10 um]", ranks=2)

    # A new mesh does not make an old filling valid; a removed cell is named once.
    two = CELL_CASE["system/mesh.yaml"].replace("]\n", ", {name: b, membrane: rbc, shape: {type: sphere, radius: 1.5 um}, edge: 0.7 um, centre: [-1 um, 0 um, 0 um]}]\n")
    other = prepared(folder / "two", **{"system/mesh.yaml": two})
    (other / "system/mesh.yaml").write_text(CELL_CASE["system/mesh.yaml"])
    said = run(other, "dmpFlow", code=2).stderr
    assert "system/mesh.yaml:2:8: cells[1].name: the case says nothing, but 0/fluid.vtp was made for b; run particleFill again" in said, said
    assert "cells[1].edge" not in said, said
    run(other, "membraneMesh", "-set", "system/mesh.yaml:/cells/0/edge=0.7 um")
    said = run(other, "dmpFlow", "-set", "system/mesh.yaml:/cells/0/edge=0.7 um", code=2).stderr
    assert "cells[0].edge: the case says 7e-07 m, but 0/fluid.vtp was made for 8e-07 m; run particleFill again" in said, said

    # The same settings written in another way, and settings on which only the run depends.
    of("checkCase", 0, "system/mesh.yaml:/domain/size=[0.012 mm, 0.011 mm, 0.01 mm]", "system/mesh.yaml:/cells/0/axis=[0.6, 0, 2]", "system/mesh.yaml:/fill={seed: 9}")
    run_only = ("constant/flow.yaml:/Ca=0.2", "constant/flow.yaml:/inertia={Re: 4}", "constant/fluid.yaml:/viscosity=2e-3 Pa s",
                "constant/membranes.yaml:/rbc/bonds/k=4e-4 N/m", "system/numerics.yaml:/skin=0.4 dx", "system/control.yaml:/endStrain=0.05")
    of("dmpFlow", 0, *run_only)
    # ... with the same result as a case that was filled for them: density and velocity are those of the flow, not of the filling.
    fresh = make(folder / "fresh", CELL_CASE)
    sets = [word for change in run_only for word in ("-set", change)]
    for application in ("membraneMesh", "particleFill", "dmpFlow"):
        run(fresh, application, *sets)
    assert len(series(case, "balance")) > 3
    close(series(fresh, "balance"), series(case, "balance"), 1e-9)

    # A checkpoint is tied to its box and density too.
    assert "domain.size: the case now has [13 um, 11 um, 10 um]" in of("dmpFlow", 2, *run_only, "system/mesh.yaml:/domain/size=[13 um, 11 um, 10 um]").stderr
    assert "start from firstTime" in of("dmpFlow", 2, *run_only, "constant/flow.yaml:/inertia={Re: 5}").stderr

    # Without cells the kernel affects only the depth of the walls.
    fluid = prepared(folder / "fluid", FLUID_CASE)
    kernel = "system/numerics.yaml:/kernel={{type: lucy, support: {} dx}}"
    run(fluid, "sphFlow", "-dry-run", "-set", kernel.format(2.9))
    said = run(fluid, "sphFlow", "-dry-run", "-set", kernel.format(3.2), code=2).stderr
    assert "kernel.support: the case says 4 layers of wall particles, but 0/fluid.vtp was made for 3 layers" in said, said


def instructions(folder, case, application, steps):
    out = folder / f"{application}.{steps}.callgrind"
    command = ["valgrind", "--tool=callgrind", f"--callgrind-out-file={out}", str(BIN / application), "-case", str(case), "-quiet",
               "-steps", str(steps), "-set", "system/control.yaml:/startFrom=firstTime"]
    subprocess.run(command, check=True, capture_output=True)
    for line in out.read_text().splitlines():
        if line.startswith(("summary:", "totals:")):
            return int(line.split()[1])
    raise AssertionError("no total in " + str(out))


def test_skipping(folder):
    """A fluid alone costs the same instructions per step under dmpFlow as under sphFlow; particles have what the case needs and no more."""
    case = prepared(folder / "case", FLUID_CASE)
    perStep = {}
    for application in ("sphFlow", "dmpFlow"):
        perStep[application] = (instructions(folder, case, application, 30) - instructions(folder, case, application, 10)) / 20
    ratio = perStep["dmpFlow"] / perStep["sphFlow"]
    print(f"instructions per step: {perStep}, ratio {ratio:.5f}")
    assert abs(ratio - 1) < 0.01
    optional = {"mass", "viscosity", "side", "node", "member"}
    cells = {"mass", "side", "node"}
    thick = CELL_CASE["constant/membranes.yaml"] + "  interior: {viscosityRatio: 5}\n"
    for name, files, changes, wanted in (("fluid", FLUID_CASE, {}, set()), ("cells", CELL_CASE, {}, cells),
                                         ("thick", CELL_CASE, {"constant/membranes.yaml": thick}, cells | {"viscosity"}),
                                         ("bodies", BODY_CASE, {}, {"mass", "member"})):
        other = prepared(folder / name, files, **changes)
        run(other, "dmpFlow", "-steps", "1")
        names = subprocess.run(["h5ls", f"{last_checkpoint(other)}/data/particles"], capture_output=True, text=True, check=True).stdout
        stored = {line.split()[0] for line in names.splitlines()}
        assert "density" in stored and stored & optional == wanted, (name, stored)


def tearing(folder, rupture, strain):
    """A case at Ca 2 with a rupture law, filled; leakage guard and observer act at every step."""
    return prepared(folder, **{
        "system/numerics.yaml": CELL_CASE["system/numerics.yaml"] + "guard: 1\n",
        "system/control.yaml": CELL_CASE["system/control.yaml"].replace("0.12", str(strain)),
        "constant/flow.yaml": "type: shear\nCa: 2\ninertia: {Re: 0.5}\n",
        "system/observers.yaml": "tear: {type: rupture, every: 1 steps}\n",
        "constant/membranes.yaml": CELL_CASE["constant/membranes.yaml"] + f"  rupture: {rupture}\n"})


def tables(case):
    """The observer's tables with numbers for values."""
    return {p.stem: table(case, "tear", p.name) for p in case.glob("postProcessing/tear/*.csv")}


def test_rupture(folder):
    """At Ca 2 bonds break at a limit of 1.05, the same ones on 1 and 2 ranks; nothing is released before; without a limit none breaks."""
    start = tearing(folder / "start", "{type: bondStretch, limit: 1.05}", 0.8)
    ends = {}
    for ranks in (1, 2):
        case = copied(start, folder / f"np{ranks}")
        run(case, "dmpFlow", ranks=ranks)
        seen = tables(case)
        rows, ends[ranks] = seen["rbc"], seen["rbc"][-1]
        first = seen["events"][0]["strain"]
        before = [row for row in rows if row["strain"] < first]
        assert len(before) > 20, len(before)
        # leaked counts the inside particles beyond the surface, whatever the reason: it is zero, so nothing could be released.
        for key in ("leaked", "released", "releasedVolume_m3", "haemolysisIndex_percent", "bondsBroken", "holes"):
            assert all(row[key] == 0 for row in before), key
        assert ends[ranks]["firstBreak_strain"] == first
        assert ends[ranks]["haemolysisIndex_percent"] > 1 and ends[ranks]["releasedVolume_m3"] > 0
        holes = [row for row in seen["holes"] if row["strain"] == ends[ranks]["strain"]]
        assert len(holes) == ends[ranks]["holes"] > 0
        assert math.isclose(sum(row["area_m2"] for row in holes), ends[ranks]["holeArea_m2"], rel_tol=1e-12)
        said = json.loads((case / "run.json").read_text())["observers"]["tear"]
        assert said["cells"]["rbc"]["firstBreak_strain"] == first and said["cellsBroken"] == 1
        assert said["haemolysisIndex_percent"] > 1 and len(said["cells"]["rbc"]["firstBreak_place_m"]) == 3
    assert ends[1]["bondsBroken"] > 0
    assert all(math.isclose(ends[1][k], ends[2][k], rel_tol=1e-6, abs_tol=1e-18) for k in ends[1])
    intact = copied(start, folder / "intact")
    run(intact, "dmpFlow", "-set", "constant/membranes.yaml:/rbc/rupture=none")
    assert json.loads((intact / "run.json").read_text())["result"]["brokenBonds"] == 0


def test_damage(folder):
    """Damage leads to the same tear on 1, 2 and 4 ranks, is in results and checkpoints, and a restart continues with the same bits."""
    start = tearing(folder / "start", "{type: damage, onset: 0.01, scale: 0.02, time: 0.4 us, exponent: 2}", 0.5)
    seen = {}
    for ranks in (1, 2, 4):
        case = copied(start, folder / f"np{ranks}")
        run(case, "dmpFlow", ranks=ranks)
        seen[ranks] = tables(case)
        names = subprocess.run(["h5ls", f"{last_checkpoint(case)}/data/cells/rbc"], capture_output=True, text=True, check=True).stdout
        assert "damage" in names, names
        piece = b"".join(p.read_bytes() for p in sorted(case.glob("results/rbc/*/*.vtp")))
        for name in (b"damage", b"hole", b"areaStrain", b"tension1", b"tension2", b"broken"):
            assert b'Name="' + name + b'"' in piece, name
    rows, events = seen[1]["rbc"], seen[1]["events"]
    before = [row["maxDamage"] for row in rows if row["strain"] < events[0]["strain"]]
    assert before == sorted(before) and before[0] == 0 and sum(0 < value < 1 for value in before) > 5, before
    assert len(events) > 3
    for ranks in (2, 4):
        other = seen[ranks]
        assert [e["bond"] for e in events] == [e["bond"] for e in other["events"]]
        assert all(math.isclose(a["strain"], b["strain"], rel_tol=1e-9) for a, b in zip(events, other["events"]))
        assert all(math.isclose(a["maxDamage"], b["maxDamage"], rel_tol=1e-6, abs_tol=1e-12) for a, b in zip(rows, other["rbc"]))
    steps = next(k for k, row in enumerate(rows) if row["maxDamage"] > 0.1)  # a row for each step
    for ranks in (1, 2):
        parts = same_in_parts(folder / f"np{ranks}", start, "dmpFlow", steps, ranks=ranks)
    # Another law of rupture at a restart is reported; a law with damage then starts without any.
    other = copied(parts, folder / "other")
    none = ("-set", "constant/membranes.yaml:/rbc/rupture=none")
    for changed, end in ((none, 0.55), ((), 0.6)):
        run(other, "dmpFlow", *changed, "-set", f"system/control.yaml:/endStrain={end}")
        noted = json.loads((other / "run.json").read_text())["parameters"]["changedAtRestart"]
        assert any("rbc.rupture" in note for note in noted), noted
    rows = [row for row in tables(other)["rbc"] if row["strain"] > 0.5]
    assert all(row["maxDamage"] == 0 for row in rows if row["strain"] <= 0.55) and 0 < rows[-1]["maxDamage"] < 1, rows


def test_cohesive(folder):
    """A cell that weakens before it tears: the same on 1, 2 and 4 ranks, in parts and for steps of 0.05 and 0.0125; velocity Verlet agrees; what
    is released from the membrane is in the budget; another law of rupture at a restart begins without damage."""
    cell = "rbc:\n  bonds: {type: harmonic, k: 5e-4 N/m}\n  bending: {type: dihedral, Eb: 0.01}\n  rim: {tension: 1 pN}\n"
    start = prepared(folder / "start", {
        **IMPLICIT_CASE,
        "system/mesh.yaml": "domain: {size: [20 um, 16 um, 16 um], periodic: [true, true, false]}\n" + CELL_CASE["system/mesh.yaml"].splitlines()[1]
        .replace("[5 um, 0 um, 0 um], axis: [0.3, 0, 1]", "[0 um, 0 um, 0 um]") + "\n",
        "system/observers.yaml": "tear: {type: rupture, every: 0.1 strain}\nbalance: {type: conservation, every: 0.1 strain}\n",
        "system/control.yaml": IMPLICIT_CASE["system/control.yaml"].replace("0.6", "0.8"),
        "constant/membranes.yaml": cell + "  rupture: {type: cohesive, fractureEnergy: 4 pN, length: 2 um}\n",
        "constant/flow.yaml": "type: shear\nCa: 2\ninertia: {Re: 0.1}\n"})
    ends, seen = {}, {}
    for name, ranks, change in (("np1", 1, "/implicit={step: 0.05}"), ("np2", 2, "/implicit={step: 0.05}"), ("np4", 4, "/implicit={step: 0.05}"),
                                ("short", 1, "/implicit={step: 0.0125}"), ("verlet", 1, "/integrator=velocityVerlet")):
        case = copied(start, folder / name)
        run(case, "dmpFlow", "-set", "system/numerics.yaml:" + change, ranks=ranks)
        seen[name] = tables(case)["rbc"]
        ends[name] = seen[name][-1]
        print(name, *(f"{ends[name][key]:.6g}" for key in ("maxDamage", "tearLength_m", "bondsBroken", "holeRestArea_m2", "firstBreak_strain")))
        assert table(case, "balance", "budget.csv")[-1]["residualShare"] < 1e-3
        assert ends[name]["bondsBroken"] > 10 and ends[name]["holes"] >= 1 and 0.8 < ends[name]["maxDamage"] < 1
        tears = [row["tearLength_m"] for row in seen[name]]
        assert tears == sorted(tears) and tears[0] == 0
        assert "nodeDamage" in subprocess.run(["h5ls", f"{last_checkpoint(case)}/data/cells/rbc"], capture_output=True, text=True, check=True).stdout
        assert any(b'Name="damage"' in p.read_bytes() for p in case.glob("results/rbc/*/*.vtp"))
    for name in ("np2", "np4"):
        for one, other in zip(seen["np1"], seen[name]):
            for key in ("maxDamage", "tearLength_m", "bondsBroken", "holeArea_m2", "releasedVolume_m3"):
                assert math.isclose(one[key], other[key], rel_tol=1e-5, abs_tol=1e-18), (name, key, one["strain"], one[key], other[key])
    for name, bar in (("short", 0.02), ("verlet", 0.02)):
        for one, other in zip(seen[name], seen["np1"]):
            assert abs(one["tearLength_m"] - other["tearLength_m"]) < bar * ends[name]["tearLength_m"], (name, one["strain"])
        assert abs(ends["np1"]["firstBreak_strain"] - ends[name]["firstBreak_strain"]) <= 0.051
    same_in_parts(folder / "np1", start, "dmpFlow", 14, "-set", "system/numerics.yaml:/implicit={step: 0.05}")
    other = copied(folder / "np1", folder / "other")
    law = "constant/membranes.yaml:/rbc/rupture={type: damage, onset: 0.5, scale: 0.02, time: 1 s}"
    run(other, "dmpFlow", "-set", law, "-set", "system/control.yaml:/endStrain=0.9")
    assert tables(other)["rbc"][-1]["bondsBroken"] == ends["np1"]["bondsBroken"] and tables(other)["rbc"][-1]["maxDamage"] < 1e-3


def test_haemolysis(folder):
    """A capsule that loses a solute through pores: kept to rounding, the same on 1, 2 and 4 ranks and in parts; velocity Verlet agrees;
    with the dual identity on 1 and 2 ranks; pores appear in results; nothing leaves a cell without pores."""
    pores = "  pores: {type: excessArea, onset: 0.01, radius: 10 nm, resealing: 1 ms}\n"
    cell = IMPLICIT_CASE["constant/membranes.yaml"] + "  interior: {concentration: 330 kg/m^3}\n"
    start = prepared(folder / "start", {
        **IMPLICIT_CASE,
        "system/control.yaml": IMPLICIT_CASE["system/control.yaml"].replace("{strain: 0.3}", "{strain: 0.3, fields: [concentration]}"),
        "system/observers.yaml": "release: {type: haemolysis, every: 0.1 strain}\n",
        "constant/fluid.yaml": IMPLICIT_CASE["constant/fluid.yaml"] + "solute: {concentration: 2 kg/m^3}\n",
        "constant/membranes.yaml": cell + pores})
    seen = {}
    verlet = ("system/numerics.yaml:/integrator=velocityVerlet",)
    for name, ranks, changes in (("np1", 1, ()), ("np2", 2, ()), ("np4", 4, ()), ("verlet", 1, verlet), ("short", 1, ("system/numerics.yaml:/implicit={step: 0.0125, tolerance: 1e-5, error: 1}",)), ("mixed", 1, ("system/numerics.yaml:/precision=mixed",)),
                                 ("closed", 1, ("constant/membranes.yaml:/rbc/pores=none",))):
        case = copied(start, folder / name)
        run(case, "dmpFlow", *(part for change in changes for part in ("-set", change)), ranks=ranks)
        seen[name] = (table(case, "release", "rbc.csv"), table(case, "release", "case.csv"))
        of, whole = seen[name]
        print(name, *(f"{of[-1][key]:.6g}" for key in ("haemolysisIndex_percent", "poreShare", "poreShare_max")))
        first = whole[0]["solute_kg"]
        assert whole[0]["freeSolute_kg"] / first > 0.05 and math.isclose(of[0]["concentration_kg_m3"], 330)
        assert max(abs(row["solute_kg"] / first - 1) for row in whole) < 1e-12, name
        index = [row["haemolysisIndex_percent"] for row in of]
        if name == "closed":
            assert all(abs(value) < 1e-10 for value in index) and of[-1]["poreArea_m2"] == 0
            continue
        assert index == sorted(index) and index[0] == 0 < index[-1] < 50 and of[-1]["byHoles_percent"] == 0
        lost = first - whole[0]["freeSolute_kg"] - of[-1]["solute_kg"]
        assert abs(lost / (whole[-1]["freeSolute_kg"] - whole[0]["freeSolute_kg"]) - 1) < 1e-9
        assert json.loads((case / "run.json").read_text())["observers"]["release"]["haemolysisIndex_percent"] == index[-1]
        assert any(b'Name="concentration"' in p.read_bytes() for p in case.glob("results/fluid/*/*.vtp"))
        assert any(b'Name="pores"' in p.read_bytes() for p in case.glob("results/rbc/*/*.vtp"))
    for name, other, bar in (("np2", "np1", 1e-5), ("np4", "np1", 1e-5), ("mixed", "np1", 1e-4), ("verlet", "short", 0.01), ("short", "np1", 0.05)):
        for one, two in zip(seen[name][0], seen[other][0]):
            for key in ("haemolysisIndex_percent", "poreShare"):
                assert abs(one[key] - two[key]) < bar * seen["np1"][0][-1][key], (name, key, one["strain"], one[key], two[key])
    same_in_parts(folder / "np1", start, "dmpFlow", 6)
    case = prepared(folder / "dual", {**{name: text for name, text in CELL_CASE.items() if name != "system/observers.yaml"},
                                      "system/observers.yaml": "release: {type: haemolysis, every: 0.02 strain}\n",
                                      "constant/fluid.yaml": CELL_CASE["constant/fluid.yaml"] + "solute: {diffusivity: 1e-9 m^2/s}\n",
                                      "constant/membranes.yaml": CELL_CASE["constant/membranes.yaml"] + "  interior: {concentration: 330 kg/m^3}\n"
                                      + pores.replace("0.01", "0")})
    for ranks in (1, 2):
        run(case, "dmpFlow", "-set", "system/control.yaml:/startFrom=firstTime", ranks=ranks)
        rows = table(case, "release", "case.csv")
        assert abs(rows[-1]["solute_kg"] / rows[0]["solute_kg"] - 1) < 1e-12 and rows[-1]["haemolysisIndex_percent"] > 0
        seen[ranks] = rows[-1]["haemolysisIndex_percent"]
    assert math.isclose(seen[1], seen[2], rel_tol=1e-6), seen
    # Two types of which one has pores, in a box without walls; one cell is larger; parts on two ranks.
    two = prepared(folder / "two", {
        **IMPLICIT_CASE,
        "system/mesh.yaml": """domain: {size: [14 um, 12 um, 12 um], periodic: [true, true, true]}
cells:
  - {name: tight, membrane: tight, shape: {type: sphere, radius: 2.2 um}, edge: 0.8 um, places: [{centre: [3.5 um, 0 um, 3 um]}]}
  - {name: leaky, membrane: leaky, shape: {type: sphere, radius: 2.2 um}, edge: 0.8 um,
     places: [{centre: [-3 um, 0 um, -3 um], scale: 1.2}, {centre: [6 um, 0 um, -2.8 um]}]}
""",
        "system/observers.yaml": "release: {type: haemolysis, every: 0.1 strain}\n",
        "constant/fluid.yaml": IMPLICIT_CASE["constant/fluid.yaml"] + "solute: {}\n",
        "constant/membranes.yaml": "".join(
            f"{name}:\n  interior: {{concentration: 330 kg/m^3}}\n  triangles: {{type: skalak, Gs: 5e-6 N/m, C: 1}}\n  pores: {law}\n"
            for name, law in (("tight", "none"), ("leaky", "{type: tension, onset: 1 uN/m, modulus: 0.1 mN/m, radius: 10 nm}"))),
        "constant/flow.yaml": "type: leesEdwards\nCa: 0.3\ninertia: {Re: 0.1}\n"})
    for ranks in (1, 2):
        case = copied(two, folder / f"two{ranks}")
        run(case, "dmpFlow", ranks=ranks)
        seen[ranks] = [row["haemolysisIndex_percent"] for row in table(case, "release", "leaky.csv")[-2:]]
        assert abs(table(case, "release", "tight.csv")[-1]["haemolysisIndex_percent"]) < 1e-10 and min(seen[ranks]) > 0.01, seen
    print("two types", seen[1])
    assert all(math.isclose(one, other, rel_tol=1e-5) for one, other in zip(seen[1], seen[2])), seen
    same_in_parts(folder / "two2", two, "dmpFlow", 6, ranks=2)


def vessel(path, radius, length, along=40, around=64):
    """Writes an open tube of radius(x) along x, in um, as OFF; every third pair of triangles has one that points the other way."""
    with open(path, "w") as out:
        print(f"OFF\n{(along + 1) * around} {2 * along * around} 0", file=out)
        for i in range(along + 1):
            x = length * (i / along - 0.5)
            for j in range(around):
                a = 2 * math.pi * j / around
                print(f"{x:.9g} {radius(x) * math.cos(a):.9g} {radius(x) * math.sin(a):.9g}", file=out)
        for i in range(along):
            for j in range(around):
                a, b = i * around + j, i * around + (j + 1) % around
                one, two = (b, a) if (i + j) % 3 == 0 else (a, b)
                print(f"3 {one} {two} {a + around}\n3 {b} {b + around} {a + around}", file=out)


def test_vessels(folder):
    """A capsule driven through a constriction: the same on 1, 2 and 4 ranks and in parts, with the constriction as a surface of triangles,
    within 1 %; nothing is lost, nothing crosses the wall; flow rate and forces balance, and Newton's fluid has its own viscosity."""
    tube = "type: poiseuille\npressureDrop: 15 Pa\nwalls: {type: tube, diameter: 12 um}\n"
    narrow = "type: poiseuille\npressureDrop: 15 Pa\nwalls: {type: constriction, diameter: 12 um, throat: 7 um, length: 4 um, taper: 6 um}\n"
    case = {**IMPLICIT_CASE,
            "system/control.yaml": "application: dmpFlow\nendTime: 14 ms\nwrite: {time: 7 ms}\ncheckpoint: {wallClock: never}\n",
            "system/numerics.yaml": IMPLICIT_CASE["system/numerics.yaml"].replace("step: 0.05", "step: 0.1").replace("error: 1}", "error: 1e-2}"),
            "system/mesh.yaml": """domain: {size: [24 um, 12 um, 12 um], periodic: [true, false, false]}
cells: [{name: rbc, shape: {type: spheroid, a: 3.2 um, c: 3.2 um}, edge: 0.9 um, centre: [-9 um, 0.4 um, 0 um]}]
""",
            "system/observers.yaml": "flow: {type: flowRate, every: 1 ms}\nplace: {type: suspension, every: 1 ms}\nbalance: {type: conservation, every: 1 ms}\n",
            "constant/membranes.yaml": "rbc:\n  triangles: {type: skalak, Gs: 2e-5 N/m, C: 1}\n  bending: {type: dihedral, Eb: 0.01}\n",
            "constant/flow.yaml": narrow}
    start = prepared(folder / "start", case)
    # The profile of the constriction.
    radius = lambda x: 6 - 1.25 * (1 + math.cos(math.pi * min(1, max(0, (abs(x) - 2) / 6))))
    triangles = make(folder / "triangles", {**case, "constant/flow.yaml": "type: poiseuille\npressureDrop: 15 Pa\n"
                                            "walls: {type: surface, file: constant/vessel.off, at: asWritten}\n"})
    vessel(triangles / "constant/vessel.off", radius, 24, along=120, around=192)
    for program in ("membraneMesh", "particleFill"):
        run(triangles, program)
    assert "pointed inwards" in (triangles / "log.particleFill").read_text(), "what was turned is said"
    seen = {}
    for name, of, ranks in (("np1", start, 1), ("np2", start, 2), ("np4", start, 4), ("surface", triangles, 1)):
        ready = copied(of, folder / name)
        run(ready, "dmpFlow", ranks=ranks)
        seen[name] = table(ready, "flow"), table(ready, "place", "rbc.csv")
        flow, place = seen[name]
        print(name, *(f"{key} {flow[-1][key]:.6g}" for key in ("flowRate_m3_s", "imbalance", "haematocrit_discharge")), f"x {1e6 * place[-1]['centroid_x_m']:.5g} um")
        assert max(abs(row["volumeChange"]) for row in table(ready, "balance")) < 1e-8
    for name, bar in (("np2", 2e-4), ("np4", 2e-4), ("surface", 0.01)):
        for k, column in ((0, "flowRate_m3_s"), (1, "centroid_x_m")):
            scale = max(abs(row[column]) for row in seen["np1"][k])
            for one, other in zip(seen["np1"][k], seen[name][k]):
                assert abs(one[column] - other[column]) < bar * scale, (name, column, one["time_s"], one[column], other[column])
    way = seen["np1"][1][-1]["centroid_x_m"] - seen["np1"][1][0]["centroid_x_m"]
    assert way > 12e-6, way  # through the throat
    rates = [row["flowRate_m3_s"] for row in seen["np1"][0][2:]]
    assert min(rates) < 0.97 * max(rates), "the capsule in the throat hinders the flow"
    assert all(abs(row["imbalance"]) < 0.02 for row in seen["np1"][0][2:])
    same_in_parts(folder / "np2", start, "dmpFlow", 20, ranks=2, observers=("flow",))
    # Without a cell: a straight tube of 12 spacings has the viscosity of its fluid to within the error of the wall, as a shape and in explicit steps.
    for name, keys, bar in (("tube", "integrator: implicit\n", 0.016), ("verlet", "integrator: velocityVerlet\n", 0.04)):
        plain = make(folder / name, {"system/control.yaml": "application: sphFlow\nendTime: 60 us\n",
                                     "system/numerics.yaml": f"spacing: 1 um\noperators: corrected\n{keys}",
                                     "system/mesh.yaml": "domain: {size: [8 um, 12 um, 12 um], periodic: [true, false, false]}\n",
                                     "system/observers.yaml": "flow: {type: flowRate, every: 5 us}\n",
                                     "constant/fluid.yaml": case["constant/fluid.yaml"], "constant/flow.yaml": tube.replace("15 Pa", "1 Pa")})
        run(plain, "particleFill")
        run(plain, "sphFlow")
        last = table(plain, "flow")[-1]
        print(name, last["relativeViscosity"], last["imbalance"])
        assert abs(last["relativeViscosity"] - 1) < bar and abs(last["imbalance"]) < 0.01, last


def test_branches(folder):
    """A capsule driven through a vessel that divides and joins again: the same on 1, 2 and 4 ranks and in parts; what flows in flows out; the
    capsule is counted in the branch that it takes; a network with a gap is refused."""
    legs = [((-18, 0), (-12, 0), 10), ((-12, 0), (-6, 6), 10), ((-6, 6), (6, 6), 10), ((6, 6), (12, 0), 10),
            ((-12, 0), (-6, -6), 7), ((-6, -6), (6, -6), 7), ((6, -6), (12, 0), 7), ((12, 0), (18, 0), 10)]
    tubes = [f"{{from: [{a[0]} um, {a[1]} um, 0 um], to: [{b[0]} um, {b[1]} um, 0 um], diameter: {wide} um}}" for a, b, wide in legs]
    vessel = lambda parts: f"type: poiseuille\npressureDrop: 20 Pa\nwalls: {{type: network, tubes: [{', '.join(parts)}]}}\n"
    section = lambda x, y, more="": f"{{type: section, every: 0.5 ms, centre: [{x} um, {y} um, 0 um], radius: 5.5 um, width: 8 um{more}}}\n"
    case = {**IMPLICIT_CASE,
            "system/control.yaml": "application: dmpFlow\nendTime: 8 ms\nwrite: {time: 4 ms}\ncheckpoint: {wallClock: never}\n",
            "system/numerics.yaml": IMPLICIT_CASE["system/numerics.yaml"].replace("step: 0.05", "step: 0.1").replace("error: 1}", "error: 1e-2}"),
            "system/mesh.yaml": """domain: {size: [36 um, 24 um, 10 um], periodic: [true, false, false]}
cells: [{name: rbc, shape: {type: spheroid, a: 2.4 um, c: 2.4 um}, edge: 0.9 um, centre: [-15 um, 1 um, 0 um]}]
""",
            "system/observers.yaml": "flow: {type: flowRate, every: 0.5 ms}\nbalance: {type: conservation, every: 1 ms}\nwhole: " + section(18, 0)
                                     + "first: " + section(0, 6) + "second: " + section(0, -6) + "back: " + section(0, 6, ", normal: [-1, 0, 0]"),
            "constant/membranes.yaml": "rbc:\n  triangles: {type: skalak, Gs: 2e-5 N/m, C: 1}\n  bending: {type: dihedral, Eb: 0.01}\n",
            "constant/contact.yaml": "law: {type: barrier, reach: 0.2 um, strength: 5e-5 N/m}\nwalls: true\n",
            "constant/flow.yaml": vessel(tubes)}
    start = prepared(folder / "start", case)
    seen = {}
    for ranks in (1, 2, 4):
        ready = copied(start, folder / f"np{ranks}")
        run(ready, "dmpFlow", ranks=ranks)
        seen[ranks] = {name: table(ready, name, "section.csv") for name in ("whole", "first", "second", "back")}
        last = {name: rows[-1] for name, rows in seen[ranks].items()}
        print(ranks, *(f"{name} {row['flowRate_m3_s']:.6g} {row['cells']:g}" for name, row in last.items()))
        assert max(abs(row["volumeChange"]) for row in table(ready, "balance")) < 1e-8
        assert last["first"]["cells"] == 1 and last["second"]["cells"] == 0 and last["back"]["cells"] == -1, last
        assert any(row["haematocrit_tube"] > 0.05 for row in seen[ranks]["first"]) and all(row["haematocrit_tube"] == 0 for row in seen[ranks]["second"])
        for one, other in zip(seen[ranks]["first"], seen[ranks]["back"]):
            assert math.isclose(one["flowRate_m3_s"], -other["flowRate_m3_s"], rel_tol=1e-12)
            assert math.isclose(one["haematocrit_tube"], other["haematocrit_tube"])
        # Sums over a few particles in a narrow slab scatter by several per cent: only their means over time are alike.
        mean = {name: statistics.fmean(row["flowRate_m3_s"] for row in rows[2:]) for name, rows in seen[ranks].items()}
        print(ranks, mean)
        assert abs((mean["first"] + mean["second"]) / mean["whole"] - 1) < 0.03, mean
    for ranks in (2, 4):
        for name, rows in seen[1].items():
            scale = max(abs(row["flowRate_m3_s"]) for row in rows)
            for one, other in zip(rows, seen[ranks][name]):
                assert abs(one["flowRate_m3_s"] - other["flowRate_m3_s"]) < 2e-4 * scale, (ranks, name, one, other)
                assert one["cells"] == other["cells"]
    parts = same_in_parts(folder / "np2", start, "dmpFlow", 30, ranks=2, observers=("flow",))
    for name in seen[2]:
        assert lines(folder / "np2", name, "section.csv") == lines(parts, name, "section.csv"), name
    gap = make(folder / "gap", {**case, "constant/flow.yaml": vessel(tubes[:-1])})
    said = run(gap, "particleFill", code=2).stderr
    assert "walls.tubes: no tubes lead from one end of the box to the other, x = -18 um and 18 um" in said, said


def test_firstBreak(folder):
    """stop.firstBreak ends a run at the step of the first break with exit code 5; without a break the run goes to its end."""
    case = tearing(folder / "case", "{type: bondStretch, limit: 1.05}", 0.8)
    stop = ("-set", "system/control.yaml:/stop/firstBreak=true")
    for ranks in (1, 2):
        run(case, "dmpFlow", *stop, "-set", "system/control.yaml:/startFrom=firstTime", ranks=ranks, code=5)
        record = json.loads((case / "run.json").read_text())
        assert record["status"] == "stopped" and "first break" in record["reason"], record["reason"]
        events = tables(case)["events"]
        assert record["result"]["brokenBonds"] == len(events) > 0
        assert {e["strain"] for e in events} == {record["result"]["strain"]} == {record["observers"]["tear"]["firstBreak_strain"]}
    assert json.loads((case / "run.json").read_text())["performance"]["steps"] > 10
    run(case, "dmpFlow", *stop, code=5)  # the break has occurred: no further step
    assert json.loads((case / "run.json").read_text())["performance"]["steps"] == 0
    run(case, "dmpFlow", *stop, "-set", "system/control.yaml:/startFrom=firstTime", "-set", "system/control.yaml:/endStrain=0.05")
    assert json.loads((case / "run.json").read_text())["result"]["brokenBonds"] == 0


def test_stressFree(folder):
    """A cell relaxes to the stress-free shape that its case names; its own mesh as that shape changes nothing; another mesh is rejected."""
    laws = CELL_CASE["constant/membranes.yaml"]
    relax = """cell: {name: rbc, shape: {type: kuchelFackerell, d: 8 um, h: 2.12 um, b: 1 um}, edge: 0.8 um}
protocol: {type: resting}
forceScale: 1 pN
"""
    def relaxed(name, laws):
        case = make(folder / name, {"system/relax.yaml": relax, "constant/membranes.yaml": laws})
        run(case, "membraneRelax")
        (surface,) = (case / "results/rbc").glob("*/*.vtp")
        return surface, table(case, "relax")[-1]
    blown, end = relaxed("blown", laws + "  volume: {modulus: 1 kPa, reducedVolume: 0.8}\n")
    assert float(end["volumeStrain"]) > 0.1
    (folder / "back/constant").mkdir(parents=True)
    shutil.copy(blown, folder / "back/constant/stressFree.vtp")
    free = laws + "  stressFree: constant/stressFree.vtp\n"
    _, back = relaxed("back", free)
    for name in ("area_m2", "volume_m3"):
        assert math.isclose(float(back[name]), float(end[name]), rel_tol=1e-5), (name, back[name], end[name])
    assert float(back["energy_J"]) < 1e-6 * float(end["energy_J"])

    plain = prepared(folder / "plain")
    own, other = folder / "own", folder / "other"
    for case in (own, other):
        shutil.copytree(plain, case)
        (case / "constant/membranes.yaml").write_text(free)
    shutil.copy(own / "0/rbc.vtp", own / "constant/stressFree.vtp")
    shutil.copy(blown, other / "constant/stressFree.vtp")
    steps = ("-steps", "20")
    for case in (plain, own, other):
        run(case, "dmpFlow", *steps)
    same_checkpoint(last_checkpoint(plain), last_checkpoint(own), apart=("/data/origin/settings",))
    volume = {case.name: float(series(case, "balance")[0][-2]) for case in (plain, other)}
    assert math.isclose(volume["plain"], volume["other"], rel_tol=1e-12), "both start from the mesh"
    energy = {case.name: float(series(case, "balance")[0][10]) for case in (plain, other)}
    assert energy["other"] > 1e3 * abs(energy["plain"]), energy
    said = run(own, "dmpFlow", "-set", "system/control.yaml:/startFrom=firstTime", "-set", "constant/membranes.yaml:/rbc/stressFree=0/fluid.vtp", code=2).stderr
    assert "stressFree: found 0/fluid.vtp with" in said and "membraneRelax" in said, said
    said = run(own, "checkCase", "-set", "constant/membranes.yaml:/rbc/stressFree=none.vtp", code=2).stderr
    assert "rbc.stressFree" in said and "none.vtp" in said, said


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as temporary:
        globals()["test_" + sys.argv[2]](pathlib.Path(temporary))
    print("passed")
