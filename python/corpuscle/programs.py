"""The programs of Corpuscle: where they are, and what they say when they fail."""
import json
import os
import pathlib
import shutil
import signal
import subprocess


class CorpuscleError(RuntimeError):
    """A program ended with another exit code than 0: `code`, and its own message."""

    def __init__(self, name, code, text):
        super().__init__(f"{name} ended with code {code}:\n{text.strip()}")
        self.code = code


def program(name):
    """Path of a program."""
    here = pathlib.Path(__file__).resolve()  # in the repository, or in share/corpuscle of an installation
    folders = [os.environ.get("CORPUSCLE_BIN"), here.parents[2] / "build" / "bin", *(parent / "bin" for parent in here.parents[4:5])]
    for folder in filter(None, folders):
        if (pathlib.Path(folder) / name).is_file():
            return str(pathlib.Path(folder) / name)
    found = shutil.which(name)
    if not found:
        raise FileNotFoundError(f"{name} is neither in $CORPUSCLE_BIN nor in build/bin of the repository nor in PATH")
    return found


def environment():
    """Of this process; Open MPI refuses to start for root unless it is told that this is meant, as it is in containers."""
    variables = dict(os.environ)
    if os.geteuid() == 0:
        variables.setdefault("OMPI_ALLOW_RUN_AS_ROOT", "1")
        variables.setdefault("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1")
    return variables


def _childrenOf(parent):
    found = []
    for stat in pathlib.Path("/proc").glob("[0-9]*/stat"):
        try:
            text = stat.read_text()
        except OSError:  # it has ended
            continue
        if int(text.rpartition(")")[2].split()[1]) == parent:
            found.append(int(stat.parent.name))
    return found


def _stop(process, launches):
    """Asks a solver to write a checkpoint and stop; of mpirun its ranks, since mpirun would end them at once."""
    for one in (_childrenOf(process.pid) if launches else []) or [process.pid]:
        try:
            os.kill(one, signal.SIGTERM)
        except ProcessLookupError:
            continue
    process.wait()


def run(words, allowed=(0,), show=False):
    """Runs a program and returns (exit code, standard output). show: its output appears while it runs, and is not returned. An interrupt
    (Ctrl-C, a notebook's stop) lets a solver write a checkpoint before it is passed on."""
    pipe = None if show else subprocess.PIPE
    # In a group of its own: a terminal's Ctrl-C reaches this process alone.
    process = subprocess.Popen([str(word) for word in words], env=environment(), stdin=subprocess.DEVNULL, stdout=pipe, stderr=pipe, text=True,
                               start_new_session=True)
    try:
        output, errors = process.communicate()
    except BaseException:
        _stop(process, os.path.basename(str(words[0])) == "mpirun")
        raise
    if process.returncode not in allowed:
        raise CorpuscleError(os.path.basename(str(words[0])), process.returncode, "its output stands above" if show else errors or output)
    return process.returncode, output or ""


def runJson(name, *words):
    """The JSON value that a program prints under -json."""
    return json.loads(run([program(name), *map(str, words), "-json"])[1])
