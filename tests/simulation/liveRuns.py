#!/usr/bin/env python3
"""system/control.yaml and system/observers.yaml edited while a case runs: what is valid acts, what is not is told and changes nothing.

    liveRuns.py BIN TEST    BIN: directory of the applications

The end of each run is an edit, too: its length does not depend on the speed of the machine.
"""
import atexit
import json
import pathlib
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "tutorials"))
from runs import BIN, FLUID_CASE, make, run
from summary import series

CONTROL = "application: sphFlow\nendTime: 1000 s\nwrite: {time: 0.5 s}\ncheckpoint: {wallClock: never}\n"
OBSERVERS = "balance: {type: conservation, every: 0.05 s}\nlayers: {type: profile, every: 0.05 s, bins: 4}\n"
CASE = {**FLUID_CASE, "system/control.yaml": CONTROL, "system/observers.yaml": OBSERVERS}


def prepared(folder, **changes):
    case = make(folder, CASE, **changes)
    run(case, "particleFill")
    return case


def started(case, *options, ranks=1, program="sphFlow"):
    command = [str(BIN / program), "-case", str(case), *options]
    if ranks > 1:
        command = ["mpirun", "--oversubscribe", "-np", str(ranks), *command]
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    atexit.register(lambda: process.poll() is None and process.kill())
    return process


def log(case, program="sphFlow"):
    path = case / f"log.{program}"
    return path.read_text() if path.exists() else ""


def until(condition, process, what, seconds=120):
    limit = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < limit, f"{what}: not within {seconds} s"
        assert process.poll() is None, f"{what}: the program ended with {process.returncode}\n{process.stderr.read()}"
        time.sleep(0.05)


def edit(case, process, file, text, expected, program="sphFlow"):
    """Writes the file and waits for a line of the log."""
    before = log(case, program).count(expected)
    (case / file).write_text(text)
    until(lambda: log(case, program).count(expected) > before, process, f"{file}: {expected}")


def reached(case):
    """The time of the flow that the run reports; -1 before the first report."""
    path = case / "run.json"
    return json.loads(path.read_text()).get("progress", {}).get("time_s", -1) if path.exists() else -1


def end(case, process):
    """Lowers the end to a time that has passed, by caseDict, which may change nothing else of a running case."""
    refused = run(case, "caseDict", "-set", "constant/flow.yaml:/shearRate=1 1/s", code=4).stderr
    assert "is at work in this case" in refused, refused
    run(case, "caseDict", "-set", "system/control.yaml:/endTime=1 ms")
    said = process.communicate(timeout=120)[1]
    assert process.returncode == 0, said
    return said


def times(case, observer, file):
    return [row["time_s"] for row in series(case, observer, file)]


def multiples(found, interval):
    """The numbers of intervals; asserts that each time is a whole number of them, to rounding."""
    numbers = [round(t / interval) for t in found]
    assert all(abs(t - n * interval) <= 1e-12 * max(1, n) for t, n in zip(found, numbers)), (interval, found[:5])
    return numbers


def test_taken(folder):
    """Intervals, ends, results and observers are edited on 1 and 2 ranks: tables go on without a gap, new ones begin, others end, and the run ends by the new end."""
    for ranks in (1, 2):
        case = prepared(folder / str(ranks))
        process = started(case, ranks=ranks)
        until(lambda: len(log(case)) and (case / "postProcessing/balance/conservation.csv").exists(), process, "start")
        edit(case, process, "system/observers.yaml", "balance: {type: conservation, every: 0.05 s}\nmore: {type: profile, every: 0.1 s, bins: 2}\n",
             "system/observers.yaml: layers: changed while the case runs, from {type: profile")
        edit(case, process, "system/control.yaml", CONTROL.replace("time: 0.5 s", "time: 0.25 s, fields: [velocity], keep: 3"),
             "system/control.yaml: write.time: changed while the case runs, from 500 ms to 250 ms")
        until(lambda: reached(case) >= 0, process, "progress")
        changed = reached(case)
        until(lambda: reached(case) > changed + 1, process, "another second of the flow")
        end(case, process)
        said = log(case)
        assert "system/observers.yaml: more: changed while the case runs, from nothing to {type: profile" in said, said
        assert "End after" in said and "endTime" in json.loads((case / "run.json").read_text())["reason"], said
        last = json.loads((case / "run.json").read_text())["result"]["time_s"]
        # What goes on has every row from the start to the end; what was dropped ends, what is new begins, in between.
        whole = multiples(times(case, "balance", "conservation.csv"), 0.05)
        assert whole == list(range(int(last / 0.05 + 1e-9) + 1)), whole
        dropped, added = (multiples(times(case, name, "profile.csv"), every) for name, every in (("layers", 0.05), ("more", 0.1)))
        assert dropped == [n for n in range(dropped[-1] + 1) for _ in range(4)] and dropped[-1] < whole[-1], dropped
        assert added == [n for n in range(added[0], added[-1] + 1) for _ in range(2)] and added[0] > 0, added
        assert 0 <= 2 * added[0] - dropped[-1] <= 3 and 2 * added[-1] + 2 > whole[-1], (added[0], dropped[-1], added[-1], whole[-1])
        # The last three results, at the new interval, with the new fields.
        entries = [float(part.split('"')[1]) for part in (case / "results/fluid.pvd").read_text().split("timestep=")[1:]]
        numbers = multiples(entries, 0.25)
        assert len(numbers) == 3 and numbers == list(range(numbers[0], numbers[0] + 3)), entries
        piece = sorted((case / "results/fluid").glob("*.pvtp"))[-1].read_text()
        assert "velocity" in piece and "density" not in piece, piece
        used = (case / "used.yaml").read_text()
        assert "  more:" in used and used.count("type: profile") == 1 and "endTime: 0.001 s" in used, used
        noted = json.loads((case / "run.json").read_text())["parameters"]["changedWhileRunning"]
        assert len(noted) >= 6 and noted[-1].startswith("system/control.yaml: endTime: changed while the case runs, from 1000 s to 1 ms"), noted
        assert len(list((case / "checkpoints").glob("*.h5"))) == 1
        # A restart goes on from there.
        run(case, "sphFlow", "-set", f"system/control.yaml:/endTime={last + 0.2} s", ranks=ranks)
        whole = multiples(times(case, "balance", "conservation.csv"), 0.05)
        assert whole == list(range(whole[-1] + 1)) and whole[-1] == int((last + 0.2) / 0.05 + 1e-9), whole


def test_rejected(folder):
    """Errors are told with their place and change nothing: the tables are those of an undisturbed run, bit for bit. A corrected file acts, and so does the next edit."""
    for ranks in (1, 2):
        case = prepared(folder / str(ranks), **{"system/observers.yaml": "layers: {type: profile, every: 0.05 s, bins: 4}\n"})
        process = started(case, ranks=ranks)
        until(lambda: (case / "postProcessing/layers/profile.csv").exists(), process, "start")
        kinds = (
            ("system/control.yaml", CONTROL.replace("write: {time", "write: {tmie"), "system/control.yaml:3:9: write.tmie: "),
            ("system/control.yaml", CONTROL.replace("write: {time: 0.5 s", "write: {strain: 0.5, time: 0.5 s"), "system/control.yaml:3:"),
            ("system/control.yaml", CONTROL.replace("[", "").replace("endTime: 1000 s", "endTime: 1000 s, ["), "system/control.yaml:"),
            ("system/control.yaml", CONTROL + "stop: {firstBreak: true}\n", "stop.firstBreak: found true, but nothing can break"),
            ("system/observers.yaml", "shape: {type: shape, every: 0.05 s}\n", "system/observers.yaml:1:1: shape: shape: "),
            ("system/observers.yaml", "balance: {type: conservation, every: 0.05 s}\n", "needs the budget of energy and momentum, which this run does not keep"))
        for file, text, expected in kinds if ranks == 1 else kinds[-1:]:
            edit(case, process, file, text, expected)
            (case / "system/control.yaml").write_text(CONTROL)
            (case / "system/observers.yaml").write_text("layers: {type: profile, every: 0.05 s, bins: 4}  # as before\n")
        assert "Changes of system/control.yaml and system/observers.yaml wait until both are correct" in log(case), log(case)
        before = log(case).count("not taken over")
        (case / "system/observers.yaml").unlink()
        until(lambda: "system/observers.yaml: the file is gone; its observers go on" in log(case), process, "file removed")
        assert "changed while the case runs" not in log(case), log(case)
        time.sleep(2.5)
        assert log(case).count("not taken over") == before + 1, "one message for one edit"
        edit(case, process, "system/observers.yaml", "layers: {type: profile, every: 0.05 s, bins: 4}\nrates: {type: profile, every: 0.1 s, bins: 3}\n",
             "system/observers.yaml: rates: changed while the case runs")
        edit(case, process, "system/observers.yaml", "{}\n", "system/observers.yaml: layers: changed while the case runs")
        said = end(case, process)
        assert said.count("is not taken over; the run goes on") == before + 1, said
        last = times(case, "layers", "profile.csv")[-1]
        calm = prepared(folder / f"calm{ranks}", **{"system/observers.yaml": "layers: {type: profile, every: 0.05 s, bins: 4}\n"})
        run(calm, "sphFlow", "-set", f"system/control.yaml:/endTime={last!r} s", ranks=ranks)
        assert (case / "postProcessing/layers/profile.csv").read_text() == (calm / "postProcessing/layers/profile.csv").read_text()


def test_ends(folder):
    """The end is moved while the case runs, beyond the old one; the interval of checkpoints and the file that stops the run, too; -set goes before the file."""
    case = prepared(folder / "case", **{"system/control.yaml": CONTROL.replace("1000 s", "3000 s")})
    process = started(case)
    until(lambda: reached(case) > 0, process, "progress")
    edit(case, process, "system/control.yaml", CONTROL.replace("never", "0.5 s") + "stop: {file: enough}\n", "stop.file: changed while the case runs, from stop to enough")
    assert "endTime: changed while the case runs, from 3000 s to 1000 s" in log(case)
    until(lambda: len(list((case / "checkpoints").glob("*.h5"))) == 2, process, "checkpoints")
    (case / "stop").write_text("")
    time.sleep(3)
    assert process.poll() is None, "the old name of the file stopped the run"
    (case / "enough").write_text("")
    said = process.communicate(timeout=120)[1]
    assert process.returncode == 5, said
    (case / "stop").unlink()
    stopped = json.loads((case / "run.json").read_text())["result"]["time_s"]
    # -set goes before the file: the edit of the end does not act.
    process = started(case, "-set", f"system/control.yaml:/endTime={stopped + 4} s")
    until(lambda: "==== continued" in log(case), process, "restart")
    (case / "system/control.yaml").write_text(CONTROL.replace("1000 s", "1 ms").replace("time: 0.5 s", "time: 0.2 s"))
    said = process.communicate(timeout=300)[1]
    assert process.returncode == 0 and abs(json.loads((case / "run.json").read_text())["result"]["time_s"] - stopped - 4) < 1e-9, said
    assert "write.time: changed while the case runs" in log(case) and log(case).count("endTime: changed while") == 1, log(case)


def test_rollback(folder):
    """A fault after an edit: the run is rolled back to a state after the edit, with the observers of then."""
    case = prepared(folder / "case", **{"system/observers.yaml": "layers: {type: profile, every: 0.05 s, bins: 4}\n"})
    process = started(case, "-kind", "nan", "-at", "15000", "-seed", "5", program="faultInjection")
    until(lambda: (case / "postProcessing/layers/profile.csv").exists(), process, "start")
    edit(case, process, "system/observers.yaml", "first: {type: profile, every: 0.1 s, bins: 2}\nlayers: {type: profile, every: 0.05 s, bins: 4}\n",
         "system/observers.yaml: first: changed while the case runs", program="faultInjection")
    until(lambda: "Back to step" in log(case, "faultInjection"), process, "rollback")
    assert log(case, "faultInjection").index("first: changed") < log(case, "faultInjection").index("Back to step"), "the edit came after the fault"
    back = reached(case)
    until(lambda: reached(case) > back + 0.5, process, "further")
    end(case, process)
    layers, first = multiples(times(case, "layers", "profile.csv"), 0.05), multiples(times(case, "first", "profile.csv"), 0.1)
    assert layers == [n for n in range(layers[-1] + 1) for _ in range(4)], layers
    assert first == [n for n in range(first[0], first[-1] + 1) for _ in range(2)] and first[0] > 0 and 2 * first[-1] >= layers[-1] - 1, first


def main():
    with tempfile.TemporaryDirectory() as folder:
        globals()["test_" + sys.argv[2]](pathlib.Path(folder))


if __name__ == "__main__":
    main()
