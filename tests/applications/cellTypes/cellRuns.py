"""Every cell type of etc/cells runs in the main tutorial's flow, made coarse, at 1, 100 and 5,000 1/s to strain 0.5, by one key of a dictionary.

    python3 cellRuns.py BIN [CELL]
"""
import concurrent.futures
import csv
import json
import math
import os
import pathlib
import subprocess
import sys
import tempfile

CELLS = sorted(file.stem for file in (pathlib.Path(__file__).parents[3] / "etc" / "cells").glob("*.yaml"))
RATES = (1, 100, 5000)
EDGE = {"platelet": 0.5}  # um; 0.8 for the others
CASE = {
    "system/control.yaml": "application: dmpFlow\nstartFrom: firstTime\nendStrain: 0.5\ncheckpoint: {wallClock: never}\n",
    "system/numerics.yaml": "spacing: SPACING um\nkernel: {type: wendlandC2, support: 2.4 dx}\nintegrator: implicit\ncoupling: immersed\n"
                            "operators: corrected\nshifting: {coefficient: 1}\nimplicit: {step: 0.05, tolerance: 3e-3}\n",
    "system/mesh.yaml": "domain: {size: [12 um, 10.5 um, 12 um], periodic: [true, true, false]}\ncells: [{name: rbc, cell: CELL, edge: EDGE um}]\n",
    "system/observers.yaml": "deformation: {type: shape, every: 0.1 strain}\nbalance: {type: conservation, every: 0.1 strain}\n",
    "constant/fluid.yaml": "density: 1000 kg/m^3\nviscosity: 1.0e-3 Pa s\n",
    "constant/flow.yaml": "type: shear\nshearRate: 100 1/s\nwalls: {normal: z}\n",
}
ENVIRONMENT = dict(os.environ, OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")


def check(programs, cell, case):
    edge = EDGE.get(cell, 0.8)
    for name, text in CASE.items():
        (case / name).parent.mkdir(parents=True, exist_ok=True)
        (case / name).write_text(text.replace("CELL", cell).replace("EDGE", str(edge)).replace("SPACING", "0.5" if edge < 0.8 else "0.75"))

    def run(program, *options):
        return subprocess.run([programs / program, "-case", case, "-quiet", *options], capture_output=True, text=True, timeout=600, env=ENVIRONMENT)

    faults = []
    for program in ("checkCase", "membraneMesh", "particleFill"):
        done = run(program)
        if done.returncode != 0:
            return [f"{cell}: {program} ends with {done.returncode}: {done.stderr}"]
    for rate in RATES:
        done = run("dmpFlow", "-set", f"constant/flow.yaml:/shearRate={rate} 1/s")
        what = f"{cell} at {rate} 1/s"
        if done.returncode != 0:
            faults.append(f"{what}: exit code {done.returncode}: {done.stderr}")
            continue
        record = json.loads((case / "run.json").read_text())
        with open(case / "postProcessing/deformation/rbc.csv") as file:
            rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
        D = float(rows[-1]["D12_inertia"])
        print(f"{what}: {record['performance']['steps']} steps, {record['performance']['wallClock_s']:.1f} s, "
              f"{record['performance']['rollbacks']} rollbacks, D12 {float(rows[0]['D12_inertia']):.4f} -> {D:.4f}", flush=True)
        if record["result"]["strain"] != 0.5 or len(rows) != 6:
            faults.append(f"{what}: ended at strain {record['result']['strain']} with {len(rows)} rows")
        if not math.isfinite(D) or D > 0.9:
            faults.append(f"{what}: D12 = {D}")
        used = (case / "used.yaml").read_text()
        if f"{cell}:\n" not in used or "viscosityRatio" not in used:
            faults.append(f"{what}: used.yaml lacks the laws of '{cell}'")
    return faults


def main():
    programs = pathlib.Path(sys.argv[1])
    cells = sys.argv[2:] or CELLS
    with tempfile.TemporaryDirectory() as folder, concurrent.futures.ThreadPoolExecutor(2) as pool:
        faults = [fault for found in pool.map(lambda c: check(programs, c, pathlib.Path(folder) / c), cells) for fault in found]
    print("\n".join(faults) or f"{len(cells)} cell types run")
    return 1 if faults or not cells else 0


if __name__ == "__main__":
    sys.exit(main())
