#!/usr/bin/env python3
"""The red-cell tutorials at their resolution and to their end, against boundary elements and the figures that they state.

    longRun.py BIN TUTORIAL      BIN: directory of the applications

Boundary elements: tutorials/rbcShear/reference (unbounded, Re 0, own computation). The tutorials' boxes are narrow, with walls at 2.5 radii, which
makes cells turn late, by 0.13 of a strain in a quarter turn at Ca 0.02: where angles are compared, the box is wider (WIDE).
"""
import csv
import math
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

SOURCE = pathlib.Path(__file__).resolve().parents[2] / "tutorials"
sys.path.insert(0, str(SOURCE))
from summary import axisTurned, strainOfTurn


def table(case, observer, file):
    with open(case / "postProcessing" / observer / file) as text:
        lines = (line for line in text if not line.startswith("#"))
        return [{key: float(value) for key, value in row.items()} for row in csv.DictReader(lines)]


def within(name, value, low, high):
    print(f"{name}: {value:.6g}, allowed {low:g} to {high:g}")
    assert low <= value <= high, name


def numbers(values):
    values = list(values)
    assert values and all(map(math.isfinite, values)), values
    return values


def drift(balance, key):
    return max(numbers(row[key] for row in balance), key=abs)


def reference(name):
    with open(SOURCE / "rbcShear" / "reference" / f"{name}.csv") as text:
        lines = (line for line in text if not line.startswith("#"))
        return [{key: float(value) for key, value in row.items()} for row in csv.DictReader(lines)]


def between(strain, shape, values):
    """Linear interpolation between the rows around this strain."""
    for i in range(1, len(shape)):
        before, after = shape[i - 1]["strain"], shape[i]["strain"]
        if before <= strain <= after:
            return values[i - 1] + (strain - before) / (after - before) * (values[i] - values[i - 1])
    raise AssertionError(f"no row at strain {strain}")


def furthest(shape, values, expected, column):
    """Largest deviation from the reference, over its rows."""
    end = shape[-1]["strain"]
    return max(numbers(abs(between(row["strain"], shape, values) - row[column]) for row in expected if row["strain"] <= end))


def kept(balance, area):
    within("area drift", drift(balance, "areaChange"), -area, area)
    within("volume drift", drift(balance, "volumeChange"), -1e-7, 1e-7)
    within("particles on the wrong side", max(numbers(row["changedSide"] for row in balance)), 0, 0)


def nearlyRigid(case):
    shape, expected = table(case, "deformation", "rbc.csv"), reference("Ca0.002")
    within("strain", shape[-1]["strain"], 22, 22.1)
    within("D12_inertia, furthest from boundary elements", furthest(shape, [row["D12_inertia"] for row in shape], expected, "D12_inertia"), 0, 0.003)
    within("strain of a full turn", strainOfTurn(shape), 20.47 - 0.4, 20.47 + 0.4)
    kept(table(case, "balance", "conservation.csv"), 0.002)


def tumbling(case):
    shape, expected = table(case, "deformation", "rbc.csv"), reference("Ca0.02")
    within("strain", shape[-1]["strain"], 6, 6.1)
    inertia = numbers(row["D12_inertia"] for row in shape)
    # Boundary elements: 0.556 to 0.574.
    within("smallest D12_inertia", min(inertia), 0.551, 0.561)
    within("largest D12_inertia", max(inertia), 0.569, 0.579)
    within("D12_inertia, furthest from boundary elements", furthest(shape, inertia, expected, "D12_inertia"), 0, 0.005)
    within("angle of the main axis, the same [degrees]", furthest(shape, axisTurned(shape), expected, "angle_deg"), 0, 2)
    kept(table(case, "balance", "conservation.csv"), 0.01)
    within("largest bond strain", max(numbers(row["maxBondStrain"] for row in table(case, "bonds", "rbc.csv"))), 0, 0.05)


def drawnOut(case):
    shape = table(case, "deformation", "rbc.csv")[-1]
    # Boundary elements at strain 6: 0.685, 11.0 degrees, 10.3 um, area +18.8 %.
    within("D12_inertia", shape["D12_inertia"], 0.665, 0.705)
    within("inclination [rad]", shape["inclination_rad"], 0.16, 0.23)
    within("length [m]", shape["length_m"], 9.8e-6, 10.8e-6)
    kept(table(case, "balance", "conservation.csv"), 0.25)


def rupture(case):
    rows = table(case, "rupture", "rbc.csv")
    whole = [row for row in rows if row["bondsBroken"] == 0]
    within("strain of the first break", rows[-1]["firstBreak_strain"], 0.09, 0.11)
    within("interior fluid released before it [m^3]", max(row["releasedVolume_m3"] for row in whole), 0, 0)
    within("bonds broken", rows[-1]["bondsBroken"], 1000, 2500)


def tear(case):
    """The tear of the tutorial, and the same on meshes with edges of other lengths, at 8 to 16 particles along the radius, with steps of 0.0125, to
    strain 0.6, where half of the volume has been released. Wanted: each quantity within 5 % of the finest mesh. Where this is missed, the bar is the
    next round number above what has been measured (tutorials/rbcTear/README.md)."""
    missed = {"first break": 0.09, "tear at 0.3 [um]": 0.12, "tear at 0.4 [um]": 0.06, "holes at 0.55 [um^2]": 0.11, "holes at 0.6 [um^2]": 0.08}
    coarse = {"released at 0.55 [fL]": 0.25, "released at 0.6 [fL]": 0.2}
    rows = table(case, "rupture", "rbc.csv")
    within("interior fluid released at the end [m^3]", rows[-1]["releasedVolume_m3"], 80e-18, 90e-18)
    within("tears that become shorter", sum(a["tearLength_m"] > b["tearLength_m"] for a, b in zip(rows, rows[1:])), 0, 0)
    found = {}
    for spacing, edge in ((0.25, 0.2), (0.25, 0.22), (0.32, 0.256), (0.32, 0.28), (0.5, 0.4), (0.5, 0.44)):
        changes = [f"system/numerics.yaml:/spacing={spacing} um", f"system/mesh.yaml:/cells/0/edge={edge} um", "system/control.yaml:/endStrain=0.6",
                   "system/numerics.yaml:/implicit={step: 0.0125}", "system/observers.yaml:/rupture/every=0.0125 strain"]
        options = [word for change in changes for word in ("-set", change)]
        subprocess.run(["./Allclean"], cwd=case, check=True)
        for command in (["membraneMesh"], ["particleFill"], ["mpirun", "--oversubscribe", "-np", "2", "dmpFlow"]):
            program = str(pathlib.Path(sys.argv[1]) / command.pop())
            subprocess.run([*command, program, "-quiet", *options], cwd=case, check=True)
        rows = table(case, "rupture", "rbc.csv")
        at = {round(row["strain"], 4): row for row in rows}
        found[spacing, edge] = {"first break": rows[-1]["firstBreak_strain"],
                                **{f"tear at {strain} [um]": 1e6 * at[strain]["tearLength_m"] for strain in (0.3, 0.4, 0.5, 0.6)},
                                **{f"holes at {strain} [um^2]": 1e12 * at[strain]["holeArea_m2"] for strain in (0.55, 0.6)},
                                **{f"released at {strain} [fL]": 1e18 * at[strain]["releasedVolume_m3"] for strain in (0.55, 0.6)}}
        print(spacing, edge, *(f"{key} {value:.4g};" for key, value in found[spacing, edge].items()), flush=True)
    finest = found[0.25, 0.2]
    for mesh, values in found.items():
        for key, value in values.items():
            share = finest[key] * (coarse.get(key) if mesh[0] == 0.5 and key in coarse else missed.get(key, 0.05))
            within(f"{key}, {mesh}", value, finest[key] - share, finest[key] + share)


TUTORIALS = {"rbcShear/Ca0.002": nearlyRigid, "rbcShear/Ca0.02": tumbling, "rbcShear/Ca3": drawnOut, "rbcRupture": rupture, "rbcTear": tear}
WIDE = {"rbcShear/Ca0.002", "rbcShear/Ca0.02"}

if __name__ == "__main__":
    binaries, tutorial = sys.argv[1:]
    with tempfile.TemporaryDirectory() as temporary:
        shutil.copytree(SOURCE, pathlib.Path(temporary) / "tutorials")
        case = pathlib.Path(temporary) / "tutorials" / tutorial
        box = ["-set", "system/mesh.yaml:/domain/size=[40 um, 32 um, 40 um]"] if tutorial in WIDE else []
        subprocess.run(["./Allrun", *box], cwd=case, check=True,
                       env={**os.environ, "CORPUSCLE_BIN": binaries, "CORPUSCLE_TUTORIALS": str(case.parents[len(tutorial.split("/")) - 1])})
        TUTORIALS[tutorial](case)
