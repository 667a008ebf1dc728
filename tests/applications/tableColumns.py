#!/usr/bin/env python3
"""The tables as listed by listModels: every column of every observer and protocol has a meaning, and a unit where its name has one.

    tableColumns.py BIN      BIN: directory of the applications
"""
import json
import subprocess
import sys

FAMILIES = {"observer": "time_s", "relaxation protocol": "stage"}
UNITS = {"s": "s", "m": "m", "m2": "m^2", "m3": "m^3", "m3_s": "m^3/s", "m_s": "m/s", "1_s": "1/s", "kg": "kg", "kg_m3": "kg/m^3", "N": "N", "Nm": "N m", "Ns": "N s", "Js": "J s",
         "N_m": "N/m", "J": "J", "Pa": "Pa", "Pas": "Pa s", "rad": "rad", "percent": "%"}


def main():
    models = json.loads(subprocess.run([sys.argv[1] + "/listModels", "-json"], capture_output=True, text=True, check=True).stdout)
    faults, columns = [], 0
    for family, first in FAMILIES.items():
        for name, model in models[family].items():
            tables = model.get("tables", {})
            if not tables:
                faults.append(f"{family} {name}: no table")
            for table, rows in tables.items():
                where = f"{family} {name}, {table}"
                if rows[0]["column"] != first:
                    faults.append(f"{where}: begins with {rows[0]['column']}, not {first}")
                for row in rows:
                    columns += 1
                    if len(row["meaning"].split()) < 2:
                        faults.append(f"{where}: {row['column']} has no meaning")
                    unit = next((row["column"][-len(end) - 1:] for end in sorted(UNITS, key=len, reverse=True) if row["column"].endswith("_" + end)), "")
                    if UNITS.get(unit[1:], "") != row["unit"]:
                        faults.append(f"{where}: {row['column']} is said to be in '{row['unit']}'")
    assert not faults and columns > 150, "\n".join(faults) or columns


main()
