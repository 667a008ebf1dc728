#!/usr/bin/env python3
"""Plots of the tutorials ask for columns by name, never by number, and each name is that of a column: of a table that a program writes (listModels), of a
reference in the repository, or of a table that the tutorial's own script writes. A column that is put into a table would move all behind it.

    plots.py BIN ROOT      BIN: directory of the applications; ROOT: the repository
"""
import json
import pathlib
import re
import subprocess
import sys

NUMBER = re.compile(r"using\s+\(?[0-9]+\)?\s*(?::|$)|:[0-9]|\$[0-9]|[a-z]*col(?:umn)?\([0-9]")
NAME = re.compile(r"column\('(\w+)'\)|(?:using |:)'(\w+)'")


def uses(line):
    """What a line of gnuplot reads from tables: the text from each `using` to the next word of style."""
    return [re.split(r"\s(?:with|every|title|skip)\b", part)[0] for part in re.findall(r"using .*?(?=using |$)", line)]


def known(programs, root):
    models = json.loads(subprocess.run([programs + "/listModels", "-json"], capture_output=True, text=True, check=True).stdout)
    names = {row["column"] for family in ("observer", "relaxation protocol") for model in models[family].values()
             for rows in model.get("tables", {}).values() for row in rows}
    for path in root.glob("tutorials/**/*.csv"):
        names.update(next(line for line in path.read_text().splitlines() if not line.startswith("#")).split(","))
    for path in root.glob("tutorials/**/*.py"):
        names.update(re.findall(r'"(\w+)"', path.read_text()))
    return names


def faults(path, text, names):
    found = []
    for number, line in enumerate(text.splitlines(), 1):
        for part in [] if line.startswith("#") else uses(line):
            if NUMBER.search(part):
                found.append(f"{path}:{number}: column by number in '{part}'")
            found += [f"{path}:{number}: no table has a column '{name}'" for name in sum(NAME.findall(part), ()) if name and name not in names]
    return found


def main():
    programs, root = sys.argv[1], pathlib.Path(sys.argv[2])
    names = known(programs, root)
    paths = [path for path in sorted(root.glob("**/*.gp")) if "build" not in path.relative_to(root).parts[0]]
    found = sum((faults(path.relative_to(root), path.read_text(), names) for path in paths), [])
    assert len(paths) > 10 and not found, "\n".join(found) or paths
    # Wrong uses that this test must find.
    for wrong in ("plot table using 2:4 with lines", "plot f using 2:($6*degrees) with lines", "plot f using 'strain':(column('D12_extend')*2) with lines",
                  "plot f using 'stain':'D12_extent'", "plot f using 'strain':(strcol(1) eq dx ? $4 : NaN) with points"):
        assert faults("x.gp", wrong, names), wrong
    for right in ("plot f using 'strain':(column('angleTurned_rad')*180/pi) with lines lw 2", "plot f using 'strain':'D12_extent' every 3 with points pt 6"):
        assert not faults("x.gp", right, names), faults("x.gp", right, names)


main()
