#!/usr/bin/env python3
"""Iterations of the implicit step over size, stiffness of the membrane and preconditioner, in boxes of 5 radii.

    iterations.py BIN DIRECTORY [-steps 12] [WORD ...]     BIN: directory of the programs; WORD: only rows with all of these in their name

A row's name is RADIUS-CASE-PRECONDITIONER, its radius in spacings: 8, 12, 20 (74,000, 240,000, 1,060,000 particles). Prints the mean over the steps and
that without the first.
"""
import json
import pathlib
import shutil
import subprocess
import sys

TUTORIALS = pathlib.Path(__file__).resolve().parents[1] / "tutorials"
CASES = {"Ca0.3": "capsuleShear", "Ca0.02": "rbcShear/Ca0.02", "Ca0.002": "rbcShear/Ca0.002"}


def run(case, binaries, tutorial, radius, preconditioner, steps):
    settings = ["-quiet"]
    for key in ("system/mesh.yaml:/domain/size=[20 um, 20 um, 20 um]", f"system/numerics.yaml:/spacing={4 / radius:.8g} um",
                f"system/mesh.yaml:/cells/0/edge={4 / radius:.8g} um", "system/control.yaml:/startFrom=firstTime",
                f"system/numerics.yaml:/implicit={{step: 0.05, tolerance: 3e-3, error: 1, preconditioner: {preconditioner}}}"):
        settings += ["-set", key]
    if not (case / "0").exists():
        for folder in ("system", "constant"):
            shutil.copytree(TUTORIALS / tutorial / folder, case / folder)
        for program in ("membraneMesh", "particleFill"):
            subprocess.run([binaries / program, "-case", case, *settings], check=True)
    subprocess.run([binaries / "dmpFlow", "-case", case, *settings, "-steps", str(steps)], check=True)
    return json.loads((case / "run.json").read_text())["performance"]


if __name__ == "__main__":
    words = sys.argv[1:]
    steps = int(words.pop(words.index("-steps") + 1)) if "-steps" in words else 12
    binaries, directory, *only = [word for word in words if word != "-steps"]
    print("| row | iterations a step | after the first | processor seconds a step |\n|---|---|---|---|")
    for radius in (8, 12, 20):
        for name, tutorial in CASES.items():
            for preconditioner in ("blockJacobi", "twoLevel", "withMembrane"):
                row = f"{radius}-{name}-{preconditioner}"
                if not all(word in row.split("-") for word in only):
                    continue
                case = pathlib.Path(directory) / f"{radius}-{name}"
                first = run(case, pathlib.Path(binaries).resolve(), tutorial, radius, preconditioner, 1)
                whole = run(case, pathlib.Path(binaries).resolve(), tutorial, radius, preconditioner, steps)
                after = (whole["iterationsPerStep"] * steps - first["iterationsPerStep"]) / (steps - 1)
                seconds = (whole["processorSeconds"] - first["processorSeconds"]) / (steps - 1)
                print(f"| {row} | {whole['iterationsPerStep']:.1f} | {after:.1f} | {seconds:.2f} |", flush=True)
