#!/usr/bin/env python3
"""checkCase fits on one screen and is correct: lines, groups, kinds of cells, warnings with their remedy, memory and disk space against a run.

    checkCaseScreen.py BIN TEST      BIN: directory of the applications
"""
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "simulation"))
from runs import BIN, BODY_CASE, CELL_CASE, FLUID_CASE, IMPLICIT_CASE, make, run

SECTIONS = ["Case", "Dimensionless groups", "Resolution", "Memory and disk", "Step and cost"]
FLUID = {**FLUID_CASE, "system/control.yaml": "application: sphFlow\nendTime: 0.05 s\nwrite: {time: 0.01 s}\n"}


def screen(case, *options):
    done = subprocess.run([BIN / "checkCase", "-case", case, *options], capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr
    # Without the lines of progress, one a second: their number is that of the machine's speed.
    return [line for line in done.stdout.splitlines() if not line.startswith("  timing: ")], done.stderr


def prepared(folder, files):
    case = make(folder, files)
    if "constant/membranes.yaml" in files or "constant/bodies.yaml" in files:
        run(case, "membraneMesh")
    run(case, "particleFill")
    return case


def test_screen(folder):
    """Every kind of case fits on the screen: 50 lines of 120 columns, groups in order, nothing about parts that the case does not have."""
    for name, files, absent in (("implicit", IMPLICIT_CASE, ("rkl2", "bodies", "membrane nodes 0", "on membranes")),
                                ("dual", CELL_CASE, ("rkl2", "bodies")), ("body", {**BODY_CASE, "constant/flow.yaml": "type: shear\nshearRate: 200 1/s\ninertia: {Re: 0.1}\n"}, ("rkl2", "cells", "membrane")),
                                ("fluid", FLUID, ("cells", "membrane", "bodies", "coupling"))):
        case = prepared(folder / name, files)
        lines, warned = screen(case)
        text = "\n".join(lines)
        assert len(lines) <= 50 and max(map(len, lines)) <= 120, f"{name}: {len(lines)} lines, {max(map(len, lines))} columns\n{text}"
        assert [line for line in lines if line in SECTIONS] == SECTIONS, text
        for word in absent:
            assert word not in text, f"{name}: '{word}' in\n{text}"
        assert lines[-1] == "Case OK." and "predicted:" in text and "limits of the step:" in text, text
        assert "edge is" not in warned and "sets the density" not in warned, warned
        found = json.loads(run(case, "checkCase", "-json").stdout)
        assert {"particles", "groups", "integrators", "memory_B", "disk_B", "limits_s", "binding", "steps", "predicted_s", "warnings"} <= set(found), found
        assert {"velocityVerlet", "rkl2", "implicit"} <= set(found["integrators"]), "-json keeps all integrators"


def test_cells(folder):
    """Sixteen cells of one type take as many lines as one cell, those of two types as many as two; the nodes are counted."""
    def cells(count, membranes):
        entries = [f"{{name: c{n}, membrane: {membranes[n % len(membranes)]}, shape: {{type: sphere, radius: 2 um}}, edge: 0.8 um, "
                   f"centre: [{6 * (n % 4) - 9} um, {6 * (n // 4) - 9} um, 0 um]}}" for n in range(count)]
        law = CELL_CASE["constant/membranes.yaml"].split("\n", 1)[1]
        files = {**IMPLICIT_CASE, "constant/membranes.yaml": "".join(f"{name}:\n{law}" for name in membranes),
                 "system/mesh.yaml": "domain: {size: [24 um, 24 um, 10 um], periodic: [true, true, false]}\ncells: [" + ", ".join(entries) + "]\n"}
        return prepared(folder / f"{count}{len(membranes)}", files)
    one, sixteen, two = (screen(cells(*given))[0] for given in ((1, ["rbc"]), (16, ["rbc"]), (16, ["rbc", "other"])))
    assert len(one) == len(sixteen), "\n".join(sixteen)
    assert len(two) <= len(one) + 3, "\n".join(two)
    text = "\n".join(screen(prepared(folder / "meshed", IMPLICIT_CASE))[0])  # the number from the mesh, without an estimate beside it
    counts = re.findall(r"(\d+) nodes", text)
    assert len(counts) > 1 and len(set(counts)) == 1 and "about" not in text, text
    assert any("16 of rbc" in line for line in sixteen) and sum("8 of" in line for line in two) == 2, "\n".join(sixteen + two)


def test_findings(folder):
    """Solute and pores are in the summary; results that are not kept take no disk; an interval shorter than the step is named; meshes that overlap are refused."""
    pores = "  pores: {type: excessArea, onset: 0.01, radius: 10 nm, resealing: 1 ms}\n"
    files = {**IMPLICIT_CASE, "constant/membranes.yaml": IMPLICIT_CASE["constant/membranes.yaml"].rstrip("\n") + "\n" + pores,
             "constant/fluid.yaml": IMPLICIT_CASE["constant/fluid.yaml"] + "solute: {concentration: 2 kg/m^3}\n"}
    plain, case = make(folder / "plain", IMPLICIT_CASE), make(folder / "pores", files)
    lines = [" ".join(line.split()) for line in screen(case)[0]]
    assert any(line.startswith("solute 2 kg/m^3") for line in lines) and any(line.startswith("pores excessArea: ") and "radius 1e-08 m" in line for line in lines), lines
    assert not any("solute" in line or "pores" in line for line in screen(plain)[0])

    def disk(*options):
        return json.loads(run(plain, "checkCase", "-json", *options).stdout)["results_B"]
    many, few = (disk("-set", f"system/control.yaml:/write={{strain: 0.01, keep: {keep}}}") for keep in ("all", 2))
    assert disk("-set", "system/control.yaml:/write={strain: 0.01, keep: 1000000}") == many and few < many / 2, (few, many)

    every = "system/observers.yaml:/deformation={type: shape, every: EVERY}"
    for interval, warns in (("1e-9 strain", True), ("1 fs", True), ("1 strain", False), ("1 steps", False)):
        lines, warned = screen(plain, "-set", every.replace("EVERY", interval))
        text = " ".join(" ".join(lines).split())
        assert ("note: system/observers.yaml: deformation.every: an interval of" in text and "one row for each step" in text) == warns, (interval, text)
        assert "deformation.every" not in warned, warned

    mesh = ("domain: {size: [24 um, 12 um, 12 um], periodic: [true, true, false]}\ncells: [{name: rbc, shape: {type: sphere, radius: 3 um}, edge: 1 um, "
            "places: [{centre: [-4 um, 0 um, 0 um]}, {centre: [4 um, 0 um, 0 um]}]}]\n")
    two = make(folder / "two", {**IMPLICIT_CASE, "system/mesh.yaml": mesh})
    run(two, "membraneMesh")
    assert screen(two)[0][-1] == "Case OK."
    (two / "system/mesh.yaml").write_text(mesh.replace("[-4 um", "[1 um"))  # after membraneMesh
    refused = [subprocess.run([BIN / program, "-case", two], capture_output=True, text=True) for program in ("particleFill", "checkCase")]
    assert all(done.returncode == 2 and "overlap" in done.stderr for done in refused), [done.stderr for done in refused]


def test_warnings(folder):
    """Edges much longer or shorter than the spacing, a density that follows only from Re, entries without a cell, and steps longer than the flow takes to change:
    one warning each, with the text to write."""
    case = make(folder, IMPLICIT_CASE)
    assert "edge is" not in screen(case)[1]
    for edge, words in (("0.08 dx", ("edge is 0.08 dx", "156 nodes for each particle")), ("0.4 um", ("edge is 0.4 dx",)),
                        ("1.9 dx", ("edge is 1.9 dx", "do not hold them back"))):
        warned = screen(case, "-set", f"system/mesh.yaml:/cells/0/edge={edge}")[1]
        assert all(word in warned for word in (*words, "edge: 1 dx", "system/mesh.yaml")), warned
    for changes, words in ((("Ca=1e-4",), ("sets the density to", "inertia: physical", "1/s")), (("Ca=30000",), ("sets the density to",)),
                           (("Ca=0.3", "inertia={Re: 500}"), ("sets the density to",))):
        warned = screen(case, *(word for change in changes for word in ("-set", f"constant/flow.yaml:/{change}")))[1]
        assert all(word in warned for word in words), warned
    assert "sets the density" not in screen(case, "-set", "constant/flow.yaml:/inertia=physical", "-set", "constant/flow.yaml:/Ca=1e-4")[1]
    laws = IMPLICIT_CASE["constant/membranes.yaml"]
    assert "takes this entry" not in screen(case)[1]
    for name in ("foo", "RBC", "healthyRBC"):  # an entry that no cell uses: changes in it would have no effect
        (case / "constant" / "membranes.yaml").write_text(laws + "\n" + laws.replace("rbc:", name + ":", 1))
        warned = screen(case)[1]
        assert all(word in warned for word in (f"constant/membranes.yaml: {name}: no cell", "they take rbc", "'membrane'")), warned
    (case / "constant" / "membranes.yaml").write_text(laws)
    sine = "-set", "constant/flow.yaml:/drive={type: sine, frequency: 10 kHz}", "-set", "constant/flow.yaml:/inertia=physical"
    assert "do not follow" not in screen(case, *sine, "-set", "system/numerics.yaml:/implicit={tolerance: 1e-4}")[1]  # steps that are not written are shortened
    for step, warns in ((0.5, True), (1e-6, False)):
        warned = screen(case, *sine, "-set", f"system/numerics.yaml:/implicit/step={step}")[1]
        assert all(word in warned for word in ("system/numerics.yaml: implicit: ", "do not follow", "implicit.step at most")) == warns, warned


def peak(case, application):
    """Peak memory of a run [B]."""
    process = subprocess.Popen([BIN / application, "-case", case, "-quiet"])
    _, status, usage = os.wait4(process.pid, 0)
    assert status == 0, status
    return 1024 * usage.ru_maxrss


def test_size(folder):
    """Memory within 20 % of what a run takes, for small cases, where the program itself takes the larger part; a checkpoint within 30 %, and so the
    results of a flow that is not at rest."""
    sanitized = b"libasan" in subprocess.run(["ldd", BIN / "dmpFlow"], capture_output=True).stdout
    small = {"system/control.yaml": "application: dmpFlow\nendStrain: 0.3\nwrite: {strain: 0.05}\ncheckpoint: {wallClock: never, keep: 1}\n"}
    finer = {"system/numerics.yaml": IMPLICIT_CASE["system/numerics.yaml"].replace("spacing: 1 um", "spacing: 0.5 um"),
             "system/mesh.yaml": IMPLICIT_CASE["system/mesh.yaml"].replace("edge: 1 um", "edge: 0.6 um")}
    short = {"system/control.yaml": small["system/control.yaml"].replace("endStrain: 0.3", "endStrain: 0.1")}
    places = ", ".join(f"{{centre: [{x} um, {y} um, {z} um]}}" for x in (-6, 6) for y in (-6, 6) for z in (-6, 6))
    cells = {"system/mesh.yaml": "domain: {size: [24 um, 24 um, 24 um], periodic: [true, true, false]}\n"  # nodes take a third of the memory
             f"cells: [{{name: rbc, shape: {{type: sphere, radius: 4 um}}, edge: 0.5 um, places: [{places}]}}]\n"}
    for name, files, application in (("fluid", {**FLUID, "system/numerics.yaml": FLUID["system/numerics.yaml"].replace("62.5", "31.25")}, "sphFlow"),
                                     ("implicit", {**IMPLICIT_CASE, **finer, **small}, "dmpFlow"),
                                     ("cells", {**IMPLICIT_CASE, **cells, **short}, "dmpFlow")):
        case = prepared(folder / name, files)
        predicted = json.loads(run(case, "checkCase", "-json").stdout)
        measured = peak(case, application)
        assert sanitized or abs(predicted["memory_B"] / measured - 1) < 0.2, f"{name}: {predicted['memory_B']:.3g} B of {measured:.3g}"
        (checkpoint,) = (case / "checkpoints").glob("*.h5")
        results = sum(path.stat().st_size for path in (case / "results").rglob("*.vtp"))
        for part, size in (("checkpoint_B", checkpoint.stat().st_size), ("results_B", results)):
            most = 2 if name == "fluid" else 0.3  # a fluid at rest compresses well
            assert -0.3 < predicted[part] / size - 1 < most, f"{name}: {part} {predicted[part]:.3g} of {size:.3g}"


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as folder:
        globals()["test_" + sys.argv[2]](pathlib.Path(folder))
