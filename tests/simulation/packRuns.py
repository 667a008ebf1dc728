#!/usr/bin/env python3
"""Cells placed by cellPack: its tables, the programs that follow, and input that is rejected.

    packRuns.py BIN TEST    BIN: directory of the applications
"""
import csv
import json
import math
import pathlib
import sys
import tempfile

sys.path.append(str(pathlib.Path(__file__).resolve().parent))
from runs import IMPLICIT_CASE, make, run, table

RED = "{name: red, cell: healthyRBC, edge: 0.9 um, table: constant/red.csv}"
BEAD = "{name: bead, membrane: red, shape: {type: sphere, radius: 1.2 um}, edge: 0.6 um, table: constant/bead.vtp}"
BOX = "domain: {size: [16 um, 16 um, 16 um], periodic: [true, true, false]}\n"
MESH, PACK = "system/mesh.yaml", "system/pack.yaml"
FILES = {**IMPLICIT_CASE, MESH: BOX + f"cells: [{RED}]\n", PACK: "cells: [{name: red, haematocrit: 0.3}]\ngap: 0.3 um\n",
         "system/observers.yaml": "balance: {type: conservation, every: 0.1 strain}\n"}
del FILES["constant/membranes.yaml"]
LAW = {"constant/membranes.yaml": "red:\n  triangles: {type: skalak, Gs: 5e-6 N/m, C: 1}\n"}


def rows(path):
    return [{key: float(value) for key, value in row.items()} for row in csv.DictReader(path.read_text().splitlines())]


def test_filled(folder):
    """At a haematocrit of 0.3 between walls: the number of cells, the results of the next programs, a few steps on 1 and 2 ranks."""
    case = make(folder, FILES)
    said = json.loads(run(case, "cellPack", "-json").stdout)
    cells = rows(case / "constant/red.csv")
    assert len(cells) == said["red"]["number"] == round(0.3 * 16**3 / 94.09), said
    assert abs(said["red"]["haematocrit"] - 0.3) < 0.5 * 94.1 / 16**3
    for cell in cells:
        assert abs(math.hypot(cell["axis_x"], cell["axis_y"], cell["axis_z"]) - 1) < 1e-9
        assert all(-8 <= cell[key] < 8 for key in ("x_um", "y_um", "z_um")) and cell["scale"] == 1
    run(case, "membraneMesh")
    run(case, "particleFill")
    assert json.loads(run(case, "checkMesh", "-json").stdout)
    for ranks in (1, 2):
        run(case, "dmpFlow", "-steps", "2", "-set", "system/control.yaml:/startFrom=firstTime", ranks=ranks)
        assert max(row["volumeChange"] for row in table(case, "balance", "conservation.csv")) < 1e-6


def test_mixed(folder):
    """Two types, one of them aligned, beside a rigid body and a cell with places of their own; the same result for the same seed."""
    fixed = "{name: still, membrane: red, shape: {type: sphere, radius: 2 um}, edge: 0.9 um, centre: [7 um, 7 um, -5 um]}"
    body = "bodies: [{name: rod, shape: {type: sphere, radius: 2 um}, edge: 0.9 um, centre: [-7.5 um, -7.5 um, 5 um]}]\n"
    case = make(folder, FILES, **LAW, **{
        MESH: BOX + f"cells: [{RED.replace('cell: healthyRBC', 'shape: {type: evansFung}')}, {fixed}, {BEAD}]\n" + body,
        "constant/bodies.yaml": "rod: {motion: free}\n",
        PACK: "cells:\n  - {name: bead, number: 20}\n  - {name: red, number: 7, orientation: {type: aligned, axis: [0, 3, 0]}}\ngap: 0.3 um\n"})
    run(case, "cellPack")
    red, bead = ((case / f"constant/{name}").read_bytes() for name in ("red.csv", "bead.vtp"))
    cells = rows(case / "constant/red.csv")
    assert len(cells) == 7 and all((cell["axis_x"], cell["axis_y"], cell["axis_z"]) == (0, 1, 0) for cell in cells)
    run(case, "membraneMesh")
    assert json.loads(run(case, "checkCase", "-json").stdout)
    run(case, "particleFill")
    run(case, "checkMesh")
    run(case, "cellPack")
    assert (red, bead) == tuple((case / f"constant/{name}").read_bytes() for name in ("red.csv", "bead.vtp"))
    run(case, "cellPack", "-set", "system/pack.yaml:/seed=2")
    assert red != (case / "constant/red.csv").read_bytes()


def test_refused(folder):
    """An error names what cannot be packed and its place in the file, and no table is written or changed."""
    def refused(name, *said, code=2, ranks=1, options=(), **changes):
        case = make(folder / name, FILES, **changes)
        (case / "constant/red.csv").write_text("x_um,y_um,z_um\n0,0,0\n")
        found = run(case, "cellPack", *options, code=code, ranks=ranks).stderr
        for words in said:
            assert words in found, (words, found)
        assert (case / "constant/red.csv").read_text() == "x_um,y_um,z_um\n0,0,0\n"
        return found

    pack = lambda text: {PACK: "cells:\n" + text}
    refused("unknown", "system/pack.yaml:2:12: cells[0].name: found 'rad', which is no cell of system/mesh.yaml; there are: red.",
            "Did you mean 'red'?", **pack("  - {name: rad, number: 3}\n"))
    refused("twice", "system/pack.yaml:3:12: cells[1].name: 'red' is named twice", **pack("  - {name: red, number: 3}\n  - {name: red, number: 4}\n"))
    refused("neither", "system/pack.yaml:2:5: ", "number", "haematocrit", **pack("  - {name: red}\n"))
    refused("both", "number", "haematocrit", **pack("  - {name: red, number: 3, haematocrit: 0.2}\n"))
    refused("none", "system/pack.yaml:1:8: cells: found no types", **{PACK: "cells: []\n"})
    refused("few", "system/pack.yaml:2:", "cells[0].haematocrit: found 0.001, which is 0.044 cells in this box", **pack("  - {name: red, haematocrit: 1e-3}\n"))
    for key, value in (("number", "2000000000"), ("haematocrit", "0.2")):
        refused(f"many{key}", f"cells[0].{key}: ", "of memory is needed on", "take fewer cells",
                options=("-set", "system/mesh.yaml:/domain/size=[1000 m, 1000 m, 1000 m]"), **pack(f"  - {{name: red, {key}: {value}}}\n"))
    refused("zero", "orientation.axis: found the zero vector", **pack("  - {name: red, number: 1, orientation: {type: aligned, axis: [0, 0, 0]}}\n"))
    refused("centre", "'red' has no table in system/mesh.yaml", **{MESH: BOX + "cells: [{name: red, cell: healthyRBC, edge: 0.9 um}]\n"})
    refused("ending", "system/mesh.yaml:2:", "cells[0].table: found 'constant/red.txt'", **{MESH: BOX + f"cells: [{RED.replace('.csv', '.txt')}]\n"})
    same = BEAD.replace("bead.vtp", "../constant/red.csv")
    refused("shared", "cells[1].table: found 'constant/../constant/red.csv', which is the table of 'red' too", **LAW,
            **{MESH: BOX + f"cells: [{RED.replace('cell: healthyRBC', 'shape: {type: evansFung}')}, {same}]\n",
               PACK: "cells: [{name: red, number: 1}, {name: bead, number: 1}]\n"})
    refused("missing", "system/pack.yaml", options=("-set", "system/mesh.yaml:/fill/jitter=7"), **{PACK: "cells: 3\n"})
    stuck = refused("stuck", "the cells are stuck at 0.", "of their size", code=3, **pack("  - {name: red, haematocrit: 0.75}\n"))
    assert "another seed" in stuck, stuck
    refused("ranks", "runs on one rank", code=1, ranks=2)
    absent = make(folder / "absent", FILES)
    assert "cellPack writes it" in run(absent, "membraneMesh", code=2).stderr


if __name__ == "__main__":
    with tempfile.TemporaryDirectory(prefix="packRuns-") as folder:
        globals()[f"test_{sys.argv[2]}"](pathlib.Path(folder))
