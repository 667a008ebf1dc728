#!/usr/bin/env python3
"""The rate at which cells lose haemoglobin, from the end of each run, and the index of haemolysis for longer exposures.

    collect.py FROM CASE...      FROM: the strain from which is averaged

Writes runs/rates.csv, a row for each case, and runs/map.csv, a row for each case and exposure. A cell that has come to its periodic state loses the
same share k of its haemoglobin in each unit of time, so that IH = 100 (1 - exp(-k t)). The standard error of k is that of the means of four blocks.
"""
import csv
import json
import math
import statistics
import sys

BLOCKS = 4
EXPOSURES = [10 ** (n / 4) for n in range(-12, 5)]  # s


def rows(path):
    with open(path) as text:
        lines = [line for line in text if not line.startswith("#")]
    return [{name: float(value) for name, value in row.items()} for row in csv.DictReader(lines)]


def mean(table, column, since):
    return statistics.fmean(row[column] for row in table if row["strain"] >= since)


def rate(table, since):
    """k [1/s] and its standard error."""
    late = [row for row in table if row["strain"] >= since]
    if len(late) <= BLOCKS:
        sys.exit(f"collect.py: only {len(late)} rows from strain {since:g}; take a longer run, or a smaller -from")
    cuts = [late[round(n * (len(late) - 1) / BLOCKS)] for n in range(BLOCKS + 1)]
    found = [math.log((100 - a["haemolysisIndex_percent"]) / (100 - b["haemolysisIndex_percent"])) / (b["time_s"] - a["time_s"])
             for a, b in zip(cuts, cuts[1:])]
    return statistics.fmean(found), statistics.stdev(found) / math.sqrt(BLOCKS)


def laws():
    with open("powerLaws.csv") as text:
        return list(csv.DictReader(line for line in text if not line.startswith("#")))


since, *cases = sys.argv[1:]
since = float(since)
rates = []
for case in cases:
    folder = f"{case}/postProcessing"
    with open(f"{case}/run.json") as text:
        record = json.load(text)
    shear, mu = record["parameters"]["shearRate_1_s"], record["parameters"]["viscosity_Pa_s"]
    whole, cells = rows(f"{folder}/release/case.csv"), rows(f"{folder}/release/rbc.csv")
    blood, shape = rows(f"{folder}/blood/suspension.csv"), rows(f"{folder}/deformation/rbc.csv")
    number = len({row["cell"] for row in cells})
    k, error = rate(whole, since)
    rates.append({"case": case.split("/")[-1], "cells": number, "shearRate_1_s": shear,
                  "stress_Pa": mu * shear * (mean(blood, "relativeViscosity", since) if number > 1 else 1),
                  "rate_1_s": k, "standardError_1_s": error, "poreShare": mean(cells, "poreShare", since),
                  "poreShare_max": max(row["poreShare_max"] for row in cells if row["strain"] >= since),
                  "areaChange": mean(rows(f"{folder}/balance/rbc.csv"), "areaChange", since),
                  "areaChange_max": max(row["areaChange"] for row in rows(f"{folder}/balance/rbc.csv") if row["strain"] >= since),
                  "length_um": 1e6 * mean(shape, "length_m", since), "coreSeconds": record["performance"]["coreSeconds"]})
with open("runs/rates.csv", "w") as out:
    out.write("# stress: viscosity times shear rate, of the suspension where there are several cells; rate: of the loss of haemoglobin, with its standard\n"
              "# error; poreShare: pores over the area of the membrane; areaChange: of whole cells, mean and greatest; length: of the cell\n")
    writer = csv.DictWriter(out, list(rates[0]), lineterminator="\n")
    writer.writeheader()
    writer.writerows({name: f"{value:.5g}" if isinstance(value, float) else value for name, value in row.items()} for row in rates)
published = laws()
with open("runs/map.csv", "w") as out:
    out.write("# index of haemolysis in percent, by the rate of runs/rates.csv and by power laws\n")
    out.write("case,cells,stress_Pa,exposure_s,index,standardError,lowestLaw,highestLaw\n")
    for row in rates:
        for t in EXPOSURES:
            left = 100 * math.exp(-row["rate_1_s"] * t)
            by = [float(law["A"]) * row["stress_Pa"] ** float(law["alpha"]) * t ** float(law["beta"]) for law in published]
            out.write(f"{row['case']},{row['cells']},{row['stress_Pa']:.5g},{t:.5g},{100 - left:.5g},{left * row['standardError_1_s'] * t:.3g},"
                      f"{min(by):.5g},{min(100, max(by)):.5g}\n")
