#!/usr/bin/env python3
"""Which numerics give the lowest error for the core-second: kernel, support, shifting, start and density, one changed at a time.

    numerics.py BIN DIRECTORY [CASE ...] [-set NAME]     BIN: where the programs are; all without CASE
    numerics.py -write                                   the table of what has been run, without running

What DIRECTORY holds already is not run again. Points go to results.csv, the table to README.md. Cases are those of validation, all by the implicit
step; errors are those of their pages, in per cent; core-seconds are those of the processor, on one rank.
"""
import csv
import math
import pathlib
import re
import sys
from dataclasses import dataclass, field, replace

HERE = pathlib.Path(__file__).resolve().parent
sys.path += [str(HERE.parent / "workPrecision"), str(HERE.parents[1] / "tests" / "validation")]
import suite
import vtp
import workPrecision
from workPrecision import NUMERICS, implicit, largest, option, recorded

RESULTS = HERE / "results.csv"
MESH = "system/mesh.yaml:"
DEFAULT = "wendlandC2, 2.4 dx"
KERNELS = ("wendlandC2, 2.0 dx", "wendlandC2, 2.2 dx", DEFAULT, "wendlandC2, 2.7 dx", "wendlandC2, 3.0 dx", "quintic, 2.4 dx", "quintic, 2.8 dx",
           "lucy, 2.4 dx", "lucy, 3.0 dx")


def kernel(words):
    name, support = words.split(", ")
    return [f"{NUMERICS}/kernel={{type: {name}, support: {support}}}"]


SETS = {words: kernel(words) for words in KERNELS} | {
    "half the shifting": [NUMERICS + "/shifting={coefficient: 0.5}"],
    "twice the shifting": [NUMERICS + "/shifting={coefficient: 2}"],
    "from a lattice": [MESH + "/fill/jitter=0"],
    "jittered by 0.1 dx": [MESH + "/fill/jitter=0.1"],
    "jittered by 0.2 dx": [MESH + "/fill/jitter=0.2"],
    "terms in float": [NUMERICS + "/precision=mixed"],
    "terms in double": [NUMERICS + "/precision=double"],
    "no balance of density": [NUMERICS + "/densityBalance=0"],
}
OF_CELLS = ("no balance of density",)


def pressure(case, done, n):
    """L2 error of the pressure minus its mean at the first result after the start, over mu k U at that time, the scale of the viscous stresses."""
    folder = done["flow"] / "results"
    time = float(re.findall(r'timestep="([^"]+)"', (folder / "fluid.pvd").read_text())[1])
    found = vtp.File(sorted((folder / "fluid").glob("*/*.vtp"))[1])
    rho, mu, speed, k = 1000.0, 1e-3, 0.01, 2 * math.pi / 1e-3  # of tutorials/taylorGreen, SI
    decay = math.exp(-2 * mu / rho * k * k * time)  # of the velocity
    half = rho * (speed * decay) ** 2 / 4
    exact = [half * (math.cos(2 * k * x) + math.cos(2 * k * z)) for x, _, z in found.points]  # invariant under a shift by half a wave along both
    errors = [p - q for p, q in zip(found.arrays["pressure"], exact)]
    mean = sum(errors) / len(errors)
    return 100 * math.sqrt(sum((e - mean) ** 2 for e in errors) / len(errors)) / (mu * k * speed * decay)


@dataclass
class Column:
    """case: of validation; run: which of its runs is used; errors: by heading, function of (case, folders of its runs, n)."""
    case: str
    n: int
    run: str
    errors: dict
    settings: list = field(default_factory=list)
    prepare: object = lambda case: None
    cells: bool = False


def onlyTen(case):
    case.REYNOLDS = (10,)


ENERGY = {"E/E(0)": largest("E/E(0)")}
VORTICES = implicit(0.025)
COLUMNS = [
    Column("poiseuille", 32, "flow", {"Poiseuille": largest()}, implicit(6.2e-5 / 4)),
    Column("taylorGreen2D", 32, "flow", {"Taylor-Green, plane": ENERGY["E/E(0)"], "its pressure": pressure}, VORTICES),
    Column("taylorGreen2D", 64, "flow", {"Taylor-Green, plane": ENERGY["E/E(0)"], "its pressure": pressure}, VORTICES),
    Column("abc", 16, "flow", {"ABC": ENERGY["E/E(0)"]}, VORTICES),
    Column("abc", 32, "flow", {"ABC": ENERGY["E/E(0)"]}, VORTICES),
    Column("taylorGreen3D", 16, "Re10", {"Taylor-Green, 3D, Re 10": ENERGY["E/E(0)"]}, VORTICES, onlyTen),
    Column("taylorGreen3D", 32, "Re10", {"Taylor-Green, 3D, Re 10": ENERGY["E/E(0)"]}, VORTICES, onlyTen),
    Column("sphereArray", 12, "c0.125", {"spheres, c = 0.125": workPrecision.drag}, prepare=workPrecision.oneFraction),
    Column("capsuleSkalak", 6, "Ca0.3", {"capsule, D12": largest("D12"), "its period": largest("period")}, cells=True),
    Column("redCellShear", 6, "Ca0.02", {"red cell": workPrecision.turned}, prepare=workPrecision.quarter, cells=True),
]
FIELDS = ("case", "resolution", "set", "figure", "error_percent", "coreSeconds", "machine", "date")


def measure(column, words, binaries, folder):
    case = suite.load(column.case)
    column.prepare(case)
    (run,) = (run for run in case.runs(column.n) if run.name == column.run)
    run = replace(run, settings=[*run.settings, *column.settings, *SETS[words]])
    done = {run.name: folder / run.name}
    record = suite.execute(run, done[run.name], binaries, 1)
    machine, day, _ = suite.origin(record)
    shared = {"case": column.case, "resolution": str(column.n), "set": words, "coreSeconds": f"{record['performance']['processorSeconds']:.3g}",
              "machine": machine, "date": day}
    points = [shared | {"figure": figure, "error_percent": f"{error(case, done, column.n):.3g}"} for figure, error in column.errors.items()]
    key = ("case", "resolution", "set")
    points += [p for p in recorded(RESULTS) if any(p[name] != points[0][name] for name in key)]
    order = [(c.case, str(c.n)) for c in COLUMNS]
    points.sort(key=lambda p: (order.index((p["case"], p["resolution"])), list(SETS).index(p["set"])))
    with open(RESULTS, "w") as text:
        writer = csv.DictWriter(text, FIELDS, lineterminator="\n")
        writer.writeheader()
        writer.writerows(points)


def write():
    """The table: a row for each set, a column for each figure at its resolutions."""
    points = {(p["case"], p["resolution"], p["set"], p["figure"]): p for p in recorded(RESULTS)}
    figures = list(dict.fromkeys((c.case, figure) for c in COLUMNS for figure in c.errors))
    sizes = {(case, figure): [str(c.n) for c in COLUMNS if c.case == case and figure in c.errors] for case, figure in figures}
    lines = ["| | " + " | ".join(f"{figure}, {'; '.join(sizes[case, figure])}" for case, figure in figures) + " |", "|---|" + "---|" * len(figures)]
    for words in SETS:
        cells = []
        for case, figure in figures:
            found = [points[case, n, words, figure] for n in sizes[case, figure] if (case, n, words, figure) in points]
            seconds = "" if figure.startswith("its") or not found else f" ({'; '.join(p['coreSeconds'] for p in found)} s)"
            cells.append("; ".join(p["error_percent"] for p in found) + seconds)
        lines.append(f"| {'**' + words + '**' if words == DEFAULT else words} | " + " | ".join(cells) + " |")
    where = sorted({(p["machine"], p["date"]) for p in points.values()})
    lines += ["", "; ".join(f"{machine}, {day}" for machine, day in where) + "."]
    page = HERE / "README.md"
    before, rest = page.read_text().split(suite.MARKS[0])
    page.write_text(before + suite.MARKS[0] + "\n\n" + "\n".join(lines) + "\n\n" + suite.MARKS[1] + rest.split(suite.MARKS[1])[1])


def main(words):
    if words != ["-write"]:
        only = option(words, "-set")
        binaries, directory, *names = words
        unknown = {*names} - {column.case for column in COLUMNS} | {*([only] if only else [])} - {*SETS}
        if unknown:
            sys.exit(f"numerics.py: no '{sorted(unknown)[0]}'; cases are {', '.join(dict.fromkeys(c.case for c in COLUMNS))}; sets {'; '.join(SETS)}")
        for column in COLUMNS:
            for which in SETS:
                if (names and column.case not in names) or only not in (None, which) or (which in OF_CELLS and not column.cells):
                    continue
                measure(column, which, pathlib.Path(binaries).resolve(),
                        pathlib.Path(directory).resolve() / which.replace(" ", "") / column.case / str(column.n))
    write()


if __name__ == "__main__":
    main(sys.argv[1:])
