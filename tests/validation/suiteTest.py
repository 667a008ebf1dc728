#!/usr/bin/env python3
"""What validation rests on: what counts as held, orders, interpolation, tables; bad words on the command line."""
import math
import pathlib
import subprocess
import sys
import types

import suite
from suite import Figure, asdict

HERE = pathlib.Path(__file__).resolve().parent


def record(n, error, allowed=1.0):
    return {"resolution": n, "particles": n**3, "coreSeconds": 1.5, "figures": [asdict(Figure("drag", error, allowed, order=True))]}


def test_held():
    assert Figure("a", -0.9, 1).holds() and Figure("a", 1, 1).holds()
    assert not Figure("a", 1.1, 1).holds() and not Figure("a", -1.1, 1).holds()
    assert not Figure("a", math.nan, 1).holds(), "what was not measured does not hold"
    figure = suite.relative("a", 0.98, 1, 1)
    assert math.isclose(figure.error, -2) and not figure.holds()


def test_orders():
    records = [record(8, 4.0), record(16, -1.0), record(48, 0.1)]
    first, second = suite.orders(records)["drag"]
    assert math.isclose(first, 2) and math.isclose(second, math.log(10) / math.log(3))
    assert suite.orders([record(8, 1.0), record(16, 0.0)]) == {}


def test_between():
    table = [{"strain": 0.0, "D": 1.0}, {"strain": 2.0, "D": 3.0}]
    assert suite.at(table, 0.5, "D") == 1.5 and suite.at(table, 0.5, lambda row: 2 * row["D"]) == 3
    assert math.isnan(suite.at(table, 2.5, "D"))


def test_tables():
    case = types.SimpleNamespace(ACROSS="across")
    lines = suite.table(case, [record(8, 4.0), record(16, 0.5)]).splitlines()
    assert lines[0].startswith("| across | 8 | 16 |") and "+4 % **outside** | +0.5 % | 3.0 | 1 %" in lines[2], lines


def test_words():
    for words, said in ((["nowhere"], "no case 'nowhere'"), (["couette", "-resolution", "fine"], "a number, or all"), (["couette", "-resolutoin", "16"], "-resolutoin")):
        done = subprocess.run([HERE / "validate", *words], capture_output=True, text=True)
        assert done.returncode == 1 and said in done.stderr and not done.stdout, done


def test_cases():
    """Each is whole: page with its marks, resolutions from coarse to fine."""
    assert len(suite.names()) >= 3
    for name in suite.names():
        case, page = suite.load(name), (HERE / name / "README.md").read_text()
        assert all(page.count(mark) == 1 for mark in suite.MARKS), name
        assert list(case.RESOLUTIONS) == sorted(case.RESOLUTIONS) and case.TITLE and case.ACROSS, name
        assert all(run.source.is_dir() and run.programs for run in case.runs(case.RESOLUTIONS[0])), name


if __name__ == "__main__":
    for name, test in list(globals().items()):
        if name.startswith("test_"):
            test()
    print("passed")
