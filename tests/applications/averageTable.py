#!/usr/bin/env python3
"""averageTable: tables with one row per time, tables of cells and of places; rejected input.

    averageTable.py BIN
"""
import json
import math
import pathlib
import random
import subprocess
import sys
import tempfile

PROGRAM = pathlib.Path(sys.argv[1]) / "averageTable"


def table(case, name, header, rows):
    path = case / "postProcessing" / f"{name}.csv"
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(f"# {name}.csv of Corpuscle\n{header}\n" + "".join(",".join(f"{value:.17g}" for value in row) + "\n" for row in rows))


def run(case, *words, code=0, says=()):
    done = subprocess.run([PROGRAM, *words, "-case", case], capture_output=True, text=True)
    text = done.stdout + done.stderr
    assert done.returncode == code, f"{words}: exit code {done.returncode}, not {code}: {text}"
    for word in says:
        assert word in text, f"{words}: no '{word}' in {text}"
    return done.stdout


def averages(case, *words):
    result = json.loads(run(case, *words, "-json"))
    return result, {(one["column"], *[value for key, value in one.items() if key.endswith("_m")]): one for one in result["averages"]}


def near(value, expected, within):
    assert abs(value - expected) <= within, f"{value}, not {expected}"


with tempfile.TemporaryDirectory() as temporary:
    case = pathlib.Path(temporary)
    generator = random.Random(1)
    noise = [generator.gauss(0, 1) for _ in range(2001)]
    # A transient to strain 10, then values around 2.5; a column that drifts; a last row at the end of the run.
    rows = [(0.01 * k, 0.1 * k, 2.5 + 0.1 * noise[k] + 5 * math.exp(-0.1 * k), 0.002 * k) for k in range(2001)] + [(20.003, 200.03, 0, 0)]
    table(case, "blood/suspension", "time_s,strain,relativeViscosity,drift_m", rows)
    result, found = averages(case, "blood/suspension", "-from", "10 strain")
    assert (result["times"], result["along"]) == (1901, "strain"), result
    near(result["to"], 200, 1e-9)
    mean = sum(row[2] for row in rows[100:2001]) / 1901
    near(found["relativeViscosity",]["mean"], mean, 1e-12)
    near(found["relativeViscosity",]["standardError"], 0.1 / math.sqrt(1901), 0.0006)
    assert found["relativeViscosity",]["isReliable"] and not found["drift_m",]["isReliable"], found
    near(averages(case, "blood/suspension")[0]["from"], 100.1, 0.1)  # half of the run
    near(averages(case, "blood/suspension", "-from", "0.15 s", "-to", "180 ms")[0]["to"], 0.18, 1e-9)
    run(case, "blood/suspension", "-from", "10 strain", says=["relativeViscosity", "standard error", "*", "lower bound"])
    assert list(averages(case, "blood/suspension", "-columns", "drift_m")[1]) == [("drift_m",)]

    # Two cells, one of them absent at some times: the mean over those present.
    cells = [(0.1 * k, cell, k + 10 * cell) for k in range(100) for cell in (1, 2) if (cell, k % 10) != (2, 3)]
    table(case, "deformation/rbc", "time_s,cell,D12", cells)
    result, found = averages(case, "deformation/rbc", "-from", "0 s")
    expected = sum(k + (10 if k % 10 == 3 else 15) for k in range(100)) / 100
    near(found["D12",]["mean"], expected, 1e-12)
    assert result["times"] == 100 and "cell" not in result["averages"][0]

    # Places: a mean at each, and no numbers at places without values.
    places = [(0.1 * k, z, z * z + 0.01 * noise[k], math.nan if z > 2 else 1) for k in range(64) for z in (1.0, 2.0, 3.0)]
    table(case, "profile/profile", "time_s,z_m,u_m_s,n", places)
    result, found = averages(case, "profile/profile", "-from", "0 s")
    for z in (1.0, 2.0, 3.0):
        near(found["u_m_s", z]["mean"], z * z, 0.005)
    assert ("n", 3.0) not in found and found["n", 1.0]["standardError"] == 0

    near(averages(case, "blood/suspension", "-to", "50 strain")[0]["from"], 25, 0.1)  # half of what is before it
    table(case, "mean/poiseuille", "time_s,strain,u_m_s", [(0.1 * k, 0, k) for k in range(101)])
    result, found = averages(case, "mean/poiseuille")
    assert (result["along"], result["times"]) == ("time_s", 51) and found["u_m_s",]["mean"] == 75, result
    # A value that is constant up to rounding has a negligible error, however few values there are.
    table(case, "blood/few", "time_s,volume_m3,n", [(0.1 * k, 1e-16 * (1 + 1e-13 * (-1) ** k), k % 3) for k in range(4)])
    found = averages(case, "blood/few", "-from", "0 s")[1]
    assert found["volume_m3",]["isReliable"] and not found["n",]["isReliable"], found

    run(case, "blood/suspension", "-from", "10", code=1, says=["-from", "'10'", "5 strain"])
    run(case, "blood/suspension", "-from", "1 um", code=1, says=["1 um"])
    run(case, "blood/suspension", "-from", "3000 strain", code=1, says=["no row", "200.03"])
    run(case, "blood/suspension", "-columns", "relativeViscosty", code=1, says=["relativeViscosty", "'relativeViscosity'"])
    run(case, "deformation/rbc", "-from", "5 strain", code=1, says=["no column 'strain'"])
    run(case, "blood", code=1, says=["OBSERVER/FILE"])
    run(case, "blood/suspensions", code=4, says=["suspension"])
    table(case, "blood/uneven", "time_s,n", [(0.1 * k if k < 20 else 0.3 * k, 1) for k in range(40)])
    run(case, "blood/uneven", "-from", "0 s", code=1, says=["not evenly spaced", "1.9"])
    table(case, "blood/empty", "time_s,n", [])
    run(case, "blood/empty", code=4, says=["no rows"])
