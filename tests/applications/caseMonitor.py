#!/usr/bin/env python3
"""caseMonitor during a run: its progress, that it was killed, that it ended, and the curve of a table.

    caseMonitor.py BIN SOURCE
"""
import atexit
import csv
import json
import os
import pathlib
import pty
import signal
import subprocess
import sys
import tempfile
import time

BIN, SOURCE = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])


def run(case, program, *words, code=0, **environment):
    done = subprocess.run([str(BIN / program), "-case", str(case), *words], capture_output=True, text=True, env={**os.environ, **environment})
    assert done.returncode == code, f"{program} {words}: code {done.returncode}\n{done.stdout}{done.stderr}"
    return done.stdout + done.stderr


def solver(case, end):
    process = subprocess.Popen([str(BIN / "dmpFlow"), "-case", str(case), "-quiet", "-set", f"system/control.yaml:/endStrain={end}"])
    atexit.register(lambda: process.poll() is None and process.kill())
    return process


def progress(case, process, least):
    """The progress of a run, as soon as this number of steps is recorded."""
    while True:
        found = json.loads(run(case, "caseMonitor", "-json")) if (case / "run.json").exists() else {}
        if found.get("progress", {}).get("step", 0) >= least:
            return found
        assert process.poll() is None, "the run has ended"
        time.sleep(0.2)


def main():
    with tempfile.TemporaryDirectory() as folder:
        case = pathlib.Path(folder) / "case"
        subprocess.run([str(BIN / "cloneCase"), "-quiet", str(SOURCE / "tutorials/rbcShear/Ca0.02"), str(case), "-set", "system/numerics.yaml:/spacing=1 um",
                        "-set", "system/mesh.yaml:/cells/0/edge=1 um"], check=True)
        assert "no solver has run in this case" in run(case, "caseMonitor", code=4)
        run(case, "membraneMesh", "-quiet")
        run(case, "particleFill", "-quiet")
        process = solver(case, 2000)
        found = progress(case, process, 5)
        assert found["state"] == "running" and 0 < found["progress"]["fraction"] < 0.5 and found["progress"]["secondsLeft"] > 1, found
        shown = run(case, "caseMonitor", LC_ALL="C.UTF-8")
        assert "dmpFlow running" in shown and "set by '" in shown and " left, until about " in shown, shown
        assert "D12_extent of deformation/rbc over strain" in shown and any("\u2800" < c <= "\u28ff" for c in shown), shown
        plain = run(case, "caseMonitor", "-table", "wall/wallStress", LC_ALL="C")
        assert "of wall/wallStress over strain" in plain and "*" in plain and plain.isascii(), plain
        assert "Did you mean 'D12_inertia'?" in run(case, "caseMonitor", "-column", "D12_inertai", code=1)
        assert "this folder has rbc" in run(case, "caseMonitor", "-table", "deformation/none")  # the rest is shown
        process.send_signal(signal.SIGKILL)
        process.wait()
        killed = run(case, "caseMonitor", code=3)
        assert "dmpFlow killed" in killed and "goes on from the last checkpoint" in killed and "until about" not in killed, killed

        # On a terminal it looks again and again, and ends with the run.
        run(case, "cleanCase", "-quiet")
        run(case, "membraneMesh", "-quiet")
        run(case, "particleFill", "-quiet")
        process = solver(case, 30)  # some seconds on any machine
        progress(case, process, 1)
        output = bytearray()

        def kept(descriptor):
            data = os.read(descriptor, 4096)
            output.extend(data)
            return data

        os.environ["LC_ALL"] = "C"
        code = pty.spawn([str(BIN / "caseMonitor"), "-case", str(case), "-every", "1", "-column", "D12_inertia"], kept)
        assert os.waitstatus_to_exitcode(code) == 0 and process.wait() == 0
        text = output.decode()
        assert "100.0 %" in text and "dmpFlow done" in text and "\x1b[J" in text, text
        rows = [line for line in open(case / "postProcessing/deformation/rbc.csv") if not line.startswith("#")]
        last = float(list(csv.DictReader(rows))[-1]["D12_inertia"])
        assert f"last {last:.5g}" in text, (last, text[-600:])
        found = json.loads(run(case, "caseMonitor", "-json"))
        assert found["progress"]["fraction"] == 1 and found["reason"].startswith("endStrain"), found
    print("passed")


main()
