#!/usr/bin/env python3
"""Path of the first capsule past the second one, from the centroids in postProcessing/pair/capsule.csv, as a table of lengths in radii."""
import csv
import sys

RADIUS, LENGTH = 4e-6, 64e-6  # system/mesh.yaml: of a capsule, and of the box along the flow [m]

places = {}
with open("postProcessing/pair/capsule.csv") as text:
    for row in csv.DictReader(line for line in text if not line.startswith("#")):
        places.setdefault(float(row["strain"]), {})[int(float(row["cell"]))] = [float(row[f"centroid_{k}_m"]) for k in "xyz"]
print("# along, across: centroid of the first capsule less that of the second, along the flow and along its gradient, over the radius")
print(",".join(("strain", "along", "across")))
before = None
for strain, (one, other) in ((strain, (at[1], at[2])) for strain, at in places.items()):
    along = one[0] - other[0]
    if before is not None:  # the image nearest to the previous position
        along += LENGTH * round((before - along) / LENGTH)
    before = along
    print(f"{strain:.4f},{along / RADIUS:.5f},{(one[2] - other[2]) / RADIUS:.5f}")
if len(places) < 2:
    sys.exit("path.py: postProcessing/pair/capsule.csv has less than two times")
