"""Tables of observers as DataFrames."""
import re

import pandas

COLUMN = re.compile(r"# ([A-Za-z0-9_-]+): (.*?)(?: \[([^\]]+)\])?$")


def readTable(path):
    """A table postProcessing/OBSERVER/FILE.csv, or summary.csv of a study.

    It holds the whole run, however often that was continued. A last row that is being written is left out. attrs["meanings"] and
    attrs["units"] have an entry for each column, attrs["title"] the first line.
    """
    with open(path, encoding="utf-8") as text:
        lines = [line for line in text if line.endswith("\n")]
    comments = [line.rstrip("\n") for line in lines if line.startswith("#")]
    rows = [line for line in lines if not line.startswith("#")]
    if not rows:
        raise ValueError(f"{path} has no rows and no head")
    import io
    table = pandas.read_csv(io.StringIO("".join(rows)), float_precision="round_trip", keep_default_na=False, na_values=["", "nan", "-nan"])
    found = {match[1]: match for match in map(COLUMN.match, comments) if match and match[1] in table.columns}
    table.attrs["title"] = comments[0].lstrip("# ") if comments else ""
    table.attrs["meanings"] = {name: match[2] for name, match in found.items()}
    table.attrs["units"] = {name: match[3] or "" for name, match in found.items()}
    return table
