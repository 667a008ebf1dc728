"""Introduces one fault after another into a valid case; checkCase, or membraneRelax for its own file, must report each with one clear message.

    python3 runBroken.py BIN [NAME ...] [--print]

For every case in cases.py: exit code 2, on standard error exactly the expected problems and the line that counts them, each problem
at the expected place, under the expected key and with the expected words. --print shows the program's messages.
"""
import concurrent.futures
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

from cases import CASES as OWN_CASES
from newcomers import GOOD, NEWCOMERS

CASES = OWN_CASES + NEWCOMERS

BASE = pathlib.Path(__file__).parent / "baseCase"
CRASH = re.compile(r"what\(\)|terminate called|Aborted|Segmentation|Sanitizer|MPI_ABORT|\.[ch]pp\b|std::")
LONGEST = 500  # characters; a message is read on a terminal


def run(program, directory, arguments):
    environment = dict(os.environ, OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")
    return subprocess.run([program, "-case", str(directory), *arguments], capture_output=True, text=True, timeout=120, env=environment)


def faults_of_place(problem, line, directory):
    """Compares 'file:line:column: key: message' with the expected file and key, and with the text at line and column."""
    where = problem.file
    if problem.at is not None:
        found = re.match(re.escape(problem.file) + r":(\d+):(\d+)", line)
        if not found:
            return [f"no {problem.file}:line:column at its start"]
        where = found.group(0)
        row, column = int(found.group(1)), int(found.group(2))
        text = (directory / problem.file).read_bytes().split(b"\n")
        there = text[row - 1][column - 1:].decode(errors="replace") if row <= len(text) else "(past the end of the file)"
        if not there.startswith(problem.at):
            return [f"points at '{there}', not at '{problem.at}'"]
    start = f"{where}: {problem.key}: " if problem.key else f"{where}: "
    return [] if line.startswith(start) else [f"does not start with '{start}'"]


def faults_of(case, result, directory):
    errors = result.stderr.rstrip("\n").split("\n")
    faults = []
    if result.returncode != case.code:
        faults.append(f"exit code {result.returncode} instead of {case.code}")
    if crash := CRASH.search(result.stdout + result.stderr):
        faults.append(f"'{crash.group(0)}' is nothing for a user")
    if "Case OK" in result.stdout:
        faults.append("it says that the case is good")
    n = len(case.problems)
    if case.code == 2:
        count = f"{case.program}: {n} problem{'' if n == 1 else 's'} in the case {directory}"
        if errors[-1] != count:
            faults.append(f"the last line is not '{count}'")
        errors.pop()
    if len(errors) != n:
        faults.append(f"{len(errors)} problem lines instead of {n}")
    for problem, line in zip(case.problems, errors):
        faults += faults_of_place(problem, line, directory)
        faults += [f"lacks '{word}'" for word in problem.words if word not in line]
        if len(line) > LONGEST:
            faults.append(f"a message of {len(line)} characters")
    return faults


def check(programs, case, directory, show):
    shutil.copytree(BASE, directory)
    for edit in case.edits:
        edit(directory)
    try:
        result = run(programs / case.program, directory, case.arguments)
    except subprocess.TimeoutExpired:
        return f"{case.name}: no answer in two minutes"
    faults = faults_of(case, result, directory)
    text = "".join(f"{case.name}: {fault}\n" for fault in faults)
    return text + (f"--- {case.name}\n{result.stderr}\n" if faults or show else "")


def check_good(program, directory, edits=(), name="base"):
    shutil.copytree(BASE, directory)
    for edit in edits if isinstance(edits, (list, tuple)) else [edits]:
        edit(directory)
    result = run(program, directory, [])
    return "" if result.returncode == 0 and not result.stderr else f"the case '{name}' is not good:\n{result.stderr}"


def check_json(program, directory):
    """-json gives the same problems as data."""
    shutil.copytree(BASE, directory)
    result = run(program, directory, ["-json", "-set", "system/mesh.yaml:/cells/0/edge=-1 um"])
    problems = json.loads(result.stdout)["problems"]
    good = result.returncode == 2 and [p["key"] for p in problems] == ["cells[0].edge"] and problems[0]["file"] == "-set"
    return "" if good else f"-json: {result.stdout}"


def main():
    arguments = sys.argv[1:]
    show = "--print" in arguments
    folder, *names = [a for a in arguments if a != "--print"]
    programs = pathlib.Path(folder)
    program = programs / "checkCase"
    chosen = [case for case in CASES if not names or case.name in names]
    assert len({case.name for case in CASES}) == len(CASES), "two cases of one name"
    with tempfile.TemporaryDirectory() as temporary, concurrent.futures.ThreadPoolExecutor(2) as pool:
        top = pathlib.Path(temporary)
        jobs = [pool.submit(check, programs, case, top / case.name, show) for case in chosen]
        jobs += [pool.submit(check_good, program, top / name, edits, name) for name, edits in GOOD.items() if not names or name in names]
        jobs += [pool.submit(check_good, program, top / "good"), pool.submit(check_json, program, top / "json")]
        texts = [job.result() for job in jobs]
    print("".join(texts), end="")
    failed = sum(1 for text in texts if text and not text.startswith("---"))
    print(f"{len(chosen)} broken cases, {failed} not answered as they should be")
    return 1 if failed or not chosen else 0


if __name__ == "__main__":
    sys.exit(main())
