#!/usr/bin/env python3
"""The red-cell tutorials at their own resolution and to their end, against boundary elements and their own claims.

    longRun.py BIN TUTORIAL      BIN: directory of the applications

Boundary elements: tutorials/rbcShear/reference (unbounded, Re 0, own computation; the boxes here are narrow: walls at 2 radii).
"""
import csv
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

SOURCE = pathlib.Path(__file__).resolve().parents[2] / "tutorials"


def table(case, observer, file):
    with open(case / "postProcessing" / observer / "0" / file) as text:
        return [{key: float(value) for key, value in row.items()} for row in csv.DictReader(text)]


def within(name, value, low, high):
    print(f"{name}: {value:.6g}, allowed {low:g} to {high:g}")
    assert low <= value <= high, name


def drift(balance, ending):
    return max((row[key] for row in balance for key in row if key.endswith(ending)), key=abs)


def ca002(case):
    shape, balance = table(case, "deformation", "rbc.csv"), table(case, "balance", "conservation.csv")
    within("strain", shape[-1]["strain"], 6, 6.1)
    # Boundary elements: 0.556 to 0.574.
    within("smallest D12_inertia", min(row["D12_inertia"] for row in shape), 0.546, 0.566)
    within("largest D12_inertia", max(row["D12_inertia"] for row in shape), 0.564, 0.584)
    within("area drift", drift(balance, "_areaChange"), -0.01, 0.01)
    within("volume drift", drift(balance, "_volumeChange"), -0.02, 0.02)
    within("particles on the wrong side", max(row["changedSide"] for row in balance), 0, 5)
    within("largest bond strain", max(row["maxBondStrain"] for row in table(case, "bonds", "rbc.csv")), 0, 0.05)


def ca3(case):
    shape, balance = table(case, "deformation", "rbc.csv")[-1], table(case, "balance", "conservation.csv")
    # Boundary elements at strain 6: 0.685, 11.0 degrees, 10.3 um, area +18.8 %.
    within("D12_inertia", shape["D12_inertia"], 0.665, 0.705)
    within("inclination [rad]", shape["inclination_rad"], 0.16, 0.23)
    within("length [m]", shape["length_m"], 9.8e-6, 10.8e-6)
    within("volume drift", drift(balance, "_volumeChange"), -0.02, 0.02)


def rupture(case):
    rows = table(case, "rupture", "rbc.csv")
    whole = [row for row in rows if row["bondsBroken"] == 0]
    within("strain of the first break", rows[-1]["firstBreak_strain"], 0.09, 0.11)
    within("interior fluid released before it [m^3]", max(row["releasedVolume_m3"] for row in whole), 0, 0)
    within("bonds broken", rows[-1]["bondsBroken"], 1000, 2500)


TUTORIALS = {"rbcShear/Ca0.02": ca002, "rbcShear/Ca3": ca3, "rbcRupture": rupture}

if __name__ == "__main__":
    binaries, tutorial = sys.argv[1:]
    with tempfile.TemporaryDirectory() as temporary:
        shutil.copytree(SOURCE, pathlib.Path(temporary) / "tutorials")
        case = pathlib.Path(temporary) / "tutorials" / tutorial
        subprocess.run(["./Allrun"], cwd=case, check=True,
                       env={**os.environ, "CORPUSCLE_BIN": binaries, "CORPUSCLE_TUTORIALS": str(case.parents[len(tutorial.split("/")) - 1])})
        TUTORIALS[tutorial](case)
