#!/usr/bin/env python3
"""Tables of observers over starts, restarts and kills: one curve, of this run only, that can always be read.

    tableRuns.py BIN TEST    BIN: directory of the applications
"""
import pathlib
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "tutorials"))
from runs import BIN, FLUID_CASE, make, run
from summary import rows, series

CASE = {**FLUID_CASE,
        "system/control.yaml": "application: sphFlow\nendTime: 0.2 s\ncheckpoint: {wallClock: 0.05 s, keep: 2}\n",
        "system/observers.yaml": "balance: {type: conservation, every: 1 steps}\nlayers: {type: profile, every: 5 steps, bins: 4}\n"}
FRESH = ("-set", "system/control.yaml:/startFrom=firstTime")


def until(seconds):
    return "-set", f"system/control.yaml:/endTime={seconds} s"


def files(case):
    folder = case / "postProcessing"
    return sorted(str(path.relative_to(folder)) for path in folder.rglob("*") if path.is_file())


def body(case, name):
    return [line for line in (case / "postProcessing" / name).read_text().splitlines() if not line.startswith("#")]


NAMES = ["balance/budget.csv", "balance/conservation.csv", "layers/profile.csv"]


def prepared(folder):
    case = make(folder, CASE)
    run(case, "particleFill")
    return case


def test_continued(folder):
    """A run in three parts, on 1 and 2 ranks, has the files and rows of a run in one part; the head describes each column."""
    whole = prepared(folder / "whole")
    shutil.copytree(whole, folder / "parts")
    run(whole, "sphFlow")
    parts = folder / "parts"
    for end in (0.05, 0.12, 0.2):
        run(parts, "sphFlow", *until(end))
    assert files(parts) == files(whole) == NAMES, files(parts)
    times = [row["time_s"] for row in series(parts, "balance", "conservation.csv")]
    assert times == sorted(set(times)) and times[0] == 0 and times[-1] >= 0.2, times[-3:]
    assert len(series(parts, "layers", "profile.csv")) % 4 == 0
    head = [line for line in (parts / "postProcessing/layers/profile.csv").read_text().splitlines() if line.startswith("#")]
    assert head[0].startswith("# layers/profile.csv of Corpuscle, observer profile: "), head
    assert [line.split(":")[0][2:] for line in head[1:]] == body(parts, "layers/profile.csv")[0].split(","), head
    assert "# u_m_s: mean of the velocity along x" in "\n".join(head) and head[-3].endswith("[m/s]"), head
    run(parts, "sphFlow", *until(0.25), ranks=2)
    assert files(parts) == NAMES


def test_fresh(folder):
    """Tables of previous runs, by this version and by earlier ones, are not mistaken for those of this run; files of the user stay."""
    case = prepared(folder)
    run(case, "sphFlow", *until(0.1))
    run(case, "sphFlow")
    tables = case / "postProcessing"
    for place in ("balance/0", "balance/0.1", "vanished/0"):
        (tables / place).mkdir(parents=True)
        (tables / place / "conservation.csv").write_text("time_s,strain,density_mean\n0,0,1\n")
    (tables / "balance/mine.csv").write_text("a,b\n1,2\n")
    (tables / "kept").mkdir()
    shutil.copy(tables / "balance/conservation.csv", tables / "kept")
    run(case, "sphFlow", *FRESH, *until(0.04), "-set", "constant/flow.yaml:/shearRate=0.05 1/s")
    assert files(case) == [NAMES[0], NAMES[1], "balance/mine.csv", "kept/conservation.csv", NAMES[2]], files(case)
    last = series(case, "balance", "conservation.csv")[-1]
    assert 0.04 <= last["time_s"] < 0.045 and abs(last["strain"] - 0.05 * last["time_s"]) < 1e-12, last
    (case / "system/observers.yaml").unlink()
    run(case, "sphFlow", *FRESH, *until(0.02))
    assert files(case) == ["balance/mine.csv", "kept/conservation.csv"], files(case)


def test_changed(folder):
    """Another set of columns at a restart: a warning; the old rows are moved to another name, and the table begins anew and can be read."""
    case = prepared(folder)
    run(case, "sphFlow", *until(0.1))
    table = case / "postProcessing/balance/conservation.csv"
    before = table.read_text().replace(",particles\n", ",number\n")
    table.write_text(before)
    said = run(case, "sphFlow").stderr
    assert "it now has the columns particles, and no longer has number" in said and "conservation.csv.until_" in said, said
    (kept,) = table.parent.glob("conservation.csv.until_*")
    assert kept.read_text() == before
    assert series(case, "balance", "conservation.csv")[0]["time_s"] > 0.1
    assert series(case, "balance", "budget.csv")[0]["time_s"] == 0


def test_killed(folder):
    """Killed at any moment, start and restart included: each table can be read, and the final run has the rows of an undisturbed one."""
    calm = prepared(folder / "calm")
    shutil.copytree(calm, folder / "killed")
    began = time.monotonic()
    run(calm, "sphFlow", *until(0.5))
    whole = time.monotonic() - began  # on this machine, as loaded as it is
    case, chance, kills = folder / "killed", random.Random(29), 0
    for attempt in range(12):
        process = subprocess.Popen([str(BIN / "sphFlow"), "-case", str(case), "-quiet", *until(0.5)], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        try:
            assert process.wait(whole * (0.3 if attempt < 4 else 0.9) * chance.random()) == 0
            break
        except subprocess.TimeoutExpired:
            process.send_signal(signal.SIGKILL)
            process.wait()
            kills += 1
        for name in NAMES:
            path = case / "postProcessing" / name
            found = rows(path) if path.exists() else []
            times = [row["time_s"] for row in found]
            assert times == sorted(times) and (not times or times[0] == 0), (name, times[:3])
    else:
        run(case, "sphFlow", *until(0.5))
    assert kills > 2, "hardly killed at all"
    for name in NAMES:
        assert body(case, name) == body(calm, name), name
    assert files(case) == NAMES, files(case)


def main():
    with tempfile.TemporaryDirectory() as folder:
        globals()["test_" + sys.argv[2]](pathlib.Path(folder))


if __name__ == "__main__":
    main()
