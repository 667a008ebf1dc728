#!/usr/bin/env python3
"""Cells that meet: each other, rigid bodies, walls, their own periodic images; at the start (exit code 2) and during a run (3).

    meetingRuns.py BIN TEST    BIN: directory of the applications
"""
import itertools
import json
import math
import pathlib
import re
import shutil
import sys
import tempfile

sys.path.append(str(pathlib.Path(__file__).resolve().parent))
from runs import CELL_CASE, IMPLICIT_CASE, make, run, table

SPHERE = "{{name: {}, membrane: rbc, shape: {{type: sphere, radius: {} um}}, edge: {} um, enclose: surface, centre: [{} um, {} um, {} um]}}"
BOX = "domain: {size: [16 um, 12 um, 12 um], periodic: [true, true, false]}\n"


def sphere(name, radius, *centre, edge=1):
    return SPHERE.format(name, radius, edge, *centre)


def started(folder, mesh, code, *said, files=IMPLICIT_CASE, ranks=(1, 2), **changes):
    """Runs membraneMesh, then all programs that must reject (2) or accept (0) its result; the messages of those that reject contain `said`."""
    case = make(folder, files, **{"system/mesh.yaml": mesh, "system/observers.yaml": "balance: {type: conservation, every: 0.5 strain}\n", **changes})
    run(case, "membraneMesh")
    fill = run(case, "particleFill", code=code).stderr
    check = run(case, "checkMesh", code=code).stderr
    for words in said:
        assert words in fill, (words, fill)
        assert words in check, (words, check)
    if code == 0:
        for n in ranks:
            run(case, "dmpFlow", "-steps", "1", ranks=n)
            for name in ("results", "postProcessing", "checkpoints"):
                shutil.rmtree(case / name, ignore_errors=True)
    return case


def test_pairs(folder):
    """Pairs of cells: apart, touching, overlapping, one inside the other, and through periodic faces; in two orders and orientations."""
    cells = lambda *all: BOX + "cells: [" + ", ".join(all) + "]\n"
    started(folder / "apart", cells(sphere("a", 2.5, -3, 0, 0), sphere("b", 2.5, 3, 0, 0)), 0)
    started(folder / "apartAcross", cells(sphere("a", 2.5, 6, 0, 0), sphere("b", 2.5, -4, 0, 0)), 0)
    both = "the cell 'a' and the cell 'b' "
    started(folder / "touching", cells(sphere("a", 2.5, -2.5, 0, 0), sphere("b", 2.5, 2.5, 0, 0)), 2,
            "system/mesh.yaml:2:", "cells[1].centre: " + both + "touch at (", "have to be clear of each other at the start")
    for name, at, depth in (("x", (3.5, 0, 0), 1.5), ("y", (0, -4, 0), 1), ("z", (-1, 1, 3), 1.68)):
        case = started(folder / ("overlapping" + name), cells(sphere("a", 2.5, 0, 0, -1), sphere("b", 2.5, *at[:2], at[2] - 1)), 2, both + "overlap at (")
        found = float(re.search(r"by up to ([\d.]+) um", run(case, "checkMesh", code=2).stderr)[1])
        assert abs(found - depth) < 0.25, (found, depth)
    started(folder / "inside", cells(sphere("a", 4, 0, 0, 0), sphere("b", 1.5, 1, 0, 0, edge=0.7)), 2, "the cell 'b' lies inside the cell 'a'")
    started(folder / "around", cells(sphere("a", 1.5, 1, 0, 0, edge=0.7), sphere("b", 4, 0, 0, 0)), 2, "the cell 'a' lies inside the cell 'b'")
    started(folder / "through", cells(sphere("a", 2.5, 6, 0, 0), sphere("b", 2.5, -6, 1, 0)), 2, both + "overlap at (", "through the periodic boundary")
    started(folder / "throughCorner", cells(sphere("a", 2.5, 6.5, 4.5, 0), sphere("b", 2.5, -6.5, -4.5, 0)), 2, both + "overlap at (")
    started(folder / "insideImage", cells(sphere("a", 4, 8, 0, 0), sphere("b", 1.5, -8, 0, 0, edge=0.7)), 2, "the cell 'b' lies inside the cell 'a', through")
    started(folder / "dual", cells(sphere("a", 2.5, -2, 0, 0), sphere("b", 2.5, 2, 0, 0)), 2, both + "overlap at (", files=CELL_CASE)


def test_others(folder):
    """Bodies, walls and the cell's own image."""
    cell, bodies = sphere("a", 3, 0, 0, 0), "constant/bodies.yaml"
    bead = lambda x, r: BOX + f"cells: [{cell}]\nbodies: [{{name: bead, shape: {{type: sphere, radius: {r} um}}, edge: 0.7 um, centre: [{x} um, 0 um, 0 um]}}]\n"
    free = {bodies: "bead: {motion: free}\n"}
    started(folder / "within", bead(0.3, 1.5), 0, **free)
    started(folder / "beside", bead(6, 1.5), 0, **free)
    started(folder / "crossing", bead(3, 1.5), 2, "the cell 'a' and the body 'bead' overlap at (", "bodies[0].centre", **free)
    started(folder / "crossingImage", bead(-11.5, 2), 2, "the cell 'a' and the body 'bead' overlap at (", "through", **free)
    started(folder / "holding", BOX + "cells: [" + sphere("a", 1.2, 0, 0, 0, edge=0.5) + "]\nbodies: [{name: bead, shape: {type: sphere, radius: 3 um}, edge: 0.9 um}]\n", 2,
            "the cell 'a' lies inside the body 'bead'", **free)
    wall = make(folder / "wall", IMPLICIT_CASE, **{"system/mesh.yaml": BOX + "cells: [" + sphere("a", 3, 0, 0, 4) + "]\n"})
    assert "reaches through the wall along z" in run(wall, "membraneMesh", code=2).stderr
    # A rod that is longer than the box.
    rod = BOX + "cells: [{name: a, membrane: rbc, shape: {type: spheroid, a: 1.5 um, c: 9.5 um}, edge: 0.7 um, axis: [1, 0, 0]}]\n"
    long = make(folder / "long", CELL_CASE, **{"system/mesh.yaml": rod, "system/observers.yaml": ""})
    run(long, "membraneMesh")
    for program in ("particleFill", "checkMesh"):
        said = run(long, program, code=2).stderr
        assert re.search(r"system/mesh.yaml:2:\d+: cells\[0\].shape: the cell .a. is [\d.]+ um long along x, longer than the box, which is periodic with 16 um", said), said


RED = "{{name: {}, membrane: rbc, shape: {{type: kuchelFackerell, d: 8 um, h: 2.12 um, b: 1 um}}, edge: 0.7 um, centre: [{} um, 0 um, {} um]}}"
NUMERICS = IMPLICIT_CASE["system/numerics.yaml"].replace("precision: double", "precision: mixed").replace("tolerance: 1e-5", "tolerance: 3e-3")
TWO = {  # red cells that meet at strain 3.4, and cross unless a contact law keeps them apart
    **IMPLICIT_CASE,
    "system/mesh.yaml": "domain: {size: [20 um, 12 um, 16 um], periodic: [true, true, false]}\ncells: [" + RED.format("a", -4.4, 0.4) + ", " + RED.format("b", 4.4, -0.4) + "]\n",
    "system/numerics.yaml": NUMERICS.replace("spacing: 1 um", "spacing: 0.6667 um"),
    "system/control.yaml": IMPLICIT_CASE["system/control.yaml"].replace("endStrain: 0.6", "endStrain: 8"),
    "system/observers.yaml": "balance: {type: conservation, every: 0.5 strain}\n",
    "constant/membranes.yaml": "rbc:\n  bonds: {type: harmonic, k: 5e-4 N/m}\n  bending: {type: dihedral, Eb: 0.01}\n",
    "constant/flow.yaml": "type: shear\nCa: 0.02\ninertia: {Re: 0.1}\n"}
CONTACT = "law: {type: barrier, reach: 0.15 um, strength: 1e-5 N/m}\n"


def test_during(folder):
    """Cells that meet during a run: immediate exit with code 3, on 1 and 2 ranks, with a checkpoint from before."""
    case = make(folder / "shear", TWO)
    ready(case)
    run(case, "dmpFlow", "-set", "system/control.yaml:/endStrain=2.5", ranks=2)
    for ranks in (1, 2):
        copy = folder / f"shear{ranks}"
        shutil.copytree(case, copy)
        met(copy, "the cells 'a' and 'b' touch or cross at (", ranks)

    # The cell is moved between two steps: into a wall, into its own image.
    injected = {"system/numerics.yaml": NUMERICS.replace("spacing: 1 um", "spacing: 0.8 um"), "system/observers.yaml": "",
                "system/mesh.yaml": "domain: {size: [8 um, 8 um, 8 um], periodic: [true, true, false]}\ncells: [" + sphere("a", 3.2, 0, 0, 0) + "]\n"}
    short = make(folder / "short", IMPLICIT_CASE, **injected)
    ready(short)
    for kind, words in (("wall", "the cell 'a' crosses the upper wall at ("), ("image", "the cell 'a' touches or crosses its own periodic image at (")):
        for ranks in (1, 2):
            copy = folder / f"{kind}{ranks}"
            shutil.copytree(short, copy)
            met(copy, words, ranks, "faultInjection", "-kind", kind, "-at", "5")


def test_contact(folder):
    """The cells of test_during with contact: they never cross, on 1, 2 and 4 ranks alike, and the energy of contact is in the budget."""
    case = make(folder / "contact", TWO, **{"constant/contact.yaml": CONTACT, "system/observers.yaml": "balance: {type: conservation, every: 0.5 strain}\nform: {type: shape, every: 0.5 strain}\n"})
    ready(case)
    forms = {}
    for ranks in (1, 2, 4):
        copy = folder / f"contact{ranks}"
        shutil.copytree(case, copy)
        run(copy, "dmpFlow", "-set", "system/control.yaml:/endStrain=5", ranks=ranks)
        record = json.loads((copy / "run.json").read_text())
        assert record["performance"]["rollbacks"] == 0 and record["performance"]["halvings"] <= 2, record["performance"]
        budget = table(copy, "balance", "budget.csv")[-1]
        assert abs(budget["residualShare"]) < 2e-3, budget
        forms[ranks] = [row for kind in ("a", "b") for row in table(copy, "form", kind + ".csv")]
    for ranks in (2, 4):
        for one, other in zip(forms[1], forms[ranks], strict=True):
            assert abs(one["D12_inertia"] - other["D12_inertia"]) < 2e-3, (ranks, one, other)

    (case / "constant/contact.yaml").write_text(CONTACT.replace("0.15", "0.4"))
    said = run(case, "dmpFlow", code=2).stderr
    assert "contact.yaml:1:29: law.reach: reach and thickness are 400 nm together; with the mesh of cell 'a' at most" in said, said

    def refused(words, **changes):
        said = run(make(folder / "refused", {**TWO, "constant/contact.yaml": CONTACT}, **changes), "membraneMesh", code=2).stderr
        assert words in said, said

    refused("integrator: found velocityVerlet, which knows no contact of membranes; write 'integrator: implicit'",
            **{"system/numerics.yaml": TWO["system/numerics.yaml"].replace("integrator: implicit", "integrator: velocityVerlet").replace("implicit: {step: 0.05, tolerance: 3e-3, error: 1}\n", "")})
    refused("system/mesh.yaml has no cells; remove the file, or name cells", **{
        "system/mesh.yaml": "domain: {size: [8 um, 8 um, 8 um], periodic: [true, true, false]}\n", "constant/flow.yaml": "type: shear\nshearRate: 100 1/s\n", "system/observers.yaml": ""})
    refused("Did you mean 'strength'?", **{"constant/contact.yaml": "law: {type: barrier, reach: 0.15 um, strengh: 1e-5 N/m}\n"})


def ready(case):
    run(case, "membraneMesh")
    run(case, "particleFill")
    run(case, "checkMesh")


def met(case, words, ranks, application="dmpFlow", *options):
    said = run(case, application, *options, ranks=ranks, code=3).stderr
    assert said.count(words) == 1 and ", strain " in said, said
    assert "nothing but fluid keeps them apart" in said or "the box is too short for it" in said, said
    assert "take a smaller" not in said, said
    record = json.loads((case / "run.json").read_text())
    assert record["performance"]["rollbacks"] == 0 and len(record["fault"]["place_m"]) == 3, record
    assert list((case / "checkpoints").glob("*.h5")) and (case / "results/fault.pvd").exists()


def tailed(file):
    """A ball of radius 2.5 um whose upper half is stretched to 8.5 um: its tip is 7.4 um from its centroid."""
    golden = (1 + math.sqrt(5)) / 2
    nodes = [(x, y * golden, 0) for x in (-1, 1) for y in (-1, 1)]
    nodes += [(0, x, y * golden) for x, y, _ in ((a, b / golden, 0) for a, b, _ in nodes[:4])] + [(y, 0, x) for x, y, _ in nodes[:4]]
    length = math.sqrt(1 + golden**2)
    nodes = [tuple(c / length for c in n) for n in nodes]
    near = lambda a, b: abs(math.dist(a, b) - 2 / length) < 1e-9
    triangles = []
    for i, j, k in itertools.combinations(range(12), 3):
        if near(nodes[i], nodes[j]) and near(nodes[j], nodes[k]) and near(nodes[i], nodes[k]):
            u, v, w = (nodes[n] for n in (i, j, k))
            outward = sum(u[a] * (v[(a + 1) % 3] * w[(a + 2) % 3] - v[(a + 2) % 3] * w[(a + 1) % 3]) for a in range(3)) > 0
            triangles.append((i, j, k) if outward else (i, k, j))
    for _ in range(3):
        middle = {}
        def between(i, j):
            key = min(i, j), max(i, j)
            if key not in middle:
                sum_ = [a + b for a, b in zip(nodes[i], nodes[j])]
                nodes.append(tuple(c / math.hypot(*sum_) for c in sum_))
                middle[key] = len(nodes) - 1
            return middle[key]
        triangles = [t for i, j, k in triangles for a, b, c in [(between(i, j), between(j, k), between(k, i))]
                     for t in ((i, a, c), (a, j, b), (c, b, k), (a, b, c))]
    placed = [(2.5 * x, 2.5 * y, 2.5 * z * (1 + 2.4 * z**3 if z > 0 else 1)) for x, y, z in nodes]
    lines = [f"OFF\n{len(placed)} {len(triangles)} 0"] + [" ".join(f"{c:.9f}" for c in x) for x in placed] + [f"3 {i} {j} {k}" for i, j, k in triangles]
    file.write_text("\n".join(lines) + "\n")


def test_tailed(folder):
    """A cell whose tip is more than half a box from its centroid has the same particles inside as in a longer box, for particleFill, checkMesh, observers."""
    inside = {}
    numerics = {"immersed": IMPLICIT_CASE["system/numerics.yaml"].replace("spacing: 1 um", "spacing: 0.5 um"),
                "dual": CELL_CASE["system/numerics.yaml"].replace("spacing: 1 um", "spacing: 0.5 um")}
    for name, coupling, size, axis, centre in (("x12", "immersed", (12.5, 8, 8), "[1, 0, 0]", (0, 0)), ("x18", "immersed", (18.5, 8, 8), "[1, 0, 0]", (0, 0)),
                                               ("xEdge", "immersed", (12.5, 8, 8), "[1, 0, 0]", (5, 3)), ("y12", "immersed", (8, 12.5, 8), "[0, -1, 0]", (0, 0)),
                                               ("xy", "immersed", (10, 10, 8), "[1, 1, 0]", (1, -4)), ("x12dual", "dual", (12.5, 8, 8), "[1, 0, 0]", (0, 0)),
                                               ("x18dual", "dual", (18.5, 8, 8), "[1, 0, 0]", (0, 0))):
        mesh = (f"domain: {{size: [{size[0]} um, {size[1]} um, {size[2]} um], periodic: [true, true, false]}}\n"
                f"cells: [{{name: rbc, shape: {{type: file, file: tailed.off}}, edge: 0.5 um, centre: [{centre[0]} um, {centre[1]} um, 0 um], axis: {axis}}}]\n"
                "fill: {jitter: 0}\n")
        case = make(folder / name, IMPLICIT_CASE, **{"system/mesh.yaml": mesh, "system/numerics.yaml": numerics[coupling],
                                                     "system/observers.yaml": "balance: {type: conservation, every: 0.01 strain}\n"})
        tailed(case / "tailed.off")
        run(case, "membraneMesh")
        run(case, "particleFill")
        sides = json.loads(run(case, "checkMesh", "-json").stdout)["sides"]
        assert sides["wrong"] == 0 and sides["differ"] == 0, sides
        inside[name] = sides["inside"]["rbc"]
        assert abs(inside[name] / sides["expected"]["rbc"] - 1) < 0.03, (name, sides)
    assert inside["x12"] == inside["x18"] and inside["x12dual"] == inside["x18dual"], inside
    # The observer agrees with the sides of the particles, and the solver does not move the particles in the tail.
    for ranks in (1, 2):
        run(folder / "x12", "dmpFlow", "-steps", "2", ranks=ranks, code=0)
        rows = table(folder / "x12", "balance")
        sides = [float(value) for row in rows for name, value in row.items() if name.startswith("changedSide")]
        assert sides and max(sides) == 0, rows
        for name in ("results", "postProcessing", "checkpoints"):
            shutil.rmtree(folder / "x12" / name, ignore_errors=True)


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as temporary:
        globals()["test_" + sys.argv[2]](pathlib.Path(temporary))
    print("passed")
