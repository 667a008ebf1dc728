#!/usr/bin/env python3
"""A hundred faults injected into running cases, and their outcome.

    faults.py [-bin DIR] [-work DIR] [-only N]

A fault is one of five kinds (tests/simulation/faultInjection.cpp) at a random place before a random step; one in eleven is repeated each time that
the run gets to this step. Each run ends as one of

    rolled back   detected and rolled back; the final state is within the tolerance of the run without fault
    tolerated   not detected, but the final state is within the tolerance
    reported    exit code 3, with a report and a checkpoint of the last good state
    wrong       exit code 0 and another final state: must not occur
    crashed     any other end of the run: must not occur

A row is added to faults.csv beside this file when a run ends; runs that have a row are not made again. The table in README.md is written anew.
"""
import argparse
import csv
import datetime
import json
import os
import pathlib
import random
import shutil
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
sys.path.insert(0, str(ROOT / "tests" / "validation"))
import suite  # noqa: E402

MARKS = ("<!-- tally: written by faults.py -->", "<!-- end of tally -->")
KINDS = ("nan", "speed", "density", "node", "triangle")
COUNT = 100
STRAIN = 0.5
CAPSULE = ["system/mesh.yaml:/domain/size=[20 um, 16 um, 16 um]", "system/numerics.yaml:/spacing=1 um", "system/mesh.yaml:/cells/0/edge=0.8 um",
           f"system/control.yaml:/endStrain={STRAIN + 0.02}", "system/control.yaml:/write={}", "constant/flow.yaml:/Ca=0.3",
           "system/observers.yaml:/deformation/every=0.01 strain", "system/observers.yaml:/balance/every=0.01 strain"]
SCENES = {  # with a capsule of radius 4 um: settings, share of the faults
    "implicit": (CAPSULE + ["system/numerics.yaml:/implicit/step=0.02"], 3),
    "velocityVerlet": (CAPSULE + ["system/numerics.yaml:/integrator=velocityVerlet", "constant/flow.yaml:/inertia/Re=0.5"], 1),
    "dualIdentity": (CAPSULE + ["system/numerics.yaml:/integrator=velocityVerlet", "system/numerics.yaml:/coupling=dualIdentity",
                                "system/numerics.yaml:/operators=plain", "system/numerics.yaml:/kernel/support=3 dx",
                                "constant/flow.yaml:/inertia/Re=0.5"], 1),
}
TOLERANCE = {"D12_inertia": 0.005, "volume": 0.001}  # relative to the value without fault
COLUMNS = ("number", "scene", "kind", "step", "seed", "again", "ranks", "end", "rollbacks", "D12", "volume", "exitCode", "message")


def prepare(scene, words):
    """The case of a scene with its initial state, made once, and its run without fault."""
    folder, calm = words.work / scene / "start", words.work / scene / "calm"
    settings = suite.sets(SCENES[scene][0])
    if not folder.exists():
        for part in ("system", "constant"):
            shutil.copytree(suite.TUTORIALS / "capsuleShear" / part, folder / part)
        for program in ("membraneMesh", "particleFill"):
            subprocess.run([words.bin / program, "-quiet", "-case", folder, *settings], check=True)
    if not (calm / "run.json").exists() or json.loads((calm / "run.json").read_text())["status"] != "done":
        shutil.rmtree(calm, ignore_errors=True)
        shutil.copytree(folder, calm)
        subprocess.run([words.bin / "faultInjection", "-quiet", "-case", calm, *settings, "-at", "100000000"], check=True)
    return folder, settings, end(calm)


def end(folder):
    """Shape and volume at the strain of comparison; runs end up to a step later."""
    (shape,) = folder.glob("postProcessing/deformation/*.csv")
    balance = suite.rows(folder / "postProcessing/balance/conservation.csv")
    return {"D12_inertia": suite.at(suite.rows(shape), STRAIN, "D12_inertia"), "volume": 1 + suite.at(balance, STRAIN, "volumeChange")}


def faults():
    """The hundred faults, the same at every call."""
    choice = random.Random(2026)
    order = [scene for scene, (_, share) in SCENES.items() for _ in range(share)]
    for number in range(COUNT):
        yield {"number": number, "scene": order[(number // len(KINDS)) % len(order)], "kind": KINDS[number % len(KINDS)],
               "at": choice.random(), "seed": choice.randrange(1, 10**6), "again": int(number % 11 == 7), "ranks": 1 + number // 50}


def left(folder):
    """run.json of a run; empty if the program ended before writing it."""
    try:
        return json.loads((folder / "run.json").read_text())
    except (OSError, ValueError):
        return {}


def run(fault, words):
    start, settings, expected = prepare(fault["scene"], words)
    calm = json.loads((words.work / fault["scene"] / "calm" / "run.json").read_text())
    step = 1 + int(0.9 * fault["at"] * calm["performance"]["steps"])  # before the strain at which ends are compared
    folder = words.work / fault["scene"] / f"fault{fault['number']:03d}"
    shutil.rmtree(folder, ignore_errors=True)
    shutil.copytree(start, folder)
    command = [words.bin / "faultInjection", "-quiet", "-case", folder, *settings, "-kind", fault["kind"], "-at", str(step), "-seed", str(fault["seed"])]
    if fault["again"]:
        command.append("-always")
    if fault["ranks"] > 1:
        command = ["mpirun", "-np", str(fault["ranks"]), *command]
    done = subprocess.run(command, capture_output=True, text=True, env=suite.ENVIRONMENT)
    record = left(folder)
    row = {**fault, "step": step, "exitCode": done.returncode, "rollbacks": record.get("performance", {}).get("rollbacks", 0), "D12": "", "volume": "",
           "message": ""}
    if done.returncode == 0 and record.get("status") == "done":
        found = end(folder)
        row["D12"], row["volume"] = (f"{found[key] / expected[key] - 1:+.2e}" for key in TOLERANCE)
        good = all(abs(found[key] / expected[key] - 1) <= allowed for key, allowed in TOLERANCE.items())
        row["end"] = ("rolled back" if row["rollbacks"] else "tolerated") if good else "wrong"
    else:
        reported = done.returncode == 3 and "fault" in record and list((folder / "checkpoints").glob("*.h5"))
        row["end"] = "reported" if reported else "crashed"
        row["message"] = " ".join(done.stderr.split())[-400:]
    if row["end"] not in ("wrong", "crashed"):
        shutil.rmtree(folder)
    return {key: row[key] for key in COLUMNS}


def tally(rows):
    ends = ("rolled back", "tolerated", "reported", "wrong", "crashed")
    lines = ["| fault | " + " | ".join(ends) + " | largest difference of D12 |", "|---|" + "---|" * (len(ends) + 1)]
    for kind in (*KINDS, "all"):
        mine = [row for row in rows if kind in (row["kind"], "all")]
        found = [float(row["D12"]) for row in mine if row["D12"]]
        worst = abs(suite.worst(found)) if found else 0
        lines.append(f"| {kind} | " + " | ".join(str(sum(row["end"] == end_ for row in mine)) for end_ in ends) + f" | {100 * worst:.2g} % |")
    return "\n".join(lines)


def main():
    build = pathlib.Path(os.environ.get("CORPUSCLE_BUILD", ROOT / "build"))
    parser = argparse.ArgumentParser(allow_abbrev=False)
    parser.add_argument("-bin", type=pathlib.Path, default=build / "bin")
    parser.add_argument("-work", type=pathlib.Path, default=build / "faults")
    parser.add_argument("-only", type=int)
    words = parser.parse_args()
    words.bin, words.work = words.bin.resolve(), words.work.resolve()
    table = HERE / "faults.csv"
    with open(table) if table.exists() else open(os.devnull) as file:
        rows = list(csv.DictReader(file))
    known = {int(row["number"]) for row in rows}
    for fault in faults():
        if fault["number"] in known or words.only not in (None, fault["number"]):
            continue
        row = run(fault, words)
        print(f"{row['number']:3d} {row['scene']:15s}{row['kind']:9s} before step {row['step']:<7d}{row['end']:10s} {row['rollbacks']} rollbacks {row['D12']} {row['message']}",
              flush=True)
        rows.append({key: str(value) for key, value in row.items()})
        rows.sort(key=lambda other: int(other["number"]))
        with open(table, "w", newline="") as file:
            writer = csv.DictWriter(file, COLUMNS, lineterminator="\n")
            writer.writeheader()
            writer.writerows(rows)
    page = HERE / "README.md"
    before, rest = page.read_text().split(MARKS[0])
    page.write_text(f"{before}{MARKS[0]}\n\n{tally(rows)}\n\n{len(rows)} faults; `faults.py`, {suite.machine()}, {datetime.date.today().isoformat()}.\n\n{MARKS[1]}{rest.split(MARKS[1])[1]}")
    print(tally(rows))
    return 1 if any(row["end"] in ("wrong", "crashed") for row in rows) else 0


if __name__ == "__main__":
    sys.exit(main())
