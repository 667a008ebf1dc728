#!/usr/bin/env python3
"""Diameters of the stretched cell beside the experiment's error bars. Exit code 1 where one lies outside, or none was computed at a force of the experiment."""
import csv
import sys

with open("reference/mills2004.csv", newline="") as file:
    measured = list(csv.DictReader(line for line in file if not line.startswith("#")))
with open("postProcessing/relax/rbc.csv", newline="") as file:
    computed = list(csv.DictReader(line for line in file if not line.startswith("#")))

compared = outside = 0
print(f"{'force [pN]':>10}  {'axial [um]':>10} {'experiment':>22}  {'transverse [um]':>15} {'experiment':>20}")
for row in computed:
    force = 1e12 * float(row["force_N"])
    bars = min(measured, key=lambda m: abs(float(m["force_pN"]) - force))
    if abs(float(bars["force_pN"]) - force) > 0.05:
        continue  # a stage between those of the experiment
    line = f"{force:10.2f}"
    for name, width in (("axial", 10), ("transverse", 15)):
        value = 1e6 * float(row[name + "Diameter_m"])
        low, high = float(bars[name + "Low_um"]), float(bars[name + "High_um"])
        inside = low <= value <= high
        compared += 1
        outside += not inside
        line += f"  {value:{width}.2f} {'in' if inside else 'NOT in'} {low:.2f} .. {high:.2f}"
    print(line)
if not compared:
    sys.exit("no stage has a force of the experiment: nothing was compared")
print("both diameters lie within the error bars at every force" if outside == 0 else f"{outside} diameters lie outside the error bars")
sys.exit(outside > 0)
