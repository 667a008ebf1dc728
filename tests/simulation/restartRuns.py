#!/usr/bin/env python3
"""What belongs to an earlier run never mixes with a new one: whole runs of small cases, continued, refused, started anew, locked.

    restartRuns.py BIN TEST    BIN: directory of the applications
"""
import atexit
import hashlib
import json
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time

import runs
from runs import BIN, CELL_CASE, FLUID_CASE, copied, last_checkpoint, make, prepared, run

# A few steps, one second at most, with explicit membrane and fluid. The density does not depend on the flow.
CASE = {**CELL_CASE, "constant/flow.yaml": "type: shear\nCa: 0.1\n",
        "constant/fluid.yaml": "density: 5700 kg/m^3\nviscosity: 1.0e-3 Pa s\n",
        "system/control.yaml": CELL_CASE["system/control.yaml"].replace("0.12", "0.03").replace("{strain: 0.05}", "{strain: 0.01}")}
TWO_CELLS = {**CASE, "system/mesh.yaml": """domain: {size: [12 um, 11 um, 10 um], periodic: [true, true, false]}
cells:
  - {name: rbc, shape: {type: sphere, radius: 2 um}, edge: 0.8 um, centre: [3 um, 0 um, 0 um]}
  - {name: other, membrane: rbc, shape: {type: sphere, radius: 2 um}, edge: 0.8 um, centre: [-3 um, 0 um, 0 um]}
"""}


def sets(*changes):
    return [word for change in changes for word in ("-set", change)]


def contents(case):
    """Content and modification time of every file of a case."""
    return {str(p.relative_to(case)): (hashlib.sha256(p.read_bytes()).hexdigest(), p.stat().st_mtime_ns)
            for p in sorted(case.rglob("*")) if p.is_file()}


def unchanged(case, application, *options, code, ranks=1):
    before = contents(case)
    done = run(case, application, *options, code=code, ranks=ranks)
    after = contents(case)
    assert before == after, (application, options, sorted(k for k in {*before, *after} if before.get(k) != after.get(k)))
    return done


def said(case, *options):
    """Terminal output of a run without -quiet."""
    done = subprocess.run([str(BIN / "dmpFlow"), "-case", str(case), *options], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return done.stdout


def started(*command, **options):
    """A program in the background, ended at the latest with this test."""
    process = subprocess.Popen(command, **options)
    atexit.register(lambda: process.poll() is None and process.kill())
    return process


MORE = "system/control.yaml:/endStrain=0.05"


def test_fixed(folder):
    """A restart is rejected if settings that the state depends on have changed; all are reported at once, with place, old value and remedy. Values count."""
    case = prepared(folder / "case", CASE)
    run(case, "dmpFlow")
    for change, key, now, before in (
            ("system/numerics.yaml:/kernel={type: lucy, support: 2.4 dx}", "kernel", "{type: lucy, support: 2.4 dx}", "{type: wendlandC2, support: 2.4 dx}"),
            ("system/numerics.yaml:/kernel/support=2.5 dx", "kernel.support", "2.5 dx", "2.4 dx"),
            ("system/numerics.yaml:/shifting=none", "shifting", "none", "{coefficient: 0.5, steps: 7, densityRate: auto, backgroundPressure: auto}"),
            ("system/numerics.yaml:/skin=0.4 dx", "skin", "0.4 dx", "0.3 dx"),
            ("system/mesh.yaml:/cells/0/centre=[4 um, 0 um, 0 um]", "cells[0].centre", "[4 um, 0 m, 0 m]", "[5 um, 0 m, 0 m]"),
            ("system/mesh.yaml:/cells/0/shape/d=7.9 um", "cells[0].shape.d", "7.9 um", "8 um"),
            ("system/mesh.yaml:/cells/0/edge=0.7 um", "cells[0].edge", "700 nm", "800 nm"),
            ("system/mesh.yaml:/fill={seed: 2}", "fill.seed", "2", "1"),
            ("system/mesh.yaml:/domain/size=[12 um, 12 um, 10 um]", "domain.size", "[12 um, 12 um, 10 um]", "[12 um, 11 um, 10 um]"),
            ("constant/fluid.yaml:/density=4000 kg/m^3", "density", "4000 kg/m^3", "5700 kg/m^3"),
            ("constant/membranes.yaml:/rbc/interior={viscosityRatio: 5}", "rbc.interior.viscosityRatio", "5", "1"),
            ("constant/flow.yaml:/start=rest", "start", "rest", "linear")):
        found = unchanged(case, "dmpFlow", *sets(change, MORE), code=2).stderr
        for part in (f"{key}: the case now has {now}, but ", f"was written with {before}; start from firstTime, or give the old value"):
            assert part in found, f"{change}: {part} is not in\n{found}"
    # All are reported at once, each with its place in its file, and the same on two ranks.
    numerics, mesh = (case / "system/numerics.yaml"), (case / "system/mesh.yaml")
    originals = numerics.read_text(), mesh.read_text()
    numerics.write_text(originals[0].replace("support: 2.4 dx", "support: 2.6 dx"))
    mesh.write_text(originals[1].replace("[5 um, 0 um, 0 um], axis: [0.3, 0, 1]", "[5 um, 0 um, 1 um], axis: [1, 0, 1]"))
    for ranks in (1, 2):
        found = unchanged(case, "dmpFlow", *sets(MORE), code=2, ranks=ranks).stderr
        for file, line, value, key in ((numerics, 3, "2.6 dx", "kernel.support"), (mesh, 2, "[5 um, 0 um, 1 um]", "cells[0].centre"), (mesh, 2, "[1, 0, 1]", "cells[0].axis")):
            column = file.read_text().splitlines()[line - 1].index(value) + 1
            assert found.count(f"system/{file.name}:{line}:{column}: {key}: ") == 1, f"{line}:{column} {key}\n{found}"
        assert "3 problems in the case" in found, found
    # The same values written in another way are the same case.
    numerics.write_text(originals[0].replace("spacing: 1 um", "spacing: 0.001 mm").replace("support: 2.4 dx", "support: 2400 nm"))
    mesh.write_text(originals[1].replace("[12 um, 11 um, 10 um]", "[0.012 mm, 11000 nm, 1e-5 m]").replace("axis: [0.3, 0, 1]", "axis: [0.6, 0, 2]"))
    text = said(case, *sets(MORE))
    assert "Restart from" in text and "changed at the restart" not in text, text
    # Density from Re: another Ca would mean another fluid; the remedy that the message names works.
    case = prepared(folder / "re", {**CASE, "constant/flow.yaml": "type: shear\nCa: 0.1\ninertia: {Re: 0.5}\n"})
    run(case, "dmpFlow")
    found = unchanged(case, "dmpFlow", *sets(MORE, "constant/flow.yaml:/Ca=0.2"), code=2).stderr
    density = re.search(r"was written with ([0-9.e+]+ [k]?g/[a-z^0-9]+); start from firstTime, or keep the density", found)
    assert density, found
    used = json.loads((case / "run.json").read_text())["parameters"]["density_kg_m3"]
    text = said(case, *sets(MORE, "constant/flow.yaml:/Ca=0.2", "constant/flow.yaml:/inertia=physical", f"constant/fluid.yaml:/density={used!r} kg/m^3"))
    assert "Ca: changed at the restart, from 0.1 to 0.2" in text, text


def test_meshes(folder):
    """A cell that was moved, turned, reshaped, replaced or meshed otherwise since the checkpoint, with mesh and filling made anew, is not continued."""
    sphere = "{name: rbc, shape: {type: sphere, radius: 2 um}, edge: 0.8 um}"
    for name, first, second, expected in (
            ("moved", sphere, sphere.replace("edge: 0.8 um", "edge: 0.8 um, centre: [1 um, 0.5 um, 0.2 um]"), ["cells[0].centre"]),
            ("twice", sphere, sphere.replace("2 um", "4 um").replace("0.8", "1.6"), ["cells[0].edge", "cells[0].shape.radius"]),
            ("renamed", sphere, sphere.replace("name: rbc", "name: abc, membrane: rbc"), ["cells[0].name"]),
            ("reshaped", sphere, sphere.replace("sphere, radius: 2 um", "spheroid, a: 2.4 um, c: 1.5 um"), ["cells[0].shape"])):
        text = "domain: {size: [12 um, 11 um, 10 um], periodic: [true, true, false]}\ncells: [%s]\n"
        case = prepared(folder / name, {**CASE, "system/mesh.yaml": text % first})
        run(case, "dmpFlow", "-steps", "3")
        prepared(case, {**CASE, "system/mesh.yaml": text % second})
        found = unchanged(case, "dmpFlow", "-steps", "3", code=2).stderr
        for key in expected:
            assert f": {key}: the case now has " in found, f"{name}: {key}\n{found}"
    # A surface from a file that has been changed under the same name: no setting differs, the mesh does.
    file_case = {**CASE, "system/mesh.yaml": "domain: {size: [12 um, 11 um, 10 um], periodic: [true, true, false]}\n"
                 "cells: [{name: rbc, shape: {type: file, file: constant/cell.vtp, scale: 1 m}, edge: 0.9 um}]\n"}
    shapes = {}
    for shape in ("sphere, radius: 3 um", "spheroid, a: 3.2 um, c: 2.6 um"):
        source = make(folder / ("made" + shape[:6]), {**CASE, "system/mesh.yaml": text % f"{{name: rbc, shape: {{type: {shape}}}, edge: 0.8 um}}"})
        run(source, "membraneMesh")
        shapes[shape[:6]] = source / "0/rbc.vtp"
    case = make(folder / "file", file_case)
    shutil.copy(shapes["sphere"], case / "constant/cell.vtp")
    prepared(case, file_case)
    run(case, "dmpFlow", "-steps", "3")
    shutil.copy(shapes["sphero"], case / "constant/cell.vtp")
    prepared(case, file_case)
    for ranks in (1, 2):
        found = unchanged(case, "dmpFlow", "-steps", "3", code=2, ranks=ranks).stderr
        assert "0/rbc.vtp: has " in found and "start from firstTime" in found, found
    # Cells in another order are other cells; a body that was moved is another one.
    two = prepared(folder / "two", TWO_CELLS)
    run(two, "dmpFlow", "-steps", "3")
    lines = TWO_CELLS["system/mesh.yaml"].splitlines(keepends=True)
    prepared(two, {**TWO_CELLS, "system/mesh.yaml": "".join(lines[:2] + lines[:1:-1])})
    assert "cells[0].name: the case now has other" in unchanged(two, "dmpFlow", "-steps", "3", code=2).stderr
    body = prepared(folder / "body", runs.BODY_CASE)
    run(body, "dmpFlow", "-steps", "3")
    prepared(body, {**runs.BODY_CASE, "system/mesh.yaml": runs.BODY_CASE["system/mesh.yaml"].replace("[5 um, 0 um, 0 um]", "[4 um, 0 um, 0 um]")})
    assert "bodies[0].centre" in unchanged(body, "dmpFlow", "-steps", "3", code=2).stderr


def test_noted(folder):
    """Settings that may change at a restart are reported with both values, on the terminal, in the log and in run.json; free ones are not mentioned."""
    start = prepared(folder / "start", CASE)
    run(start, "dmpFlow", "-steps", "10")
    for k, (change, expected) in enumerate((
            ("constant/flow.yaml:/Ca=0.2", "constant/flow.yaml: Ca: changed at the restart, from 0.1 to 0.2"),
            ("constant/membranes.yaml:/rbc/bonds/k=4e-4 N/m", "constant/membranes.yaml: rbc.bonds.k: changed at the restart, from 500 uN/m to 400 uN/m"),
            ("system/numerics.yaml:/safety=0.5", "system/numerics.yaml: safety: changed at the restart, from 0.95 to 0.5"),
            ("constant/fluid.yaml:/viscosity=1.1 mPa s", "constant/fluid.yaml: viscosity: changed at the restart, from 1 mPa s to 1.1 mPa s"),
            ("system/numerics.yaml:/shifting/coefficient=1", "system/numerics.yaml: shifting.coefficient: changed at the restart, from 0.5 to 1"))):
        case = copied(start, folder / f"noted{k}")
        text = said(case, "-steps", "2", *sets(change))
        recorded = json.loads((case / "run.json").read_text())["parameters"].get("changedAtRestart", [])
        for place in (text, (case / "log.dmpFlow").read_text(), "\n".join(recorded)):
            assert expected in place, f"{change}: {expected}\n{place}"
    for k, change in enumerate(("system/control.yaml:/endStrain=0.5", "system/control.yaml:/write/strain=0.02", "system/control.yaml:/checkpoint/keep=3",
                                "system/observers.yaml:/deformation/every=0.02 strain", "system/numerics.yaml:/rollbacks=2")):
        text = said(copied(start, folder / f"free{k}"), "-steps", "2", *sets(change))
        assert "Restart from" in text and "changed at the restart" not in text, text
    # The laws belong to the cell, whatever the name of their entry.
    laws = start / "constant/membranes.yaml"
    laws.write_text(laws.read_text().replace("rbc:", "healthy:") + "unused:\n  bonds: {type: harmonic, k: 1e-4 N/m}\n")
    text = said(copied(start, folder / "entry"), "-steps", "2", *sets("system/mesh.yaml:/cells/0/membrane=healthy"))
    assert "cells[0].membrane: changed at the restart, from nothing to healthy" in text and "rbc.bonds" not in text and "healthy.bonds" not in text, text
    laws.write_text(laws.read_text().replace("k: 5e-4 N/m", "k: 6e-4 N/m"))
    text = said(copied(start, folder / "entryChanged"), "-steps", "2", *sets("system/mesh.yaml:/cells/0/membrane=healthy"))
    assert "healthy.bonds.k: changed at the restart, from 500 uN/m to 600 uN/m" in text, text


def times(case, stream):
    index = case / f"results/{stream}.pvd"
    return [float(t) for t in re.findall(r'timestep="([^"]+)"', index.read_text())] if index.exists() else []


def stretches(case, killed=False):
    """Streams of the results with the number of their times, and of the checkpoints. A run that was killed may leave a piece that no index names."""
    files = {stream.stem: len(times(case, stream.stem)) for stream in (case / "results").glob("*.pvd")}
    for name, count in files.items():
        pieces = list((case / "results" / name).glob(f"{name}_*.pvtp"))
        assert killed or len(pieces) == count == len([p for p in (case / "results" / name).iterdir() if p.is_dir()]), (name, count, pieces)
    return files, len(list((case / "checkpoints").glob("*.h5")))


def test_anew(folder):
    """After a start from firstTime, or a restart before the end, nothing of the earlier run's later output is left."""
    case = prepared(folder / "case", TWO_CELLS)
    run(case, "dmpFlow", "-steps", "5")
    run(case, "dmpFlow")
    files, checkpoints = stretches(case)
    assert set(files) == {"fluid", "rbc", "other"} and min(files.values()) >= 3 and checkpoints == 2, (files, checkpoints)
    # One cell fewer; if killed before its first checkpoint, the case must not continue from the old run.
    lines = TWO_CELLS["system/mesh.yaml"].splitlines(keepends=True)
    prepared(case, {**TWO_CELLS, "system/mesh.yaml": "".join(lines[:3])})
    anew = "system/control.yaml:/startFrom=firstTime"
    process = started(str(BIN / "dmpFlow"), "-case", str(case), *sets(anew, "system/control.yaml:/endStrain=50"), stdout=subprocess.PIPE, text=True)
    deadline = time.time() + 60
    while (case / "results/other.pvd").exists() and time.time() < deadline:
        time.sleep(0.02)
    time.sleep(0.5)
    process.send_signal(signal.SIGKILL)
    assert "removed what an earlier run of the case wrote before: " in process.communicate()[0]
    files, checkpoints = stretches(case, killed=True)
    assert set(files) == {"fluid", "rbc"} and checkpoints == 0, (files, checkpoints)
    assert times(case, "rbc")[0] == 0
    run(case, "dmpFlow", "-steps", "5", ranks=2)  # from 0/: there is no checkpoint
    assert times(case, "rbc")[0] == 0 and (case / "log.dmpFlow").read_text().count("dmpFlow 0") == 1

    # A restart before later output: on another number of ranks too.
    for ranks in (1, 2):
        case = prepared(folder / f"earlier{ranks}", CASE)
        run(case, "dmpFlow", "-steps", "30")
        first = json.loads((case / "run.json").read_text())["result"]["time_s"]
        run(case, "dmpFlow")
        before = times(case, "rbc")
        assert max(before) > first and stretches(case)[1] == 2
        run(case, "dmpFlow", "-restart", f"{first!r} s", "-steps", "2", *sets("system/control.yaml:/endStrain=0.2"), ranks=ranks)
        assert times(case, "rbc") == [t for t in before if t <= first], (times(case, "rbc"), before, first)
        assert stretches(case)[1] == 2  # that one, and the new one
        latest = said(case, "-steps", "1", *sets("system/control.yaml:/endStrain=0.2"))
        assert "000002.h5" in latest or "000001.h5" in latest, latest


def test_nearest(folder):
    """-restart TIME and startFrom: TIME use the checkpoint nearest before TIME; if all are later, the message lists them."""
    case = prepared(folder / "case", FLUID_CASE)
    ends = []
    for _ in range(3):
        run(case, "sphFlow", "-steps", "4", *sets("system/control.yaml:/checkpoint/keep=9"))
        ends.append(json.loads((case / "run.json").read_text())["result"]["time_s"])
    def chosen(wanted, *options):
        done = subprocess.run([str(BIN / "sphFlow"), "-case", str(case), "-dry-run", *options], capture_output=True, text=True)
        assert done.returncode == 0, done.stderr
        assert ("nearest before" in done.stdout) == (wanted not in ends), done.stdout
        return re.search(r"Restart from \S*/(\d+)\.h5", done.stdout).group(1)
    for wanted, number in ((ends[0], "000000"), (ends[1], "000001"), (1.3 * ends[1], "000001"), (0.999 * ends[1], "000000"), (10 * ends[2], "000002")):
        assert chosen(wanted, "-restart", f"{wanted!r} s") == number, wanted
        assert chosen(wanted, *sets(f"system/control.yaml:/startFrom={wanted!r} s")) == number, wanted
    for ranks in (1, 2):
        for option in (("-restart", f"{0.5 * ends[0]!r} s"), sets(f"system/control.yaml:/startFrom={0.5 * ends[0]!r} s"), ("-restart", "1 ns")):
            found = unchanged(case, "sphFlow", *option, code=4, ranks=ranks).stderr
            assert "there is no checkpoint at " in found and found.count(" ms") + found.count(" us") >= 3 and "firstTime" in found, found
    assert "latestTime" in unchanged(case, "sphFlow", "-restart", "latestTim", code=1).stderr


def test_refused(folder):
    """A rejected command changes no file: no log is truncated, and no record or mesh is written."""
    case = prepared(folder / "case", CASE)
    run(case, "dmpFlow", "-steps", "3")
    bad = sets("system/numerics.yaml:/spacng=1 um")
    for application in ("dmpFlow", "membraneMesh", "particleFill", "checkMesh", "checkCase", "sphFlow"):
        unchanged(case, application, *bad, code=2)
        unchanged(case, application, "-nonsense", code=1)
    unchanged(case, "sphFlow", code=2)  # a case with cells
    unchanged(case, "dmpFlow", "-restart", "1 ns", code=4)
    unchanged(case, "dmpFlow", "-restart", "soon", code=1)
    unchanged(case, "dmpFlow", *sets("system/numerics.yaml:/kernel=lucy"), code=2)
    unchanged(case, "dmpFlow", *sets("system/numerics.yaml:/kernel=lucy"), code=2, ranks=2)
    unchanged(case, "dmpFlow", "-dry-run", code=0)
    unchanged(case, "dmpFlow", "-dry-run", code=0, ranks=2)
    unchanged(case, "dmpFlow", "-dry-run", *sets("system/control.yaml:/startFrom=firstTime"), code=0)
    unchanged(case, "checkCase", code=0)
    other = "system/numerics.yaml:/skin=0.4 dx"
    for application in ("checkCase", "dmpFlow"):  # both detect that the checkpoint was made with another setting
        assert "skin" in unchanged(case, application, *sets(other), code=2).stderr
    unchanged(case, "checkCase", *sets(other, "system/control.yaml:/startFrom=firstTime"), code=0)
    unchanged(case, "particleFill", *sets("system/mesh.yaml:/cells/0/centre=[1 um, 0 um, 0 um]"), code=2)  # of another mesh
    # A run that fails keeps its reason in the log.
    diverging = sets("constant/fluid.yaml:/equationOfState={type: tait, soundSpeed: 1e-6 m/s}", "constant/flow.yaml:/Ca=2",
                     "system/control.yaml:/endStrain=20", "system/numerics.yaml:/rollbacks=0")
    reason = run(case, "dmpFlow", *diverging, code=3).stderr.strip()
    assert reason and reason in (case / "log.dmpFlow").read_text(), reason
    # membraneRelax
    relax = make(folder / "relax", {"system/relax.yaml": "cell: {name: rbc, shape: {type: sphere, radius: 3 um}, edge: 1 um}\n"
                                    "protocol: {type: inflation, pressures: [1 Pa, 2 Pa]}\n",
                                    "constant/membranes.yaml": "rbc:\n  triangles: {type: skalak, Gs: 4 uN/m, C: 1}\n  bending: {type: dihedral, Eb: 0.01}\n"})
    run(relax, "membraneRelax")
    unchanged(relax, "membraneRelax", *sets("system/relax.yaml:/celll=1"), code=2)
    unchanged(relax, "membraneRelax", code=1, ranks=2)


def test_logs(folder):
    """The log of a continued run is continued; a new start begins a new log."""
    case = prepared(folder / "case", CASE)
    log = case / "log.dmpFlow"
    run(case, "dmpFlow", "-steps", "4")
    first = log.read_text()
    assert "continued" not in first and first.startswith("dmpFlow "), first
    run(case, "dmpFlow", "-steps", "4", ranks=2)
    second = log.read_text()
    assert second.startswith(first) and re.search(r"\n==== continued 20\S+Z by: dmpFlow .*-steps 4\n", second), second
    assert second.count("Restart from") == 1 and second.count("Stopped") + second.count("End after") == 2, second
    run(case, "dmpFlow", "-steps", "4")
    assert log.read_text().startswith(second) and log.read_text().count("==== continued") == 2
    run(case, "dmpFlow", "-steps", "4", *sets("system/control.yaml:/startFrom=firstTime"))
    assert "continued" not in log.read_text() and len(log.read_text()) < len(second)


def test_lock(folder):
    """Only one program at a time writes in a case; the lock of a killed one is taken over; no lock remains after normal ends, failures and signals."""
    case = prepared(folder / "case", {**CASE, "system/control.yaml": CASE["system/control.yaml"].replace("0.03", "50")})
    lock = case / "case.lock"
    def start(ranks=1, application="dmpFlow"):
        command = [str(BIN / application), "-case", str(case), "-quiet"]
        process = started(*(["mpirun", "--oversubscribe", "-np", str(ranks)] if ranks > 1 else []), *command)
        deadline = time.time() + 60
        while not (case / "results/fluid.pvd").exists() or not lock.exists():
            assert time.time() < deadline and process.poll() is None
            time.sleep(0.05)
        return process
    for ranks, number in ((1, signal.SIGTERM), (2, signal.SIGUSR1)):
        shutil.rmtree(case / "results", ignore_errors=True)
        first = start(ranks)
        kept = {name: (case / name).read_text() for name in ("run.json", "log.dmpFlow")}
        for application in ("dmpFlow", "membraneMesh", "particleFill"):
            found = run(case, application, code=4).stderr
            assert re.search(r"dmpFlow, process \d+ on host \S+, since 20\S+Z is at work in this case", found), found
        found = run(case, "dmpFlow", code=4, ranks=2).stderr
        assert found.count("is at work in this case") == 1, found
        run(case, "dmpFlow", "-dry-run")  # writes nothing
        run(case, "checkCase")
        begun = lambda text: [json.loads(text)[key] for key in ("application", "status", "start", "parameters")]  # the rest changes during the run
        assert first.poll() is None and begun((case / "run.json").read_text()) == begun(kept["run.json"])
        assert (case / "log.dmpFlow").read_text().startswith(kept["log.dmpFlow"])
        # A copy of a running case is a case of its own.
        twin = folder / f"twin{ranks}"
        shutil.copytree(case, twin, ignore=shutil.ignore_patterns("results", "postProcessing", "checkpoints", "*.tmp"))
        run(twin, "particleFill")
        assert "was copied along with the case" in (twin / "log.particleFill").read_text() and not (twin / "case.lock").exists()
        first.send_signal(number)
        assert first.wait(timeout=120) == 5
        assert not lock.exists()
    shutil.rmtree(case / "results")
    killed = start()
    killed.send_signal(signal.SIGKILL)
    killed.wait()
    assert lock.exists()
    text = said(case, "-steps", "1")
    assert "is stale (that process has ended without removing it) and is taken over" in text and not lock.exists(), text
    # Invalid case, diverged run, and a signal before the first step.
    run(case, "dmpFlow", *sets("system/numerics.yaml:/kernel=lucy"), code=2)
    assert not lock.exists()
    diverging = sets("constant/fluid.yaml:/equationOfState={type: tait, soundSpeed: 1e-6 m/s}", "constant/flow.yaml:/Ca=2", "system/numerics.yaml:/rollbacks=0",
                     "system/control.yaml:/startFrom=firstTime")
    for ranks in (1, 2):
        run(case, "dmpFlow", *diverging, code=3, ranks=ranks)
        assert not lock.exists(), ranks
    fine = make(folder / "fine", {**CASE, "system/mesh.yaml": CASE["system/mesh.yaml"].replace("0.8 um", "0.1 um")})
    for attempt in range(10):  # some of the signals arrive while the file is being written
        process = started(str(BIN / "membraneMesh"), "-case", str(fine), "-quiet")
        deadline = time.time() + 30
        while not (fine / "case.lock").exists() and process.poll() is None and time.time() < deadline:
            time.sleep(0.0005 * attempt)
        process.send_signal(signal.SIGTERM)
        assert process.wait(timeout=60) == -signal.SIGTERM and not (fine / "case.lock").exists(), attempt
    # A lock of another host is respected; the message says what to do.
    lock.write_text("program: dmpFlow\nprocess: 4711\nhost: node17\nboot: another\nsince: 2026-11-25T01:02:03Z\n")
    for application, code in (("dmpFlow", 4), ("membraneMesh", 4), ("particleFill", 4), ("checkMesh", 0)):
        found = unchanged(case, application, code=code).stderr
        assert code == 0 or ("process 4711 on host node17" in found and f"remove {lock}" in found), found


def test_finished(folder):
    """A finished case reports this and how to continue, with exit code 0, and changes no file; it continues if its end is raised, or starts anew."""
    case = prepared(folder / "case", CASE)
    run(case, "dmpFlow")
    for options, ranks in (((), 1), (("-steps", "5"), 1), ((), 2)):
        unchanged(case, "dmpFlow", *options, code=0, ranks=ranks)
    text = said(case)
    for part in ("The case is finished: endStrain 0.03 is reached", "Nothing was changed", "raise 'endStrain' in system/control.yaml", "startFrom=firstTime"):
        assert part in text, text
    assert json.loads(run(case, "dmpFlow", "-json").stdout)["status"] == "finished"
    assert "End after" in said(case, *sets("system/control.yaml:/endStrain=0.04"))
    unchanged(case, "dmpFlow", *sets("system/control.yaml:/endStrain=0.04"), code=0)
    assert "End after" in said(case, *sets("system/control.yaml:/startFrom=firstTime"))
    # Killed, or out of disk space, between the last checkpoint and the end: what was left to do is made up for.
    for status, ranks in (("running", 1), ("failed", 2)):
        record, last = json.loads((case / "run.json").read_text()), last_checkpoint(case)
        del record["result"]
        (case / "run.json").write_text(json.dumps({**record, "status": status}))
        leftovers = [case / "run.json.4711.tmp", case / "checkpoints/.000009.h5.part", case / "checkpoints/.000009.h5.part.data.1"]
        for path in leftovers:
            path.write_text("{")
        run(case, "dmpFlow", ranks=ranks)
        again = json.loads((case / "run.json").read_text())
        assert again["status"] == "done" and again["performance"]["steps"] == 0 and again["result"]["strain"] >= 0.03, again["status"]
        assert last_checkpoint(case) == last and not any(path.exists() for path in leftovers)
        assert ranks > 1 or again["observers"] == record["observers"], (again["observers"], record["observers"])
        unchanged(case, "dmpFlow", code=0, ranks=ranks)
    fluid = prepared(folder / "fluid", {**FLUID_CASE, "system/control.yaml": "application: sphFlow\nendTime: 2 ms\n"})
    run(fluid, "sphFlow")
    unchanged(fluid, "sphFlow", code=0)
    unchanged(fluid, "sphFlow", *sets("system/control.yaml:/endTime=1 ms"), code=0)


if __name__ == "__main__":
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as temporary:
        globals()["test_" + sys.argv[2]](pathlib.Path(temporary))
    print("passed")
