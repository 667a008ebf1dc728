#!/usr/bin/env python3
"""Pressure of the inflated capsule beside the neo-Hookean sphere's, 2 (1 - l^-6)/l Gs/a. Exit code 1 where they differ by more than 0.5 %."""
import csv
import sys

RADIUS, GS = 4e-6, 4e-6  # m, N/m: system/relax.yaml and constant/membranes.yaml

with open("postProcessing/relax/capsule.csv", newline="") as file:
    rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
errors = []
print(f"{'stretch':>9}  {'pressure [Pa]':>13}  {'formula [Pa]':>12}  {'error':>8}")
for row in rows:
    stretch, pressure = float(row["stretch"]), float(row["pressure_Pa"])
    formula = 2 * (1 - stretch ** -6) / stretch * GS / RADIUS
    errors.append(abs(pressure / formula - 1))
    print(f"{stretch:9.5f}  {pressure:13.4f}  {formula:12.5f}  {pressure / formula - 1:+8.2%}")
if not errors:
    sys.exit("postProcessing/relax/capsule.csv has no stage: nothing was compared")
print(f"largest error: {max(errors):.2%} of the pressure, allowed 0.5 %")
sys.exit(not all(error <= 0.005 for error in errors))
