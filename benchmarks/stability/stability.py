#!/usr/bin/env python3
"""Stability map: several hundred short runs of a sheared box, a capsule and a red cell, each judged against its twin with a finer step.

    stability.py BIN DIRECTORY [-jobs 1] [-stage N] [-only WORD ...] [-seconds S]
    stability.py -draw                       maps and tables of what results.csv holds, without running

BIN: directory of the programs, with limitFlow (cmake -DCORPUSCLE_BENCHMARKS=ON). DIRECTORY keeps what each run left, NAME.json; what is there is not run
again, so a stopped batch goes on. Runs are in stages, coarse first; -stage N: up to this one; -only: names that contain all of the words; -seconds: no
new run is begun after so many core-seconds. results.csv has a row for each run, with its verdict:
    stable       it ended, and is within the tolerances below of its twin
    inaccurate   it ended, outside one of them; the first to be left, and at which strain, is its sign
    failed       it did not end: exit code 3, or more than LARGEST core-seconds; the message's kind is its sign
"""
import argparse
import concurrent.futures
import csv
import datetime
import json
import math
import pathlib
import re
import resource
import shutil
import subprocess
import sys
import tempfile
import threading

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
sys.path[:0] = [str(HERE), str(ROOT / "tests" / "validation"), str(ROOT / "tutorials")]
import scenes
import suite
import vtp
from summary import series

LARGEST = 150  # core-seconds of a run
SHAPE, SHAPE_FLOOR = 0.02, 0.002  # of D12 and inclination: |D exp(2i theta) - that of the twin| over the twin's largest D; a difference that is always allowed
VOLUME, AREA, STRESS, ENERGY = 0.005, 0.01, 0.02, 0.05  # drift; difference to the twin; of the mean wall stress; of kinetic energy
DENSITY = 0.05  # deviation of a particle's density from its rest density; or twice that of the twin, if larger
SETTLED = 0.5  # strain from which shape, area and energy of the implicit step count: on the jump at the start, an undeformed membrane in a flow, it rings
NOISE = 0.005  # of velocities about the linear profile, in the box: rms over the walls' speed, above the twin's
KINDS = (  # of messages with exit code 3
    ("comes within", "longer than its box"), ("too few neighbours", "particles without neighbours"), ("did not converge", "solver did not converge"),
    ("is lost", "lost particle"), ("no finite position", "not finite"), ("no fluid within", "node without fluid"), ("contour length", "bond beyond its length"),
    ("bond", "bonds change too fast"), ("nan", "not finite"), ("inf ", "not finite"), ("has diverged", "density runs away"))
COLUMNS = ("run", "map", "scene", "scheme", "axis", "value", "Ca", "Re", "lambda", "step", "limit", "times", "ranks", "verdict", "sign", "strainOfSign",
           "shapeError", "volumeDrift", "areaError", "stressError", "densityOff", "noise", "changedSide", "halvings", "iterationsPerStep", "mostIterations",
           "smallestStep", "boundBy", "steps", "coreSeconds", "twin", "message", "machine", "date")


# Running

def filling(run):
    """The settings on which meshes and particles depend; runs with the same settings share them."""
    kept = [text for text in run.settings if text.startswith((scenes.MESH, scenes.NUMERICS + "spacing", scenes.NUMERICS + "kernel", scenes.NUMERICS + "coupling"))]
    return json.dumps([run.scene, sorted(kept)])


class Batch:
    def __init__(self, binaries, directory):
        self.binaries, self.directory = binaries, directory
        self.fillings, self.lock, self.spent, self.machine = {}, threading.Lock(), 0.0, suite.machine()
        directory.mkdir(parents=True, exist_ok=True)
        self.scratch = pathlib.Path(tempfile.mkdtemp(prefix="work.", dir=directory))
        known = subprocess.run([binaries / "listModels", "numerics"], capture_output=True, text=True).stdout if (binaries / "listModels").exists() else ""
        self.always = ["-set", "system/numerics.yaml:/rollbacks=0"] if "rollbacks" in known else []  # failures must show
        self.environment = suite.ENVIRONMENT

    def call(self, run, case, program, ranks=1, more=()):
        """Exit code and standard error of a program."""
        command = [str(self.binaries / program), "-case", str(case), "-quiet", *(word for text in run.settings for word in ("-set", text)), *self.always, *more]
        if ranks > 1:
            command = ["mpirun", "-np", str(ranks), *command]
        limit = lambda: resource.setrlimit(resource.RLIMIT_CPU, (LARGEST, LARGEST + 5))
        ended = subprocess.run(command, env=self.environment, capture_output=True, text=True, preexec_fn=limit)
        return ended.returncode, ended.stderr.strip()

    def copied(self, run, case):
        tutorial, cell, _, _ = scenes.SCENES[run.scene]
        for folder in ("system", "constant"):
            shutil.copytree(ROOT / "tutorials" / tutorial / folder, case / folder)
        (case / "system" / "observers.yaml").write_text(scenes.observers(run))
        for name, text in ({} if cell else scenes.BOX_FILES).items():
            (case / name).write_text(text)
        if cell:
            control = case / "system" / "control.yaml"
            control.write_text("".join(line for line in control.read_text().splitlines(True) if not line.startswith("stop:")))

    def filled(self, run):
        key = filling(run)
        with self.lock:
            if isinstance(self.fillings.get(key), str):
                raise RuntimeError(self.fillings[key])
            if key in self.fillings:
                return self.fillings[key]
            case = self.scratch / f"filling{len(self.fillings)}"
            self.copied(run, case)
            for program in (("membraneMesh",) if scenes.SCENES[run.scene][1] else ()) + ("particleFill",):
                code, said = self.call(run, case, program)
                if code:
                    self.fillings[key] = f"{program}: {said}"
                    raise RuntimeError(self.fillings[key])
            self.fillings[key] = case / "0"
            return case / "0"

    def make(self, run):
        case = self.scratch / run.name
        self.copied(run, case)
        (case / "0").symlink_to(self.filled(run))
        program = "limitFlow" if run.limit else "dmpFlow" if scenes.SCENES[run.scene][1] else "sphFlow"
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        code, said = self.call(run, case, program, run.ranks, run.options)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        if code in (1, 2, 4):
            raise RuntimeError(f"{program}: {said}")
        left = {"run": run.name, "settings": run.settings, "options": run.options, "code": code, "message": said.splitlines()[-1] if said else "",
                "date": datetime.date.today().isoformat(), "machine": self.machine, **gathered(case, run, code)}
        if not left["coreSeconds"]:
            left["coreSeconds"] = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
        part = self.directory / (run.name + ".part")
        part.write_text(json.dumps(left))
        part.rename(self.directory / (run.name + ".json"))
        shutil.rmtree(case)
        with self.lock:
            self.spent += left["coreSeconds"]
        return left


def gathered(case, run, code):
    """The results of a run: its record, its curves, and for the box the scatter of velocities at the end."""
    record = json.loads((case / "run.json").read_text()) if (case / "run.json").exists() else {}
    performance = record.get("performance", {})
    log = next(case.glob("log.*Flow")).read_text()
    binding = [line.split("  ")[0].strip() for line in log.splitlines() if line.rstrip().endswith("binding") or " binding:" in line]
    curves = {}
    for observer, file in (("deformation", "*.csv"), ("balance", "conservation.csv"), ("wall", "wallStress.csv")):
        try:
            curves[observer] = series(case, observer, file)
        except (SystemExit, ValueError):
            curves[observer] = []
    noise = None
    if not scenes.SCENES[run.scene][1] and code == 0:
        pieces = sorted((case / "results").glob("fluid/*.vtp")) or sorted((case / "results").glob("**/fluid*.vtp"))
        last = [vtp.File(piece) for piece in pieces if piece.parent == pieces[-1].parent]  # of all ranks
        points = [point for piece in last for point in piece.points]
        velocities = [u for piece in last for u in piece.arrays["velocity"]]
        gap = max(point[2] for point in points) - min(point[2] for point in points)
        squares = [(u - scenes.RATE * z)**2 + v * v + w * w for (_, _, z), (u, v, w) in zip(points, velocities)]
        noise = math.sqrt(sum(squares) / len(squares)) / (scenes.RATE * gap / 2)
    return {"shearRate": record.get("parameters", {}).get("shearRate_1_s"), "boundBy": binding[0] if binding else "", "noise": noise, "curves": curves, "halvings": performance.get("halvings"),
            "iterationsPerStep": performance.get("iterationsPerStep"), "mostIterations": record.get("extremes", {}).get("mostIterations"),
            "steps": performance.get("steps"), "smallestStep": smallest(record), "coreSeconds": performance.get("processorSeconds", 0)}


def smallest(record):
    """The shortest step, as a strain."""
    step, rate = record.get("extremes", {}).get("smallestStep_s"), record.get("parameters", {}).get("shearRate_1_s")
    return step * rate if step and rate else None


# Judging

def kind(left):
    if left["code"] < 0 or left["code"] > 100:
        return f"more than {LARGEST} core-seconds"
    text = left["message"].lower()
    return next((name for part, name in KINDS if part in text), left["message"][:60])


def finite(row):
    return all(math.isfinite(value) for value in row.values())


def deviator(row):
    return complex(row["D12_inertia"] * math.cos(2 * row["inclination_rad"]), row["D12_inertia"] * math.sin(2 * row["inclination_rad"]))


def late(curve, end):
    """Mean effective viscosity over the second half of the strains to `end`, between looks along straight lines, so that it does not depend on where these fall."""
    strains = [0.5 * end, *(row["strain"] for row in curve if 0.5 * end < row["strain"] < end), end]
    values = [suite.at(curve, strain, "effectiveViscosity") for strain in strains]
    return sum(0.5 * (a + b) * (t - s) for s, t, a, b in zip(strains, strains[1:], values, values[1:])) / (0.5 * end)


def judge(run, left, twin):
    """Verdict, sign, strain of the sign and the figures of a run; twin: results of its twin, if they can be used."""
    curves, found, figures = left["curves"], [], {}
    shape, balance, wall = curves["deformation"], curves["balance"], curves["wall"]
    theirs = twin["curves"] if twin else None
    for rows in (balance, wall, *([shape] if run.axis != "rupture" else [])):  # an open cell has no shape
        found += [("not finite", row["strain"]) for row in rows if not finite(row)][:1]
    balance, shape = [r for r in balance if run.axis == "rupture" or finite(r)], [r for r in shape if finite(r)]

    def look(name, values, allowed, word):
        """values: (strain, value); the largest value is added to the figures, the first value outside the tolerance to the signs."""
        values = [(t, v) for t, v in values if math.isfinite(v)]
        if values:
            figures[name] = max(abs(v) for _, v in values)
        found.extend([(word, t) for t, v in values if abs(v) > allowed][:1])

    off = [(row["strain"], max(1 - row["density_min"], row["density_max"] - 1)) for row in balance]
    most = max([DENSITY, *(2 * max(1 - row["density_min"], row["density_max"] - 1) for row in theirs["balance"] if finite(row))]) if theirs else DENSITY
    look("densityOff", off, most, "density off")
    if balance and "volumeChange" in balance[0] and not run.axis == "rupture":
        look("volumeDrift", [(row["strain"], row["volumeChange"]) for row in balance], VOLUME, "volume drifts")
    if balance and "changedSide" in balance[0]:
        figures["changedSide"] = max(row["changedSide"] for row in balance) + balance[-1]["guardMoves"]
        if "dual" not in run.scheme and run.axis != "rupture":  # an open cell has no sides
            found.extend([("particles change side", row["strain"]) for row in balance if row["changedSide"] > 0][:1])
    every = balance
    if theirs:
        if not run.times:
            shape, balance = ([row for row in rows if row["strain"] > SETTLED - 1e-9] for rows in (shape, balance))
        if shape:
            scale = max(row["D12_inertia"] for row in theirs["deformation"])
            pairs = [(row["strain"], abs(deviator(row) - suite.at(theirs["deformation"], row["strain"], deviator)) / scale) for row in shape]
            look("shapeError", pairs, SHAPE + SHAPE_FLOOR / scale, "shape off")
            look("areaError", [(row["strain"], row["areaChange"] - suite.at(theirs["balance"], row["strain"], "areaChange")) for row in balance], AREA, "area off")
        look("energy", [(row["strain"], row["kineticEnergy_J"] / suite.at(theirs["balance"], row["strain"], "kineticEnergy_J") - 1) for row in balance],
             ENERGY, "kinetic energy off")
        if left["code"] == 0 and wall:
            end = min(wall[-1]["strain"], theirs["wall"][-1]["strain"])
            figures["stressError"] = abs(late(wall, end) / late(theirs["wall"], end) - 1)
            if not figures["stressError"] <= STRESS:
                found.append(("wall stress off", wall[-1]["strain"]))
    if left["noise"] is not None:
        figures["noise"] = left["noise"]
        if left["noise"] > NOISE + (twin["noise"] or 0 if twin else 0.02):
            found.append(("velocities scatter", every[-1]["strain"]))
    found.sort(key=lambda sign: sign[1])
    if left["code"] != 0:
        first = f"{found[0][0]}, then " if found else ""
        return "failed", first + kind(left), found[0][1] if found else ended(left, every), figures
    if found:
        return "inaccurate", found[0][0], found[0][1], figures
    return "stable", "", None, figures


def ended(left, balance):
    """Strain at which a run failed: from its message, otherwise from the last row."""
    time = re.search(r"t = ([-+.e\d]+) s", left["message"])
    if time and left["shearRate"]:
        return float(time[1]) * left["shearRate"]
    return balance[-1]["strain"] if balance else 0.0


def shown(value):
    return "" if value is None else f"{value:.4g}" if isinstance(value, float) else str(value)


def row(run, left, twin):
    verdict, sign, strain, figures = judge(run, left, twin)
    values = {"run": run.name, "map": run.group, "scene": run.scene, "scheme": run.scheme, "axis": run.axis, "value": run.value, "Ca": run.Ca, "Re": run.Re,
              "lambda": run.ratio, "step": run.step, "limit": run.limit, "times": run.times, "ranks": run.ranks, "verdict": verdict, "sign": sign,
              "strainOfSign": strain, **figures, "twin": run.twin, **{key: left[key] for key in (
                  "halvings", "iterationsPerStep", "mostIterations", "smallestStep", "boundBy", "steps", "coreSeconds", "message", "machine", "date")}}
    if run.times:
        values["smallestStep"] = None  # the record has that of the limits, not the multiple taken
    return {key: shown(values.get(key)) for key in COLUMNS}


def tabulate(directory, runs):
    """Writes results.csv from all that DIRECTORY holds, except runs that ended while their twin did not end or has not been run."""
    kept = {run.name: json.loads(path.read_text()) for run in runs if (path := directory / (run.name + ".json")).exists()}
    def twinOf(run):
        twin = kept.get(run.twin)
        return twin if twin and twin["code"] == 0 else None
    table = [row(run, kept[run.name], twinOf(run)) for run in runs
             if run.name in kept and (kept[run.name]["code"] or len(kept[run.name]["curves"]["balance"]) > 2) and (not run.twin or twinOf(run) or kept[run.name]["code"])]
    with open(HERE / "results.csv", "w") as text:
        writer = csv.DictWriter(text, COLUMNS, lineterminator="\n")
        writer.writeheader()
        writer.writerows(sorted(table, key=lambda r: r["run"]))
    return table


def main(words):
    parser = argparse.ArgumentParser(usage=__doc__)
    parser.add_argument("binaries", type=pathlib.Path)
    parser.add_argument("directory", type=pathlib.Path)
    parser.add_argument("-jobs", type=int, default=1)
    parser.add_argument("-stage", type=int, default=99)
    parser.add_argument("-seconds", type=float, default=math.inf)
    parser.add_argument("-only", nargs="+", default=[])
    asked = parser.parse_args(words)
    directory = asked.directory.resolve()
    batch, runs = Batch(asked.binaries.resolve(), directory), scenes.everyRun()
    wanted = [run for run in runs if run.stage <= asked.stage and all(word in run.name for word in asked.only) and not (directory / (run.name + ".json")).exists()]

    def one(run):
        if batch.spent > asked.seconds:
            return
        try:
            left = batch.make(run)
        except RuntimeError as error:  # not a verdict: the case cannot be run as it stands
            print(f"{run.name}: not run: {error}", flush=True)
            return
        print(f"{run.name:90s} {left['code']} {left['coreSeconds']:.1f} s {left['message'][:100]}", flush=True)
    try:
        with concurrent.futures.ThreadPoolExecutor(asked.jobs) as pool:
            for done in [pool.submit(one, run) for run in wanted]:
                done.result()
    finally:
        shutil.rmtree(batch.scratch, ignore_errors=True)
        counts = {}
        for line in tabulate(directory, runs):
            counts[line["verdict"]] = counts.get(line["verdict"], 0) + 1
        print(counts, f"{batch.spent:.0f} core-seconds now")


if __name__ == "__main__":
    if sys.argv[1:] == ["-draw"]:
        import maps

        maps.draw()
    else:
        main(sys.argv[1:])
