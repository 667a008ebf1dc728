"""Whether a case holds the same results as another one, to the last bit."""
import json
import pathlib
import re
import subprocess

ASIDE = re.compile(r"(checkpoints/\d+\.h5|log\.\w+|run\.json)$")  # compared by their contents: numbers, dates and durations differ


def files(case):
    return {str(path.relative_to(case)): path for path in sorted(pathlib.Path(case).rglob("*")) if path.is_file()}


def differences(whole, case, but=()):
    """What differs between the uninterrupted run and the other one, as texts."""
    expected, found = files(whole), files(case)
    names = {name for name in {*expected, *found} if not ASIDE.match(name) and name not in but}
    texts = [f"{name} is missing" for name in sorted(names - set(found))] + [f"{name} is left over" for name in sorted(names - set(expected))]
    texts += [f"{name} differs" for name in sorted(names & set(expected) & set(found)) if expected[name].read_bytes() != found[name].read_bytes()]
    return texts + checkpoints(whole, case) + records(whole, case) + log(case)


def checkpoints(whole, case):
    last = [max(folder.glob("checkpoints/*.h5"), default=None) for folder in (whole, case)]
    if None in last:
        return ["there is no checkpoint"]
    done = subprocess.run(["h5diff", *map(str, last)], capture_output=True, text=True)
    return [] if done.returncode == 0 else [f"the last checkpoint differs: {' '.join((done.stdout + done.stderr).split())[:300]}"]


def records(whole, case):
    """What run.json says at the end."""
    one, other = (json.loads((folder / "run.json").read_text()) for folder in (whole, case))
    return [f"run.json: {key}: {other.get(key)} instead of {one.get(key)}" for key in ("status", "result", "observers", "groups") if one.get(key) != other.get(key)]


def log(case):
    """The log is one text with one end, whatever happened before."""
    (path,) = case.glob("log.*Flow")
    data = path.read_bytes()
    try:
        text = data.decode()
    except UnicodeDecodeError as fault:
        return [f"{path.name} is no text: {fault}"]
    texts = [f"{path.name} holds NUL"] if "\0" in text else []
    if text.count("End after") != 1:
        texts.append(f"{path.name} says {text.count('End after')} times that the run has ended")
    return texts if text.endswith("\n") else [*texts, f"{path.name} is cut off"]


def readable(case):
    """After a kill: every index names files that are there, and the tables are complete but for the line that was being written."""
    texts = []
    for index in case.glob("results/*.pvd"):
        names = re.findall(r'file="([^"]+)"', index.read_text())
        for name in names:
            piece = index.parent / name
            if not piece.exists():
                texts.append(f"{index.name} names {name}, which is not there")
            else:
                texts += [f"{name} names {source}, which is not there" for source in re.findall(r'Source="([^"]+)"', piece.read_text())
                          if not (piece.parent / source).exists()]
    for path in case.glob("postProcessing/*/*.csv"):
        rows = [line for line in path.read_text().split("\n")[:-1] if not line.startswith("#")]
        if len({row.count(",") for row in rows}) > 1:
            texts.append(f"{path.name} has rows of different lengths")
    return texts
