#!/usr/bin/env python3
"""The discocyte beside the axisymmetric shape equations; numbers of all three shapes. Exit code 1 where energy or diameter are off by 1 %."""
import csv
import math

from axisymmetric import oblate

KAPPA = 2e-19  # J: the cases' constant/membranes.yaml
shapes = {}
print(f"{'shape':>12}  {'diameter x, y [um]':>18}  {'height [um]':>11}  {'reduced volume':>14}  {'energy/8 pi kappa':>17}")
for shape, name in (("discocyte", "vesicle"), ("stomatocyte", "vesicle"), ("echinocyte", "cell")):
    with open(f"runs/{shape}/postProcessing/relax/{name}.csv", newline="") as file:
        row = {key: float(value) for key, value in list(csv.DictReader(line for line in file if not line.startswith("#")))[-1].items()}
    row["energy"] = row["energy_J"] / (8 * math.pi * KAPPA)
    shapes[shape] = row
    x, y, z = (1e6 * row[f"extent{axis}_m"] for axis in "XYZ")
    print(f"{shape:>12}  {x:9.3f}{y:9.3f}  {z:11.3f}  {row['reducedVolume']:14.5f}  {row['energy']:17.4f}")

disc = shapes["discocyte"]
energy, diameter, _ = oblate(disc["reducedVolume"])
radius = math.sqrt(disc["area_m2"] / (4 * math.pi))
errors = disc["energy"] / energy - 1, 0.5 * (disc["extentX_m"] + disc["extentY_m"]) / (2 * radius * diameter) - 1
print(f"shape equations at the discocyte's reduced volume: energy {energy:.4f}, diameter {2e6 * radius * diameter:.3f} um; "
      f"differences {errors[0]:+.2%}, {errors[1]:+.2%}")
raise SystemExit(not all(abs(error) <= 0.01 for error in errors))
