#!/usr/bin/env python3
"""Effect of box, resolution and coupling: the capsule and the red cell of the tutorials in boxes of several sizes, against boundary elements.
For red cells it shows the range of D12 and the strains at which the cell has made a quarter, half and full turn.

    boxes.py BIN DIRECTORY [NAME ...] [-np 2]     BIN: directory of the programs; NAME: rows to run, all without

Makes the runs that DIRECTORY does not hold yet, one folder for each row, and prints the table of all finished runs. A stopped run is continued.
Boxes are along the flow, the vorticity and across the gap, in radii.
"""
import json
import pathlib
import subprocess
import sys

from tutorialCase import RADIUS, TUTORIALS, prepare, sized  # makes tests/validation importable, whose modules do so for tutorials

from membranes import turn
from suite import ENVIRONMENT, at, rows, worst
from summary import series, strainOfTurn

CAPSULE = ("capsuleShear", "capsule", "/implicit/step=0.05")
RED02 = ("rbcShear/Ca0.02", "rbc", "/implicit/step=0.1")
RED002 = ("rbcShear/Ca0.002", "rbc", "/implicit/step=0.1")
FASTER = "constant/flow.yaml:/inertia={Re: 0.1}"  # what velocity Verlet can afford
VERLET, PLAIN = "system/numerics.yaml:/integrator=velocityVerlet", "system/numerics.yaml:/operators=plain"
DUAL = ("system/numerics.yaml:/coupling=dualIdentity", "system/numerics.yaml:/kernel/support=3 dx")
SCHEMES = {"implicit": (), "plain": (PLAIN,), "verlet": (VERLET,), "dualIdentity": (VERLET, PLAIN, *DUAL)}
RUNS = {  # tutorial, cell, step; spacings in a radius, box, strain, other settings
    "capsule8box5": (*CAPSULE, 8, (5, 5, 5), 5),
    "capsule8box8": (*CAPSULE, 8, (6, 6, 8), 5),
    "capsule8box12": (*CAPSULE, 8, (6, 6, 12), 5),
    "capsule12box5": (*CAPSULE, 12, (5, 5, 5), 5),
    "capsule12box8": (*CAPSULE, 12, (6, 6, 8), 5),
    "capsule12box12": (*CAPSULE, 12, (6, 6, 12), 5),
    "capsule16box5": (*CAPSULE, 16, (5, 5, 5), 5),
    "capsule8box5to30": (*CAPSULE, 8, (5, 5, 5), 30),
    **{f"capsule8box{box[2]}{name}": (*CAPSULE, 8, box, 3, FASTER, *scheme)
       for box in ((5, 5, 5), (6, 6, 8), (6, 6, 12)) for name, scheme in SCHEMES.items()},
    "red6box6": (*RED02, 6, (6, 6, 6), 22),
    "red6box8": (*RED02, 6, (8, 6, 8), 22),
    "red6box10": (*RED02, 6, (10, 8, 10), 22),
    "red6box12": (*RED02, 6, (12, 10, 12), 22),
    "red12box8": (*RED02, 12, (8, 6, 8), 30),
    "stiff6box6": (*RED002, 6, (6, 6, 6), 22),
    "stiff6box8": (*RED002, 6, (8, 6, 8), 22),
    "stiff6box10": (*RED002, 6, (10, 8, 10), 22),
    "stiff6box12": (*RED002, 6, (12, 10, 12), 22),
    "stiff8box10": (*RED002, 8, (10, 8, 10), 31),
}
REFERENCES = {"capsuleShear": "capsuleShear/reference.csv", "rbcShear/Ca0.02": "rbcShear/reference/Ca0.02.csv",
              "rbcShear/Ca0.002": "rbcShear/reference/Ca0.002.csv"}


def run(case, binaries, ranks, tutorial, cell, step, perRadius, box, strain, *settings):
    options = prepare(case, binaries, tutorial, [
        *sized([length * RADIUS for length in box], RADIUS / perRadius), "system/numerics.yaml:" + step,
        f"system/control.yaml:/endStrain={strain}", f"system/control.yaml:/write/strain={strain}", *settings])
    subprocess.run(["mpirun", "-np", str(ranks), binaries / "dmpFlow", "-case", case, *options], check=True,
                   env=ENVIRONMENT)


def describe(name, case, tutorial, cell, step, perRadius, box, strain, *settings):
    record = json.loads((case / "run.json").read_text())
    shape, balance = series(case, "deformation", "*.csv"), series(case, "balance", "conservation.csv")
    reference = rows(TUTORIALS / REFERENCES[tutorial])
    performance = record["performance"]
    if tutorial == "capsuleShear":
        strains = range(1, min(strain, 5) + 1)
        result = " ".join(f"{at(shape, t, 'D12_inertia'):.4f}" for t in strains)
        error = " ".join(f"{100 * (at(shape, t, 'D12_inertia') / at(reference, t, 'D12_inertia') - 1):+.2f}" for t in strains) + " %"
    else:
        values = [row["D12_inertia"] for row in shape]
        turns = [(strainOfTurn(shape, degrees), turn(reference, degrees)) for degrees in (90, 180, 360)]
        result = f"{min(values):.4f} to {max(values):.4f}, turns at " + " ".join(f"{mine:.2f}" for mine, _ in turns)
        within = worst(row["D12_inertia"] - at(reference, row["strain"], "D12_inertia") for row in shape if row["strain"] <= reference[-1]["strain"])
        error = f"{abs(within):.4f}, " + " ".join(f"{100 * (mine / theirs - 1):+.2f}" for mine, theirs in turns) + " %"
    volume = abs(worst(row["volumeChange"] for row in balance))
    density = abs(worst(row["density_mean"] / balance[0]["density_mean"] - 1 for row in balance))
    crossed = max(row["changedSide"] for row in balance) + balance[-1]["guardMoves"]
    stress = [row["effectiveViscosity"] for row in series(case, "wall", "wallStress.csv") if row["strain"] > strain - 1]
    particles = record["parameters"]["particles"]
    return (f"| {name} | {perRadius} | {' x '.join(map(str, box))} | {particles} | {result} | {error} | {crossed:.0f} | {volume:.0e} | {density:.0e} | {sum(stress) / len(stress):.4f} | "
            f"{performance.get('iterationsPerStep', 0):.1f} | {performance['processorSeconds'] / shape[-1]['strain']:.1f} |")


if __name__ == "__main__":
    words = sys.argv[1:]
    ranks = int(words.pop(words.index("-np") + 1)) if "-np" in words else 2
    binaries, directory, *names = [word for word in words if word != "-np"]
    for name in names:
        if name not in RUNS:
            sys.exit(f"boxes.py: no row '{name}'; there are {', '.join(RUNS)}")
    directory = pathlib.Path(directory)
    directory.mkdir(parents=True, exist_ok=True)
    print("| row | spacings in a radius | box | particles | D12 by inertia | against boundary elements | crossed or moved back | volume | mean density | wall stress, mu gammadot | iterations a step | core-seconds a strain |")
    print("|---|---|---|---|---|---|---|---|---|---|---|---|")
    for name, row in RUNS.items():
        case = directory / name
        ended = (case / "run.json").exists() and json.loads((case / "run.json").read_text())["status"] == "done"
        if not ended and (name in names or not names):
            run(case, pathlib.Path(binaries).resolve(), ranks, *row)
            ended = True
        if ended:
            print(describe(name, case, *row), flush=True)
