#!/usr/bin/env python3
"""What the place of a cell on the lattice of particles does to its turning: a red cell in shear flow, its centre moved by fractions of a spacing.

    placement.py BIN DIRECTORY [-across 6,8] [-viscosityRatio 1] [-Ca 0.2] [-end 8]     BIN: directory of the programs

The cell of the tutorial rbcShear/Ca0.02 (springs), Re 0.01, edges of dx, in a box of 5 x 4 x 5 radii. Of each place: strain of a quarter turn and
the least D12 by inertia until then. The flow has no such places, so that what differs between them is an error. -across: particles along the
radius. What has ended is not run again unless its settings have changed; a stopped run goes on.
"""
import argparse
import math
import pathlib
import statistics
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "tests" / "validation"))
from membranes import RADIUS, Course, settings
from suite import PROGRAMS, TUTORIALS, Run, execute

BOX = (5, 4, 5)  # radii
PLACES = [(0, 0, 0), (0.5, 0, 0), (0, 0, 0.5), (0.25, 0.25, 0.25), (0.5, 0.5, 0.5), (0.3, 0.1, 0.4)]  # spacings


def run(across, place, words):
    spacing = RADIUS / across
    more = ["system/mesh.yaml:/cells/0/centre=[" + ", ".join(f"{spacing * x:.8g} um" for x in place) + "]",
            f"constant/membranes.yaml:/rbc/interior/viscosityRatio={words.viscosityRatio:g}", f"constant/flow.yaml:/Ca={words.Ca:g}",
            "constant/flow.yaml:/inertia/Re=0.01", "system/observers.yaml:/deformation/every=0.05 strain"]
    name = f"{across}_{words.viscosityRatio:g}_{words.Ca:g}_{'_'.join(f'{x:g}' for x in place)}"
    return Run(name, TUTORIALS / "rbcShear" / "Ca0.02", settings(across, BOX, words.end, more), PROGRAMS)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("bin", type=pathlib.Path)
    parser.add_argument("directory", type=pathlib.Path)
    parser.add_argument("-across", default="6,8")
    parser.add_argument("-viscosityRatio", type=float, default=1)
    parser.add_argument("-Ca", type=float, default=0.2)
    parser.add_argument("-end", type=float, default=8)
    words = parser.parse_args()
    print("| a/dx | centre [dx] | quarter turn | least D12 |\n|---|---|---|---|")
    for across in map(int, words.across.split(",")):
        turns = []
        for place in PLACES:
            planned = run(across, place, words)
            folder = words.directory.resolve() / planned.name
            execute(planned, folder, words.bin.resolve(), 1)
            course = Course(folder)
            turns.append(course.turn(90))
            if math.isnan(turns[-1]):
                sys.exit(f"placement: {folder} has not turned by 90 degrees at strain {words.end:g}; take a larger -end")
            least = min(row["D12_inertia"] for row in course.shape[1:] if row["strain"] <= turns[-1])
            print(f"| {across} | {', '.join(f'{x:g}' for x in place)} | {turns[-1]:.3f} | {least:.4f} |", flush=True)
        print(f"| {across} | mean, standard deviation | {statistics.mean(turns):.3f}, {statistics.stdev(turns):.3f} | |", flush=True)
