"""The programs of Corpuscle: where they are, and what they say when they fail."""
import json
import os
import pathlib
import shutil
import subprocess


class CorpuscleError(RuntimeError):
    """A program ended with another exit code than 0: `code`, and its own message."""

    def __init__(self, name, code, text):
        super().__init__(f"{name} ended with code {code}:\n{text.strip()}")
        self.code = code


def program(name):
    """Path of a program."""
    folders = [os.environ.get("CORPUSCLE_BIN"), pathlib.Path(__file__).resolve().parents[2] / "build" / "bin"]
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


def run(words, allowed=(0,), show=False):
    """Runs a program and returns (exit code, standard output). show: its output appears while it runs, and is not returned."""
    if show:
        done = subprocess.run(words, env=environment(), stdin=subprocess.DEVNULL)
        output, errors = "", "see above"
    else:
        done = subprocess.run(words, env=environment(), stdin=subprocess.DEVNULL, capture_output=True, text=True)
        output, errors = done.stdout, done.stderr or done.stdout
    if done.returncode not in allowed:
        raise CorpuscleError(os.path.basename(words[0]), done.returncode, errors)
    return done.returncode, output


def runJson(name, *words):
    """The JSON value that a program prints under -json."""
    return json.loads(run([program(name), *map(str, words), "-json"])[1])
