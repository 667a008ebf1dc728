#!/usr/bin/env python3
"""The capillary number of the first break, by bisection, at each resolution.

A run at Ca either reaches the strain given without a break or stops at its first break (stop.firstBreak). Between a Ca that does
not break and one that does, the next run is at their geometric mean, until their ratio is below 1 + tolerance. The second
resolution and later ones start from 15 % about the result of the one before, and widen that where it does not hold.
"""
import argparse
import csv
import json
import math
import os
import shutil
import subprocess
import sys

COLUMNS = ["spacing_um", "Ca_whole", "Ca_breaks", "Ca_critical", "shearRate_critical_1_s", "firstBreak_strain", "runs", "wallClock_s"]


def options():
    p = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    p.add_argument("-bracket", default="0.07 0.1", help="a Ca that does not break and one that does, for the first resolution")
    p.add_argument("-tolerance", type=float, default=0.02, help="relative width of the last bracket")
    p.add_argument("-strain", type=float, default=2, help="strain that a cell must bear to count as whole")
    p.add_argument("-spacing", default="0.8 0.64 0.5", help="particle spacings in um; edges of the mesh are 0.8 of them")
    p.add_argument("-box", default="[16 um, 16 um, 16 um]", help="size of the box, a whole number of every spacing")
    p.add_argument("-case", default="..", help="the case to study")
    p.add_argument("-set", action="append", default=[], metavar="FILE:/path=value", help="goes to every program")
    o = p.parse_args()
    low, high = sorted(float(word) for word in o.bracket.split())
    return o, low, high


def execute(case, application, settings, ranks=1, codes=(0,)):
    command = ["mpirun", "-np", str(ranks)] if ranks > 1 else []
    command += [application, "-quiet", "-case", case] + [word for setting in settings for word in ("-set", setting)]
    code = subprocess.run(command).returncode
    if code not in codes:
        sys.exit(f"{' '.join(command)}: failed with exit code {code}")


class Study:
    """One resolution: one mesh and one filling serve every Ca."""

    def __init__(self, o, spacing):
        self.case, self.strain, self.spacing = os.path.join("runs", f"dx{spacing}"), o.strain, spacing
        for folder in ("system", "constant"):
            shutil.copytree(os.path.join(o.case, folder), os.path.join(self.case, folder))
        self.settings = [f"system/numerics.yaml:/spacing={spacing} um", f"system/mesh.yaml:/domain/size={o.box}",
                         f"system/mesh.yaml:/cells/0/edge={0.8 * float(spacing):g} um", f"system/control.yaml:/endStrain={o.strain}",
                         "system/control.yaml:/startFrom=firstTime", "system/control.yaml:/stop/firstBreak=true"] + o.set
        self.runs, self.wallClock, self.seen = [], 0.0, {}
        for application in ("membraneMesh", "particleFill"):
            execute(self.case, application, self.settings)

    def breaksAt(self, Ca):
        execute(self.case, "dmpFlow", self.settings + [f"constant/flow.yaml:/Ca={Ca!r}"], int(os.environ.get("CORPUSCLE_NP", 1)), (0, 5))
        with open(os.path.join(self.case, "run.json")) as text:
            run = json.load(text)
        broke = run["result"]["brokenBonds"] > 0
        if not broke and run["status"] != "done":
            sys.exit(f"{self.case}: {run['status']} at Ca {Ca:g} before strain {self.strain:g}: {run['reason']}")
        self.wallClock += run["wallClock_s"]
        self.seen[Ca] = (run["result"]["strain"], run["parameters"]["shearRate_1_s"])
        self.runs.append([self.spacing, Ca, int(broke), run["result"]["strain"]])
        print(f"dx {self.spacing} um, Ca {Ca:.5g}: " + (f"breaks at strain {run['result']['strain']:.4f}" if broke else "whole"), flush=True)
        return broke

    def hold(self, low, high):
        """The bracket, each end moved out until it is on its side."""
        width = high / low
        while self.breaksAt(low):
            low, high = low / width, low
        while high not in self.seen and not self.breaksAt(high):
            low, high = high, high * width
        return low, high

    def bisect(self, low, high, tolerance):
        low, high = self.hold(low, high)
        while high / low > 1 + tolerance:
            middle = math.sqrt(low * high)
            if self.breaksAt(middle):
                high = middle
            else:
                low = middle
        critical, (strain, shearRate) = math.sqrt(low * high), self.seen[high]
        return [self.spacing, low, high, critical, shearRate * critical / high, strain, len(self.runs), round(self.wallClock, 1)]


def write(name, header, rows):
    with open(os.path.join("runs", name), "w", newline="") as file:
        table = csv.writer(file, lineterminator="\n")
        table.writerow(header)
        table.writerows(rows)


def main():
    o, low, high = options()
    results, runs = [], []
    for spacing in o.spacing.split():
        study = Study(o, spacing)
        results.append(study.bisect(low, high, o.tolerance))
        low, high = results[-1][3] / 1.15, results[-1][3] * 1.15
        runs += sorted(study.runs, key=lambda run: run[1])
        write("summary.csv", COLUMNS, results)
        write("runs.csv", ["spacing_um", "Ca", "broke", "strain"], runs)
    print(f"{'dx [um]':>8s}{'Ca of first break':>20s}{'shear rate [1/s]':>18s}{'at strain':>11s}{'runs':>6s}{'time [s]':>10s}")
    for r in results:
        print(f"{r[0]:>8s}{r[3]:13.4f} +-{50 * (r[2] / r[1] - 1):3.1f} %{r[4]:18.1f}{r[5]:11.3f}{r[6]:6d}{r[7]:10.0f}")


if __name__ == "__main__":
    main()
