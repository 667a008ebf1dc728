#!/usr/bin/env python3
"""Means over strain of the runs of a study, with standard errors, as a table.

    collect.py FROM CASE...      FROM: the strain from which is averaged; programs in PATH
"""
import json
import subprocess
import sys

since, *cases = sys.argv[1:]
print("# relativeViscosity: viscosity over that of plasma, by the work of the sliding images; standardError: of its mean, by blocks; "
      "reliable: 1 where the run is long enough for that; byCells: the same viscosity by the stress of the cells")
print("haematocrit,shearRate_1_s,relativeViscosity,standardError,reliable,byCells,halvings,rollbacks")
for case in cases:
    words = ["averageTable", "blood/suspension", "-case", case, "-from", f"{since} strain",
             "-columns", "haematocrit,relativeViscosity_images,relativeViscosity", "-json"]
    means = {one["column"]: one for one in json.loads(subprocess.run(words, check=True, capture_output=True, text=True).stdout)["averages"]}
    with open(f"{case}/run.json") as text:
        record = json.load(text)
    viscosity, performance = means["relativeViscosity_images"], record["performance"]
    print(f"{means['haematocrit']['mean']:.4f},{record['parameters']['shearRate_1_s']:g},{viscosity['mean']:.4f},{viscosity['standardError']:.4f},"
          f"{int(viscosity['isReliable'])},{means['relativeViscosity']['mean']:.4f},{performance['halvings']},{performance['rollbacks']}")
