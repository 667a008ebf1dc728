#!/usr/bin/env python3
"""Iterations of the implicit step as a function of size, membrane stiffness and preconditioner, in boxes of 5 radii.

    iterations.py BIN DIRECTORY [-steps 12] [WORD ...]     BIN: directory of the programs; WORD: only rows with all of these in their name

A row's name is RADIUS-CASE-PRECONDITIONER, its radius in spacings: 8, 12, 20 (74,000, 240,000, 1,060,000 particles). Prints the mean over the steps and
that without the first.
"""
import json
import pathlib
import subprocess
import sys

from tutorialCase import RADIUS, prepare, sized

BOX = (20, 20, 20)  # um
CASES = {"Ca0.3": "capsuleShear", "Ca0.02": "rbcShear/Ca0.02", "Ca0.002": "rbcShear/Ca0.002"}


def run(case, binaries, tutorial, radius, preconditioner, steps):
    options = prepare(case, binaries, tutorial, [
        *sized(BOX, RADIUS / radius), "system/control.yaml:/startFrom=firstTime",
        f"system/numerics.yaml:/implicit={{step: 0.05, tolerance: 3e-3, error: 1, preconditioner: {preconditioner}}}"])
    subprocess.run([binaries / "dmpFlow", "-case", case, *options, "-steps", str(steps)], check=True)
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
