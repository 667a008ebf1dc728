#!/usr/bin/env python3
"""The limits of the machine: long paths, file sizes, full disks, memory, permissions, closed pipes, damaged files.

    limits.py BIN TEST    BIN: directory of the applications
"""
import json
import os
import pathlib
import random
import re
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import time

import runs
from runs import BIN, CELL_CASE, copied, last_checkpoint, prepared, run

SHORT = {**CELL_CASE, "system/control.yaml": CELL_CASE["system/control.yaml"].replace("0.12", "0.02").replace("0.05", "0.01")}


def start(application, case, *options, ranks=1, limits=(), user=None, cwd=None):
    """The finished process. limits: (resource, soft value) for the program on all ranks, not for mpirun, which cannot start under a low limit."""
    def prepare():
        for which, value in limits:
            resource.setrlimit(which, (value, resource.getrlimit(which)[1]))

    command = [str(BIN / application), "-case", str(case), *options]
    if ranks > 1 and limits:
        names = {resource.RLIMIT_FSIZE: "fsize", resource.RLIMIT_AS: "as"}
        command, limits = ["prlimit", *(f"--{names[which]}={value}:" for which, value in limits), *command], ()
    if ranks > 1:
        command = ["mpirun", "--oversubscribe", "-np", str(ranks), *command]
    return subprocess.run(command, capture_output=True, text=True, preexec_fn=prepare, user=user, cwd=cwd, timeout=120)


def failed(done, code, *words):
    said = done.stdout + done.stderr
    assert done.returncode == code, f"exit code {done.returncode} instead of {code}:\n{said}"
    for word in words:
        assert word in said, f"no '{word}' in\n{said}"
    for pattern in (r"std::", r"\b0x[0-9a-f]", r"terminate called", r"\boverflow"):  # whole words: names of temporary folders may contain any letters
        assert not re.search(pattern, said), f"'{pattern}' matches\n{said}"
    return said


def record(case):
    return json.loads((case / "run.json").read_text())


def temporaries(case):
    return [p for p in case.rglob("*") if p.name.endswith((".part", ".tmp"))]


def long_folder(folder, length):
    """A path of this number of characters."""
    path = str(folder) + "/"
    while len(path) < length:
        path += "x" * min(200, length - len(path)) + "/"
    path = path.rstrip("/")
    path += "x" * (length - len(path))
    pathlib.Path(path).parent.mkdir(parents=True, exist_ok=True)
    return pathlib.Path(path)


def test_paths(folder):
    """Paths of any length that the system allows, on 1 and 2 ranks; paths that are too long are reported at the start."""
    case = prepared(folder / "case", SHORT)
    for length, ranks in ((218, 1), (240, 2), (1000, 1), (3900, 2)):
        deep = copied(case, long_folder(folder, length))
        failed(start("dmpFlow", deep, "-steps", "2", ranks=ranks), 0)
        failed(start("dmpFlow", deep, ranks=ranks), 0, "Restart from")  # reads the checkpoint as well
        assert len(list((deep / "results/rbc").glob("*.pvtp"))) == 3, list((deep / "results/rbc").iterdir())
        shutil.rmtree(deep)
    deep = copied(case, long_folder(folder, 4060))
    failed(start("dmpFlow", deep), 4, "File name too long", "4095", "without -case")
    assert not (deep / "checkpoints").exists() and not (deep / "results").exists()
    name = "c" * 250
    text = {key: SHORT[key].replace("name: rbc", f"name: {name}").replace("rbc:", f"{name}:") for key in ("system/mesh.yaml", "constant/membranes.yaml")}
    failed(start("membraneMesh", runs.make(folder / "name", SHORT, **text)), 4, "File name too long", "255")


def test_sizeLimit(folder):
    """A limit on the size of files: exit code 4 with file, reason and remedy; valid files from before are kept, and the run continues from them."""
    case = prepared(folder / "case", SHORT)
    for ranks in (1, 2):
        own = copied(case, folder / f"own{ranks}")
        failed(start("dmpFlow", own, "-steps", "2", ranks=ranks), 0)
        good = last_checkpoint(own).read_bytes()
        size = len(good) // 2
        largest = max(p.stat().st_size for p in (own / "results").rglob("*.vtp"))
        assert largest < size, "results must fit where checkpoints do not"
        said = failed(start("dmpFlow", own, ranks=ranks, limits=[(resource.RLIMIT_FSIZE, size)]), 4, "checkpoints/000001.h5", "File too large", "ulimit -f",
                      "000000.h5 is the last checkpoint")
        assert [p.name for p in (own / "checkpoints").iterdir()] == ["000000.h5"], said
        assert last_checkpoint(own).read_bytes() == good and not temporaries(own), temporaries(own)
        assert record(own)["status"] == "failed" and "File too large" in record(own)["reason"], record(own)
        run(own, "dmpFlow", ranks=ranks)
        assert record(own)["status"] == "done"
    # A limit below the size that every run tries first: the run ends before the first step and changes nothing. A higher limit: results exceed it.
    again = ("-set", "system/control.yaml:/startFrom=firstTime")
    failed(start("dmpFlow", own, *again, limits=[(resource.RLIMIT_FSIZE, 20000)]), 4, "results/fluid/", "checkpoints/", "File too large")
    assert record(own)["status"] == "done" and last_checkpoint(own).stat().st_size > size
    failed(start("dmpFlow", own, *again, limits=[(resource.RLIMIT_FSIZE, 66000)]), 4, "results/fluid/", "File too large")
    assert record(own)["status"] == "failed" and "File too large" in record(own)["reason"], record(own)
    fluid = (case / "0/fluid.vtp").read_bytes()
    failed(start("particleFill", case, limits=[(resource.RLIMIT_FSIZE, 20000)]), 4, "fluid.vtp", "File too large")
    assert (case / "0/fluid.vtp").read_bytes() == fluid and not temporaries(case)


def fill(folder, left):
    """Fills a disk except for this number of bytes."""
    with open(folder / "filler", "wb", buffering=0) as filler:
        try:
            while True:
                filler.write(bytes(1 << 14))
        except OSError:
            pass
        filler.truncate(max(0, os.fstat(filler.fileno()).st_size - left))


def test_smallDisk(folder):
    """Within its own mount namespace: a disk of 6 MiB, which runs fill up at different times."""
    subprocess.run(["mount", "-t", "tmpfs", "-o", "size=6m", "none", str(folder)], check=True)
    try:
        onSmallDisk(folder)
    finally:
        subprocess.run(["umount", "-l", str(folder)], check=True)


def onSmallDisk(folder):
    case = prepared(folder / "case", SHORT)
    failed(start("dmpFlow", case, "-steps", "2"), 0)
    good = last_checkpoint(case)
    content = good.read_bytes()
    often = ("-set", "system/control.yaml:/write/strain=0.0005")
    for left, ranks, words in ((20000, 1, ["run.json", "checkpoints"]), (200000, 1, ["cannot write"]), (400000, 2, ["cannot write"]), (1000000, 2, ["cannot write"])):
        (folder / "filler").unlink(missing_ok=True)
        fill(folder, left)
        before = record(case)
        failed(start("dmpFlow", case, *often, ranks=ranks), 4, "No space left on device", "free on its disk", *words)
        if left > 1 << 16:
            assert record(case)["status"] == "failed" and "No space left on device" in record(case)["reason"], record(case)
        else:
            assert record(case) == before, "refused before anything was changed"
        assert good.read_bytes() == content and not temporaries(case), temporaries(case)
        assert not any(p.stat().st_size == 0 for p in case.rglob("*") if p.is_file()), "a file without content"
    (folder / "filler").unlink()
    failed(start("dmpFlow", case), 0, "Restart from")


def test_fullDisk(folder):
    """A disk that fills up at the start, with the first results, and during the run; where the system lets a test have a disk of its own."""
    alone = ["unshare", "--map-root-user", "--mount"]
    if subprocess.run([*alone, "mount", "-t", "tmpfs", "none", str(folder)], capture_output=True).returncode != 0:
        print("not tested: no mount namespaces on this machine")
        return
    done = subprocess.run([*alone, sys.executable, __file__, str(BIN), "smallDisk", str(folder)], capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr


def test_unwritable(folder):
    """Files that cannot be written are reported before anything is computed."""
    case = prepared(folder / "case", SHORT)
    for blocked, files in (("checkpoints", 1), ("results", 1), ("postProcessing", 1)):
        own = copied(case, folder / blocked)
        (own / blocked).write_text("")
        failed(start("dmpFlow", own), 4, f"{own}/{blocked}", "a file stands where a folder is needed")
        assert sorted(p.name for p in own.iterdir()) == sorted([*(p.name for p in case.iterdir()), blocked]), "nothing else was made"
    own = copied(case, folder / "start")
    shutil.rmtree(own / "0")
    (own / "0").write_text("")
    failed(start("membraneMesh", own), 4, f"{own}/0", "a file stands where a folder is needed")
    user = 65534 if os.getuid() == 0 else None  # the superuser may write everywhere
    folder.chmod(0o755)
    own = copied(case, folder / "readOnly")
    for path in sorted(own.rglob("*"), reverse=True):
        path.chmod(0o555 if path.is_dir() else 0o444)
    own.chmod(0o555)
    failed(start("dmpFlow", own, user=user), 4, "run.json", "checkpoints", "postProcessing", "Permission denied", "permissions of")
    own.chmod(0o755)
    for path in own.rglob("*"):
        path.chmod(0o755)


def test_pipe(folder):
    """dmpFlow | head: the run continues to its end, and the log is complete; likewise with a closed standard error."""
    case = prepared(folder / "case", SHORT)
    for ranks in (1, 2):
        own = copied(case, folder / f"own{ranks}")
        launcher = f"mpirun --oversubscribe -np {ranks} " if ranks > 1 else ""
        done = subprocess.run(["bash", "-c", f"{launcher}{BIN}/dmpFlow -case {own} | head -n 1; echo ${{PIPESTATUS[0]}}"], capture_output=True, text=True)
        end = done.stdout.splitlines()[-1]
        # mpirun itself ends, by the signal or by its handler (exit code 1), which its child processes cannot prevent: the run is killed, nothing is lost.
        if ranks > 1 and (end == str(128 + signal.SIGPIPE) or "mpirun: SIGPIPE detected" in done.stderr):
            time.sleep(1)
            failed(start("dmpFlow", own, ranks=ranks), 0)
        else:
            assert end == "0", done
        assert record(own)["status"] == "done" and "End after" in (own / "log.dmpFlow").read_text()
    own = copied(case, folder / "closed")
    done = subprocess.run(["bash", "-c", f"{BIN}/dmpFlow -case {own} >&- 2>&-"])
    assert done.returncode == 0 and record(own)["status"] == "done"
    done = subprocess.run(["bash", "-c", f"{BIN}/checkCase -case {case} -json >/dev/full"], capture_output=True, text=True)
    assert done.returncode == 4 and "standard output: No space left on device" in done.stderr, done


def test_memory(folder):
    """A case that is too large for the machine, or for the limits of a process, is refused before it takes the memory."""
    case = prepared(folder / "case", SHORT)
    huge = ("-set", "system/mesh.yaml:/domain/size=[1200 um, 1100 um, 1000 um]")
    for application, ranks in (("checkCase", 1), ("particleFill", 1), ("dmpFlow", 2)):
        failed(start(application, case, *huge, ranks=ranks), 2, "system/numerics.yaml:1:10: spacing:", "of memory is needed on", "more machines")
    for edge in ("1.5 m", "1000 m", "1e5 m"):  # more particles than an integer holds
        beyond = ("-set", f"system/mesh.yaml:/domain/size=[{edge}, {edge}, {edge}]")
        for application in ("checkCase", "particleFill", "dmpFlow"):
            failed(start(application, case, *beyond, limits=[(resource.RLIMIT_AS, 4 << 30)]), 2, "of memory is needed")
    failed(start("membraneMesh", case, "-set", "system/mesh.yaml:/cells/0/edge=1e-16 m"), 2, "edge")
    large = ("-set", "system/mesh.yaml:/domain/size=[120 um, 220 um, 100 um]")
    failed(start("particleFill", case, *large, limits=[(resource.RLIMIT_AS, 1 << 30)]), 2, "is needed by each rank", "ulimit -v")


def test_damage(folder):
    """Flipped bits in 0/*.vtp and in checkpoints are detected; a damaged checkpoint is skipped."""
    case = prepared(folder / "case", SHORT)
    randomly = random.Random(5)

    def flip(path, at):
        data = bytearray(path.read_bytes())
        data[at] ^= 1 << randomly.randrange(8)
        path.write_bytes(data)

    for name, writer in (("fluid", "particleFill"), ("walls", "particleFill"), ("rbc", "membraneMesh")):
        path = case / "0" / f"{name}.vtp"
        whole = path.read_bytes()
        data = whole.index(b"<AppendedData") + 30
        for at in (data + (len(whole) - data) // 3, len(whole) * 2 // 3, len(whole) - 200):
            flip(path, at)
            for application in ("dmpFlow", "checkMesh", "checkCase") if at == len(whole) * 2 // 3 else ("dmpFlow",):
                failed(start(application, case), 4, f"0/{name}.vtp")
            path.write_bytes(whole)
        path.write_bytes(whole.replace(b'Name="checksum"', b'Name="checksun"'))
        failed(start("dmpFlow", case), 4, "has no checksum", f"run {writer} again")
        path.write_bytes(whole)

    run(case, "dmpFlow", "-steps", "1")
    run(case, "dmpFlow", "-steps", "1")
    first, last = sorted((case / "checkpoints").glob("*.h5"))
    whole = last.read_bytes()
    for word in (b"rebuilds", b"strain", b"particles"):
        own = copied(case, folder / word.decode())
        path = own / "checkpoints" / last.name
        flip(path, whole.index(word) + len(word) + 40)
        said = failed(start("dmpFlow", own, "-steps", "1", ranks=2), 0, "passed over", f"Restart from {own}/checkpoints/{first.name}")
        assert last.name in said
    for path in (first, last):
        flip(path, path.read_bytes().index(b"rebuilds"))
    failed(start("dmpFlow", case, ranks=2), 4, "none of the 2 checkpoints is intact", "startFrom: firstTime")
    failed(start("dmpFlow", case, "-set", "system/control.yaml:/startFrom=firstTime"), 0)


if __name__ == "__main__":
    signal.signal(signal.SIGPIPE, signal.SIG_DFL)  # as in a shell; Python ignores the signal, and child processes would inherit that
    with tempfile.TemporaryDirectory(dir=sys.argv[3] if len(sys.argv) > 3 else None) as temporary:
        globals()["test_" + sys.argv[2]](pathlib.Path(temporary))
    print("passed")
