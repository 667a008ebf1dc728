#!/usr/bin/env python3
"""Cost of a step of 16 red cells on several ranks: processor time, memory, and what each rank sends; each as the maximum over the ranks.

    population.py BIN DIRECTORY [-np 1,2,4] [-steps 6]     BIN: directory of the programs and of libmessageCounts.so (target messageCounts)

The tutorial rbcShear/redCell (Skalak C = 100, Helfrich's bending, an interior five times as viscous, 40 1/s) in a box of 20 um at a spacing of
0.5 um, its cells in four layers, without observers. Figures are those of a step after the first two.
"""
import argparse
import json
import pathlib
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from tutorialCase import prepare
from suite import ENVIRONMENT

LAYERS = (-7.3, -2.45, 2.45, 7.3)  # um
PLACES = [(x + (2.5 if layer in (0, 2) else 7.5) - 10, y - 10, z) for layer, z in enumerate(LAYERS) for x in (0, 10) for y in (5, 15)]
BEFORE = 2  # steps that are left out
MESH = ["system/mesh.yaml:/domain/size=[20 um, 20 um, 20 um]", "system/numerics.yaml:/spacing=0.5 um", "system/mesh.yaml:/cells/0/edge=0.5 um",
        "system/mesh.yaml:/cells/0/places=[" + ", ".join(f"{{centre: [{x:g} um, {y:g} um, {z:g} um]}}" for x, y, z in PLACES) + "]",
        "system/control.yaml:/write={}", "system/control.yaml:/startFrom=firstTime"]


def counts(case, binaries, options, ranks, steps):
    """Figures of a run of this number of steps, by name, including the processor time of all ranks [s]."""
    file = case / "messageCounts"
    subprocess.run(["mpirun", "-np", str(ranks), "env", f"LD_PRELOAD={binaries / 'libmessageCounts.so'}", f"MESSAGE_COUNTS={file}",
                    binaries / "dmpFlow", "-case", case, *options, "-steps", str(steps)], check=True, env=ENVIRONMENT)
    found = {name: int(number) for number, name in (line.split() for line in file.read_text().splitlines())}
    found["seconds"] = json.loads((case / "run.json").read_text())["performance"]["processorSeconds"]
    return found


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("bin", type=pathlib.Path)
    parser.add_argument("directory", type=pathlib.Path)
    parser.add_argument("-np", default="1,2,4")
    parser.add_argument("-steps", type=int, default=6)
    words = parser.parse_args()
    binaries, case = words.bin.resolve(), words.directory.resolve() / "population"
    case.parent.mkdir(parents=True, exist_ok=True)
    options = prepare(case, binaries, "rbcShear/redCell", MESH)
    (case / "system" / "observers.yaml").unlink(missing_ok=True)
    print("| ranks | core-s | MiB of a rank | messages | MB | reductions | MB | largest | other collectives | MB |\n|---|---|---|---|---|---|---|---|---|---|")
    for ranks in map(int, words.np.split(",")):
        first, last = (counts(case, binaries, options, ranks, steps) for steps in (BEFORE, BEFORE + words.steps))
        step = {name: (last[name] - first[name]) / words.steps for name in last}
        print(f"| {ranks} | {step['seconds']:.2f} | {last['memory_kB'] / 1024:.0f} | {step['messages']:.0f} | {step['messageBytes'] / 1e6:.2f} "
              f"| {step['reductions']:.0f} | {step['reducedBytes'] / 1e6:.3f} | {last['largestReduction']} B | {step['collectives']:.0f} "
              f"| {step['collectiveBytes'] / 1e6:.3f} |", flush=True)
