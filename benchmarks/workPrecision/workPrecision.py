#!/usr/bin/env python3
"""Error against core-seconds: cases of validation, one line for each scheme, over resolution and step.

    workPrecision.py BIN DIRECTORY [CASE ...] [-scheme NAME] [-resolution N] [-np 1] [-begin]     BIN: where the programs are; all without CASE
    workPrecision.py -draw                                                               diagrams and tables of what has been run, without running

What DIRECTORY holds already is not run again. Points are written to results.csv, diagrams beside it (SVG and PNG), tables to README.md. The error of
a point is that of its case of validation (tests/validation/CASE; DIAGRAMS selects the figures), relative, in per cent; core-seconds are processor
time (run.json). Runs that would take too long are only begun (all with -begin): their core-seconds are extrapolated from the part that was run, and
they have no error.
Lines of PySPH are run by pysphPeer.py where Debian's python3-pysph is installed; elsewhere they are kept as they are.
"""
import csv
import datetime
import json
import math
import pathlib
import re
import subprocess
import sys
from dataclasses import dataclass, field, replace

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "tests" / "validation"))
import suite
from membranes import turn

NUMERICS = "system/numerics.yaml:"
PAPER = [NUMERICS + text for text in ("/integrator=velocityVerlet", "/operators=plain", "/coupling=dualIdentity",
                                      "/kernel={type: lucy, support: 3 dx}", "/shifting=none")]
PLAIN = [NUMERICS + text for text in ("/integrator=velocityVerlet", "/operators=plain", "/kernel={type: wendlandC2, support: 3 dx}",
                                      "/shifting={coefficient: 1}")]
VERLET = [NUMERICS + text for text in ("/integrator=velocityVerlet", "/operators=corrected", "/kernel={type: wendlandC2, support: 2.4 dx}",
                                       "/shifting={coefficient: 1}")]
RKL2 = [NUMERICS + "/integrator=rkl2", *PLAIN[1:]]
PART = 0.002  # of a run that is only begun
PYTHON = "/usr/bin/python3"  # Debian's, which has its packages


def implicit(step, tolerance="1e-3"):
    return [NUMERICS + "/integrator=implicit", *VERLET[1:], NUMERICS + f"/implicit={{step: {step}, tolerance: {tolerance}}}"]


def scaled(run, path, factor):
    """The setting of path as in the run, times factor."""
    (found,) = (match for setting in run.settings if (match := re.fullmatch(f"({re.escape(path)}=)([0-9.e+-]+)(.*)", setting)))
    return f"{found[1]}{factor * float(found[2]):.8g}{found[3]}"


@dataclass
class Line:
    """A scheme: settings, or a function of the run that returns them; the resolutions at which it is run, and those at which it is only begun.
    further: ratio of its length to that of the other runs, so that it reaches the event from which its error is taken."""
    settings: object
    resolutions: tuple
    begun: tuple = ()
    further: float = 1


@dataclass
class Peer:
    """A line of PySPH."""
    dimensions: int
    resolutions: tuple
    begun: tuple = ()


@dataclass
class Diagram:
    """run: which of the case's runs is used. lines: by scheme. error(case, done, n): per cent. prepare(case): restricts its runs. what: for
    the title."""
    run: str
    lines: dict
    error: object
    prepare: object = lambda case: None
    what: str = ""
    settings: list = field(default_factory=list)  # of every line


def largest(*parts):
    """Largest error of the case's figures in per cent, of those with one of these parts in their names if there are any."""
    def error(case, done, n):
        figures = [figure for figure in case.figures(done, n) if figure.unit == "%"]
        return abs(suite.worst(figure.error for figure in figures if not parts or any(part in figure.name for part in parts)))
    return error


def oneFraction(case):
    case.FRACTIONS = (0.125,)


def drag(case, done, n):
    (c,) = case.FRACTIONS
    return 100 * abs(case.drag(done[case.name(c)], c, n) / case.reference[c] - 1)


def quarter(case):
    """Restricts the case to Ca 0.02 at every resolution, until the cell has made a quarter turn."""
    case.cells.coarse = None
    case.cells.scenes = {"0.02": (QUARTER, case.cells.scenes["0.02"][1])}


QUARTER = 5.5  # strain; the quarter turn is at 5.17


def turned(case, done, n):
    """Strain of a quarter turn and D12 at every half strain before it."""
    ((Ca, course),) = case.cells.courses(done)
    theirs = case.cells.reference(Ca)
    shapes = [course.at(0.5 * k, "D12_inertia") / suite.at(theirs, 0.5 * k, "D12_inertia") - 1 for k in range(1, int(2 * QUARTER))]
    return 100 * abs(suite.worst((course.turn(90) / turn(theirs, 90) - 1, *shapes)))


FLUID = (16, 32, 64)


def peers(whole):
    """whole: number of resolutions of the slice that are run to the end."""
    return {"PySPH, TVF, plane": Peer(2, FLUID), "PySPH, TVF, slice": Peer(3, FLUID[:whole], FLUID[whole:])}


def plates(step, whole):
    """step: strain of slightly less than a hundredth of the run, so that the last step ends at the end and not just before it."""
    return {"paper": Line(PAPER, FLUID), "explicit, plain": Line(PLAIN, FLUID), "explicit, corrected": Line(VERLET, FLUID), "RKL2": Line(RKL2, FLUID),
            "implicit, 100 steps": Line(implicit(step), FLUID), "implicit, 400 steps": Line(implicit(step / 4), FLUID), **peers(whole)}


HELD = [NUMERICS + "/shifting=none"]  # nothing moves far in these flows
MORE_INERTIA = ["constant/flow.yaml:/inertia/Re=0.1"]
LESS_INERTIA = ["constant/flow.yaml:/inertia/Re=0.01"]
SPHERES = (6, 8, 12, 24)
CELLS = (4, 6, 8)


def sheared(*coarser, further=1):
    """Lines of a cell. coarser: resolutions below those of CELLS. further: of the paper's line."""
    all_ = (*coarser, *CELLS)
    return {"paper": Line(PAPER, all_[:-1], CELLS[-1:], further), "explicit, corrected": Line(VERLET, all_[:-1], CELLS[-1:]),
            "implicit, step 0.1": Line(implicit(0.1, "3e-3"), all_), "implicit, step 0.05": Line(implicit(0.05, "3e-3"), all_)}


DIAGRAMS = {
    "couette": Diagram("flow", plates(2.8e-5, 2), largest()),
    "poiseuille": Diagram("flow", plates(6.2e-5, 1), largest()),
    "taylorGreen2D": Diagram("flow", {
        "paper": Line(PAPER, FLUID), "explicit, plain": Line(PLAIN, FLUID), "explicit, corrected": Line(VERLET, FLUID), "RKL2": Line(RKL2, FLUID),
        "implicit, step 0.1": Line(implicit(0.1), FLUID), "implicit, step 0.05": Line(implicit(0.05), FLUID),
        **peers(1)}, largest("until 1/e", "viscosity felt")),
    "sphereArray": Diagram("c0.125", {
        "paper": Line([*PAPER, *HELD], SPHERES[:3], SPHERES[3:]), "explicit, plain": Line([*PLAIN, *HELD], SPHERES[:3], SPHERES[3:]),
        "implicit, 6 steps": Line([], SPHERES), "implicit, 24 steps": Line(lambda run: [scaled(run, NUMERICS + "/implicit/step", 0.25)], SPHERES)},
        drag, oneFraction, "c = 0.125"),
    "capsuleSkalak": Diagram("Ca0.3", {
        **sheared(3), "implicit, step 0.05, Re 0.01": Line(LESS_INERTIA, (6, 8, 12))},
        largest("D12", "period"), what="Ca 0.3", settings=MORE_INERTIA),
    "redCellShear": Diagram("Ca0.02", {
        **sheared(further=1.3), "implicit, step 0.05, Re 0.01": Line([*LESS_INERTIA, *implicit(0.05, "3e-3")], CELLS)},
        turned, quarter, "Ca 0.02", MORE_INERTIA),
}
COLOURS = ("paper", "explicit, plain", "explicit, corrected", "RKL2")  # the first ones of gnuplot; other schemes have the next ones, in order
COLUMNS = ("case", "scheme", "resolution", "particles", "error_percent", "coreSeconds", "part", "machine", "date")


def recorded(path=HERE / "results.csv"):
    if not path.exists():
        return []
    with open(path) as text:
        return list(csv.DictReader(text))


def keep(name, scheme, n, record, part, error, machine, day):
    """part: fraction of the run that was made, above 1 where it was longer; core-seconds are scaled to the full run."""
    point = {"case": name, "scheme": scheme, "resolution": n, "particles": round(record["parameters"]["particles"]),
             "error_percent": "" if error is None else f"{error:.4g}", "coreSeconds": f"{record['performance']['processorSeconds'] / part:.3g}",
             "part": f"{part:.3g}", "machine": machine, "date": day}
    points = [p for p in recorded() if any(p[key] != str(point[key]) for key in ("case", "scheme", "resolution"))] + [point]
    points.sort(key=lambda p: (list(DIAGRAMS).index(p["case"]), list(DIAGRAMS[p["case"]].lines).index(p["scheme"]), int(p["resolution"])))
    with open(HERE / "results.csv", "w") as text:
        writer = csv.DictWriter(text, COLUMNS, lineterminator="\n")
        writer.writeheader()
        writer.writerows(points)


def loaded(name):
    case = suite.load(name)
    DIAGRAMS[name].prepare(case)
    return case


def measure(name, scheme, n, binaries, ranks, folder, begin):
    """One point by Corpuscle."""
    diagram, case = DIAGRAMS[name], loaded(name)
    line = diagram.lines[scheme]
    (run,) = (run for run in case.runs(n) if run.name == diagram.run)
    own = line.settings(run) if callable(line.settings) else line.settings
    begun = begin or n in line.begun
    part = PART if begun else line.further
    if part != 1:
        end = next(path for setting in run.settings if (path := setting.split("=")[0]).startswith("system/control.yaml:/end"))
        own = [*own, scaled(run, end, part)]
    run = replace(run, settings=[*run.settings, *diagram.settings, *own])
    done = {run.name: folder / (f"begun-{run.name}" if begun else run.name)}
    record = suite.execute(run, done[run.name], binaries, ranks)
    error = None if begun else diagram.error(case, done, n)
    if error is not None and not math.isfinite(error):
        sys.exit(f"workPrecision.py: {name}, {scheme}, {n}: the run ended before what its error is read from; let it go further")
    keep(name, scheme, n, record, part, error, *suite.origin(record)[:2])


def measurePeer(name, scheme, n, folder, begin):
    """One point by PySPH; for a run that is only begun, its full number of steps is known."""
    if subprocess.run([PYTHON, "-c", "import pysph"], capture_output=True).returncode:
        print("workPrecision.py: no python3-pysph; its lines are left as they are")
        return
    line = DIAGRAMS[name].lines[scheme]
    begun = begin or n in line.begun
    folder = folder / ("begun" if begun else "flow")
    note = folder / "run.json"
    if not note.exists():
        more = ["-steps", "20"] if begun else []
        subprocess.run([PYTHON, HERE / "pysphPeer.py", name, str(n), folder, "-dimensions", str(line.dimensions), *more], check=True)
        where = {"machine": suite.machine(), "day": datetime.date.today().isoformat()}
        note.write_text(json.dumps({**json.loads(note.read_text()), **where}, indent=1) + "\n")
    old = {"machine": suite.machine(), "day": datetime.date.fromtimestamp(note.stat().st_mtime).isoformat()}  # for runs that have not recorded it
    record = {**old, **json.loads(note.read_text())}
    part = record["performance"]["steps"] / record["performance"]["stepsToEnd"] if begun else 1
    keep(name, scheme, n, record, part, None if begun else DIAGRAMS[name].error(loaded(name), {"flow": folder}, n),
         record["machine"], record["day"])


def title(name):
    what = DIAGRAMS[name].what
    return suite.load(name).TITLE + (f", {what}" if what else "")


def draw(name):
    """One diagram a case: lines of schemes over resolutions; a scheme has its colour in every diagram."""
    points = [p for p in recorded() if p["case"] == name and p["error_percent"]]
    if not points:
        return
    blocks, lines, across = [], [], suite.load(name).ACROSS
    for scheme in dict.fromkeys(p["scheme"] for p in points):
        line = [f"{p['coreSeconds']} {p['error_percent']} {p['resolution']}" for p in points if p["scheme"] == scheme]
        k = COLOURS.index(scheme) if scheme in COLOURS else len(COLOURS) + len([other for other in blocks if other[0] not in COLOURS])
        blocks.append((scheme, f"$d{k} << E\n" + "\n".join(line) + "\nE"))
        lines += [f"$d{k} with linespoints pt 7 lw 2 lc {k + 1} title '{scheme}'",
                  f"$d{k} using 1:2:3 with labels offset 0.6,0.6 font ',8' tc lt {k + 1} notitle"]
    for terminal, ending in (("pngcairo size 900,600 font ',11'", "png"), ("svg size 900,600 font ',11'", "svg")):
        script = [f"set terminal {terminal}", f"set output '{HERE / name}.{ending}'", "set logscale xy", "set grid lt 1 lw 0.5 lc rgb '#dddddd'",
                  "set xlabel 'core-seconds'", "set ylabel 'error, %'", f"set title '{title(name)} (numbers: {across})'",
                  "set key outside right", "set linetype 5 lc rgb '#8b4513'", *(block for _, block in blocks), "plot " + ", ".join(lines)]
        subprocess.run(["gnuplot"], input="\n".join(script) + "\n", text=True, check=True)


def cell(point):
    if float(point["part"]) < 1:
        return f"({float(point['coreSeconds']):g} s)"
    return f"{point['error_percent']} %, {float(point['coreSeconds']):g} s"


def tables():
    """Into README.md, between its marks."""
    lines = []
    for name in DIAGRAMS:
        points = [p for p in recorded() if p["case"] == name]
        if not points:
            continue
        sizes = sorted({int(p["resolution"]) for p in points})
        lines += [f"### {title(name)}", "", f"![error against core-seconds]({name}.png)", "", f"[As SVG]({name}.svg).", "",
                  "| scheme | " + " | ".join(f"{n} {suite.load(name).ACROSS}" if n == sizes[0] else str(n) for n in sizes) + " |",
                  "|---|" + "---|" * len(sizes)]
        for scheme in dict.fromkeys(p["scheme"] for p in points):
            cells = {int(p["resolution"]): cell(p) for p in points if p["scheme"] == scheme}
            lines.append(f"| {scheme} | " + " | ".join(cells.get(n, "") for n in sizes) + " |")
        days = sorted({p["date"] for p in points})
        lines += ["", f"{'; '.join(sorted({p['machine'] for p in points}))}; {' to '.join(dict.fromkeys((days[0], days[-1])))}.", ""]
    page = HERE / "README.md"
    before, rest = page.read_text().split(suite.MARKS[0])
    page.write_text(before + suite.MARKS[0] + "\n\n" + "\n".join(lines) + suite.MARKS[1] + rest.split(suite.MARKS[1])[1])


def option(words, name):
    """The word after `name`; both are removed from words. None where `name` is absent."""
    if name not in words:
        return None
    k = words.index(name)
    value = words[k + 1]
    del words[k : k + 2]
    return value


def main(words):
    if words != ["-draw"]:
        ranks, only, size = int(option(words, "-np") or 1), option(words, "-scheme"), option(words, "-resolution")
        begin = "-begin" in words
        binaries, directory, *names = (word for word in words if word != "-begin")
        for name in names or DIAGRAMS:
            if name not in DIAGRAMS:
                sys.exit(f"workPrecision.py: no case '{name}'; there are {', '.join(DIAGRAMS)}")
            for scheme, line in DIAGRAMS[name].lines.items():
                for n in sorted((*line.resolutions, *line.begun)):
                    if only in (None, scheme) and size in (None, str(n)):
                        folder = pathlib.Path(directory).resolve() / scheme.replace(" ", "") / name / str(n)
                        if isinstance(line, Peer):
                            measurePeer(name, scheme, n, folder, begin)
                        else:
                            measure(name, scheme, n, pathlib.Path(binaries).resolve(), ranks, folder, begin)
    for name in DIAGRAMS:
        draw(name)
    tables()


if __name__ == "__main__":
    main(sys.argv[1:])
