#!/usr/bin/env python3
"""Runs the code cells of a notebook in order, as Jupyter would: the value of a cell's last line is printed, figures are saved in runs/.

    runCells.py NOTEBOOK [OLD->NEW ...]      texts in the cells that are replaced first, to try a notebook out
"""
import ast
import json
import pathlib
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

notebook, *changes = sys.argv[1:]
with open(notebook, encoding="utf-8") as text:
    cells = [cell for cell in json.load(text)["cells"] if cell["cell_type"] == "code"]
names, figures = {"__name__": "__main__"}, 0
for number, cell in enumerate(cells, 1):
    source = "".join(cell["source"])
    for old, new in (change.split("->", 1) for change in changes):
        source = source.replace(old, new)
    tree = ast.parse(source, f"cell {number}")
    last = tree.body.pop() if tree.body and isinstance(tree.body[-1], ast.Expr) and not source.rstrip().endswith(";") else None
    exec(compile(tree, f"cell {number}", "exec"), names)
    value = eval(compile(ast.Expression(last.value), f"cell {number}", "eval"), names) if last else None
    if value is not None:
        print(value)
    for figure in map(plt.figure, plt.get_fignums()):
        figures += 1
        pathlib.Path("runs").mkdir(exist_ok=True)
        figure.savefig(f"runs/figure{figures}.png", dpi=120)
    plt.close("all")
print(f"{len(cells)} cells, {figures} figures in runs/")
