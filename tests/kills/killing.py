"""Ways to end a run before its time. Each starts the run, ends it, waits until all of its processes are gone, and says what happened.

job         SIGKILL of all processes at a moment
rank        SIGKILL of one of the ranks at a moment; mpirun ends the others
launcher    SIGKILL of mpirun alone at a moment
terminate   SIGTERM of the program, or of mpirun, at a moment
checkpoint  SIGKILL of all processes while a checkpoint is being written
fullDisk    a disk on which only a part of the output has room; where the system gives no mount namespaces, fileLimit: a limit on the size of files
"""
import os
import pathlib
import resource
import shutil
import signal
import subprocess
import tempfile
import time
from dataclasses import dataclass, field

import suite
from cases import CASES

KINDS = {1: ("job", "terminate", "checkpoint", "fullDisk"), 2: ("job", "rank", "launcher", "terminate", "checkpoint", "fullDisk")}
MEMORY = "/dev/shm" if os.access("/dev/shm", os.W_OK) else None
# Within its own mount namespace: the case moves to a disk with so many kB more than it takes now, and back when the run has ended.
SMALL_DISK = r"""set -e
case=$1 room=$2; shift 2
cp -a "$case" "$case.outside"
mount -t tmpfs none "$case"
cp -a "$case.outside/." "$case"
used=$(df -k --output=used "$case" | tail -n 1)
mount -o "remount,size=$((used + room))k" "$case"
code=0; "$@" || code=$?
rm -r "$case.outside"
cp -a "$case" "$case.outside"
exit $code
"""
ISOLATED = ["unshare", "--map-root-user", "--mount"]
hasNamespaces = subprocess.run([*ISOLATED, "mount", "-t", "tmpfs", "none", "/mnt"], capture_output=True).returncode == 0


@dataclass
class Kill:
    kind: str
    moment: float  # user time of a rank [s], or room [kB]
    code: int = 0  # 0: the run reached its end before the kill
    inCheckpoint: bool = False
    faults: list = field(default_factory=list)


def command(words, name, case, ranks, *more):
    _, programs, settings = CASES[name]
    launcher = ["mpirun", "--oversubscribe", "-np", str(ranks)] if ranks > 1 else []
    settings = [*settings, *(f"system/control.yaml:/{change}" for change in more)]
    return [*launcher, str(words.bin / programs[-1]), "-quiet", "-case", str(case), *suite.sets(settings)]


class Running:
    """A run in a session folder of its own, which holds what a killed Open MPI leaves behind."""

    def __init__(self, command, prepare=None):
        self.session = tempfile.mkdtemp(prefix="kills", dir=MEMORY)
        self.said = open(pathlib.Path(self.session) / "said", "w+")
        self.hasLauncher = command[0] == "mpirun"
        environment = {**suite.ENVIRONMENT, "TMPDIR": self.session, "OMPI_MCA_btl_vader_backing_directory": self.session, "OMPI_MCA_mpi_yield_when_idle": "1"}
        self.process = subprocess.Popen(command, stdout=self.said, stderr=self.said, env=environment, preexec_fn=prepare, start_new_session=True)
        self.seen = set()

    def processes(self):
        """The launcher and the ranks, or the program alone."""
        found, new = [], [self.process.pid]
        while new:
            pid = new.pop()
            found.append(pid)
            try:
                new += [int(child) for task in os.listdir(f"/proc/{pid}/task") for child in open(f"/proc/{pid}/task/{task}/children").read().split()]
            except (OSError, ValueError):
                pass
        self.seen |= set(found)
        return found

    def processor(self):
        """User time of the rank that has had most [s]. Moments are measured by it: the wall clock depends on what else the machine does, system time on
        how long ranks wait for each other."""
        most = 0
        for pid in self.ranks():
            try:
                ticks = open(f"/proc/{pid}/stat").read().rsplit(")", 1)[1].split()[11]
                most = max(most, int(ticks) / os.sysconf("SC_CLK_TCK"))
            except OSError:
                pass
        return most

    def until(self, moment):
        """True when the run comes to this moment, False if it ends before."""
        while self.process.poll() is None:
            if self.processor() >= moment:
                return True
            time.sleep(0.003)
        return False

    def ranks(self):
        return self.processes()[1:] if self.hasLauncher else self.processes()

    def wait(self, seconds):
        """Exit code (128 + signal, as in a shell) when all processes are gone; None if some are left after that time."""
        deadline = time.monotonic() + seconds
        try:
            code = self.process.wait(seconds)
        except subprocess.TimeoutExpired:
            return None
        while any(alive(pid) for pid in self.seen):
            if time.monotonic() > deadline:
                return None
            time.sleep(0.01)
        return code if code >= 0 else 128 - code

    def end(self, seconds):
        """Waits; what does not end is killed. Returns the exit code, or None, and what was said."""
        code = self.wait(seconds)
        if code is None:
            kill_all(self.processes() + [pid for pid in self.seen if alive(pid)])
            self.process.wait()
        self.said.seek(0)
        text = " ".join(self.said.read().split())
        self.said.close()
        shutil.rmtree(self.session, ignore_errors=True)
        return code, text


def alive(pid):
    try:
        return open(f"/proc/{pid}/stat").read().rsplit(")", 1)[1].split()[0] not in "ZX"
    except OSError:
        return False


def kill_all(pids):
    for pid in pids:
        try:
            os.kill(pid, signal.SIGKILL)
        except ProcessLookupError:
            pass


def allowed(calm):
    """How long a run may take before it counts as hanging [s]: machines have other work, too."""
    return 300 + 20 * calm["seconds"]


def finish(command, calm):
    """Exit code and what was said."""
    return Running(command).end(allowed(calm))


def measure(command):
    """What an undisturbed run takes."""
    run, began, processor = Running(command), time.monotonic(), 0
    while run.process.poll() is None:
        processor = max(processor, run.processor())
        time.sleep(0.003)
    code, said = run.end(60)
    if code != 0:
        raise SystemExit(f"{' '.join(command)} ends with {code}: {said}")
    return {"seconds": time.monotonic() - began, "processor": processor}


def kill(kind, command, case, where, more, calm):
    if kind == "fullDisk":
        return fill_disk(command, case, where, calm)
    if kind == "checkpoint":
        return in_checkpoint(command, case, where, more, calm)
    run, moment = Running(command), where * calm["processor"]
    found = Kill(kind, moment)
    if run.until(moment):
        processes = run.processes()
        if kind == "job":
            kill_all(processes if more < 0.5 else processes[::-1])
        elif kind == "rank":
            ranks = run.ranks()
            kill_all(ranks[int(more * len(ranks)):][:1] or processes)
        elif kind == "launcher":
            kill_all(processes[:1])
        elif kind == "terminate":
            os.kill(run.process.pid, signal.SIGTERM)
    found.inCheckpoint = bool(unfinished(case))
    return ended(found, run, calm)


def unfinished(case):
    return {path.name for path in case.glob("checkpoints/.*.part")}


def in_checkpoint(command, case, where, more, calm):
    """The first checkpoint that is being written after the moment."""
    run, before = Running(command), unfinished(case)
    found = Kill("checkpoint", where * calm["processor"])
    run.until(found.moment)
    while run.process.poll() is None:
        if unfinished(case) - before:
            time.sleep(0.01 * more)
            kill_all(run.processes())
            break
        before &= unfinished(case)
        time.sleep(0.0005)
    run.process.wait()
    found.inCheckpoint = bool(unfinished(case))
    return ended(found, run, calm)


def fill_disk(command, case, where, calm):
    room = int(where * calm["bytes"] / 1024)
    if hasNamespaces:
        found = Kill("fullDisk", room)
        run = Running([*ISOLATED, "bash", "-c", SMALL_DISK, "smallDisk", str(case), str(room), *command])
        ended(found, run, calm, expected=(0, 4))
        outside = pathlib.Path(f"{case}.outside")
        shutil.rmtree(case)
        outside.rename(case)
        return found
    found = Kill("fileLimit", int(where * 1024))
    limit = 1024 * int(found.moment)
    if command[0] == "mpirun":
        at = command.index("-np") + 2
        return ended(found, Running([*command[:at], "prlimit", f"--fsize={limit}:", *command[at:]]), calm, expected=(0, 4))
    return ended(found, Running(command, lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (limit, resource.RLIM_INFINITY))), calm, expected=(0, 4))


def ended(found, run, calm, expected=None):
    run.processes()
    code, said = run.end(allowed(calm))
    found.code = -1 if code is None else code
    if code is None:
        found.faults.append(f"{found.kind}: the run did not end")
    elif expected and code not in expected:
        found.faults.append(f"{found.kind}: exit code {code}: {said[-300:]}")
    return found
