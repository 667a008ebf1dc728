#!/usr/bin/env python3
"""Short table of a finished red-cell case, from its postProcessing/ and run.json.

    summary.py [CASE...]             a table for people (default: this directory)
    summary.py -csv CASE...          one row for each case, with a header

Needs the observers shape and conservation under the names deformation and balance. Drift is the largest change since the start.
"""
import csv
import glob
import json
import math
import os
import sys

COLUMNS = {  # name in the CSV file: text in the table
    "Ca": "Ca",
    "strain": "strain reached",
    "D12_extent_min": "D12 by extents, smallest",
    "D12_extent_max": "D12 by extents, largest",
    "D12_inertia_min": "D12 by inertia, smallest",
    "D12_inertia_max": "D12 by inertia, largest",
    "angleTurned_deg": "angle turned by the material [degrees]",
    "axisTurned_deg": "angle turned by the main axis [degrees]",
    "fullTurn_strain": "strain of its first full turn",
    "areaDrift": "largest change of area",
    "volumeDrift": "largest change of volume",
    "guardMoves": "particles moved back to their side",
    "changedSide": "particles on the wrong side, at most",
    "wallClock_s": "run time [s]",
}


def rows(path):
    """Numbers of a table by column. Comment lines are skipped, and so is a last line that is still being written."""
    with open(path) as text:
        lines = [line for line in text if not line.startswith("#") and line.endswith("\n")]
    return [{key: float(value) for key, value in row.items()} for row in csv.DictReader(lines)]


def series(case, observer, file):
    """Rows of an observer; file: may hold wildcards that fit one file."""
    found = glob.glob(os.path.join(case, "postProcessing", observer, file))
    if len(found) > 1:
        raise SystemExit(f"{case}: several tables {file} under postProcessing/{observer}: {', '.join(map(os.path.basename, sorted(found)))}")
    table = rows(found[0]) if found else []
    if len({row.get("cell") for row in table}) > 1:
        raise SystemExit(f"{found[0]} has rows of several cells, and this summary is of one")
    if not table:
        raise SystemExit(f"{case}: no {file} under postProcessing/{observer}: run the case, with this observer in system/observers.yaml")
    return table


def axisTurned(shape):
    """Angle [degrees] by which the main axis has turned with the flow, row by row. The axis has no direction, so it is followed from row to row."""
    angles = [0.0]
    for row in shape[1:]:
        angle = -math.degrees(row["inclination_rad"])
        angles.append(angle + 180 * math.floor((angles[-1] - angle) / 180 + 0.5))
    return angles


def strainOfTurn(shape, degrees=360):
    """Strain at which the main axis has turned by `degrees`; nan if it has not."""
    angles = axisTurned(shape)
    for (a, before), (b, after) in zip(zip(angles, shape), zip(angles[1:], shape[1:])):
        if a < degrees <= b:
            return before["strain"] + (after["strain"] - before["strain"]) * (degrees - a) / (b - a)
    return math.nan


def extreme(pick, values):
    """pick(values), nan if one of them is nan: min and max would ignore it or not, depending on its position."""
    values = list(values)
    return math.nan if any(map(math.isnan, values)) else pick(values)


def summary(case):
    with open(os.path.join(case, "run.json")) as text:
        run = json.load(text)
    shape = series(case, "deformation", "*.csv")
    balance = series(case, "balance", "conservation.csv")
    extremes = {f"{name}_{word}": extreme(pick, (row[name] for row in shape)) for name in ("D12_extent", "D12_inertia")
                for word, pick in (("min", min), ("max", max))}
    drift = lambda key: extreme(lambda values: max(values, key=abs), (row[key] for row in balance))
    return {
        "Ca": float(f"{run['groups']['Ca']:.6g}"),
        "strain": shape[-1]["strain"],
        **extremes,
        "angleTurned_deg": math.degrees(shape[-1]["angleTurned_rad"]),
        "axisTurned_deg": axisTurned(shape)[-1],
        "fullTurn_strain": strainOfTurn(shape),
        "areaDrift": drift("areaChange"),
        "volumeDrift": drift("volumeChange"),
        "guardMoves": balance[-1]["guardMoves"],
        "changedSide": extreme(max, (row["changedSide"] for row in balance)),
        "wallClock_s": run["wallClock_s"] or math.nan,
    }


def shown(name, value):
    if name.endswith("Drift"):
        return f"{100 * value:+.3f} %" if abs(value) > 5e-6 else f"{value:+.0e}"
    if name.startswith("D12"):
        return f"{value:.4f}"
    return f"{value:.4g}" if name == "Ca" else f"{value:.6g}" if math.isfinite(value) and value == int(value) else f"{value:.2f}"


def main(arguments):
    asCsv = "-csv" in arguments
    cases = [a for a in arguments if a != "-csv"] or ["."]
    results = [summary(case) for case in cases]
    if asCsv:
        writer = csv.DictWriter(sys.stdout, COLUMNS, lineterminator="\n")
        writer.writeheader()
        writer.writerows(results)
        return
    for case, result in zip(cases, results):
        print(os.path.basename(os.path.abspath(case)))
        for name, text in COLUMNS.items():
            if name == "fullTurn_strain" and math.isnan(result[name]):
                continue
            print(f"  {text:40s}{shown(name, result[name]):>12s}")


if __name__ == "__main__":
    main(sys.argv[1:])
