#!/usr/bin/python3
"""caseReport: the page of real runs, taken apart again and compared with the files of the case, and what cannot be reported.

    caseReport.py BIN SOURCE
"""
import base64
import csv
import html.parser
import json
import math
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

BIN, SOURCE = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()
sys.path.insert(0, str(SOURCE / "python"))

import numpy  # noqa: E402

import corpuscle  # noqa: E402
import pythonProgram  # noqa: E402

os.environ["CORPUSCLE_BIN"] = str(BIN)
run, refused = pythonProgram.runs(BIN / "caseReport")
SHORT = ["system/control.yaml:/endStrain=0.4", "system/control.yaml:/write/strain=0.2"]
ONE = SHORT + ["system/numerics.yaml:/spacing=1.25 um", "system/mesh.yaml:/cells/0/edge=1.2 um", "system/observers.yaml:/deformation/every=0.1 strain",
               "system/observers.yaml:/balance/every=0.1 strain"]
# Three capsules in a flow without walls; the images across z slide.
MANY = SHORT + ["system/numerics.yaml:/spacing=1 um", "system/mesh.yaml:/domain={size: [12 um, 12 um, 12 um], periodic: [true, true, true]}", "constant/flow.yaml:/type=leesEdwards",
                "system/mesh.yaml:/cells/0={name: capsule, shape: {type: sphere, radius: 2 um}, edge: 1 um, "
                "places: [{centre: [0 um, 0 um, 5.8 um]}, {centre: [5.9 um, 0 um, 0 um]}, {centre: [-0.5 um, 5.5 um, -0.5 um]}]}"]
VOID = {"area", "base", "br", "col", "hr", "img", "input", "link", "meta", "source", "wbr", "path", "use"}


class Page(html.parser.HTMLParser):
    """Elements of a page, which must be closed in order; text by the nearest heading."""

    def __init__(self, path):
        super().__init__()
        self.open, self.elements, self.text, self.script, self.heading = [], [], {}, {}, ""
        self.feed(path.read_text(encoding="utf-8"))
        assert not self.open, self.open

    def handle_starttag(self, tag, attributes):
        self.elements.append((tag, dict(attributes)))
        if tag not in VOID:
            self.open.append((tag, dict(attributes)))
        if tag == "h2":
            self.heading = ""

    def handle_startendtag(self, tag, attributes):
        self.elements.append((tag, dict(attributes)))

    def handle_endtag(self, tag):
        if tag in VOID:
            return
        assert self.open and self.open[-1][0] == tag, (tag, self.open[-3:])
        self.open.pop()

    def handle_data(self, data):
        tag, attributes = self.open[-1] if self.open else ("", {})
        if tag == "h2":
            self.heading += data
        elif tag == "script":
            self.script[attributes.get("id", "")] = data
        else:
            self.text[self.heading] = self.text.get(self.heading, "") + data + "\n"


def tutorial(name, folder, changes, remove=()):
    subprocess.run([BIN / "cloneCase", SOURCE / "tutorials" / name, folder, "-quiet"], check=True)
    for one in remove[1:]:
        subprocess.run([BIN / "caseDict", "-quiet", "-case", folder, "-remove", one], check=True)
    words = sum((["-set", one] for one in changes), []) + sum((["-remove", one] for one in remove[:1]), [])
    subprocess.run([BIN / "caseDict", "-quiet", "-case", folder, *words], check=True)
    for program in ("membraneMesh", "particleFill", "dmpFlow"):
        subprocess.run([BIN / program, "-quiet", "-case", folder], check=True)
    return folder


def unpacked(text, kind):
    return numpy.frombuffer(base64.b64decode(text), dtype=kind)


def meshes(page):
    """Points [m] of each frame and stream as the page draws them, triangles, labels."""
    data = json.loads(page.script["meshes"])
    low, high = numpy.array(data["low"]), numpy.array(data["high"])
    frames = [{name: low + unpacked(mesh["points"], "<u2").reshape(-1, 3) / 65535 * (high - low) for name, mesh in frame["meshes"].items()} for frame in data["frames"]]
    return data, frames, (high - low) / 65535


def oneCell(folder):
    case = tutorial("rbcShear/Ca0.02", folder / "one", ONE)
    # A reference that differs from the table by known amounts, and whose last point lies beyond the run.
    rows = list(csv.DictReader(line for line in open(case / "postProcessing/deformation/rbc.csv") if not line.startswith("#")))
    strains, values = ([float(row[key]) for row in rows] for key in ("strain", "D12_inertia"))
    reference = folder / "known.csv"
    offsets = [0.01, -0.03] + [0.02] * (len(rows) - 2)
    reference.write_text("# made up\nstrain, D12_inertia, somethingElse\n" + "".join(f"{x},{y - d},0\n" for x, y, d in zip(strains, values, offsets)) + "9,0.5,0\n")
    answer = json.loads(run(case, "-reference", reference, "-json", "-field", "stretch", "-pictures", 2))
    page = Page(pathlib.Path(answer["output"]))
    assert pathlib.Path(answer["output"]) == case / "postProcessing/report.html" and answer["warnings"] == [], answer
    compared = page.text["Comparison"].split("\n")
    at = compared.index("deformation/rbc: D12_inertia")
    assert compared[at + 1:at + 3] == ["known.csv", str(len(rows))], compared
    expected = [math.sqrt(sum(d * d for d in offsets) / len(offsets)), 0.03]
    found = [float(compared[at + 3]), float(compared[at + 4])]
    assert all(abs(a / b - 1) < 5e-3 for a, b in zip(found, expected)), (found, expected)
    assert float(compared[at + 6]) == 0.02, compared
    data, frames, precision = meshes(page)
    one = corpuscle.Case(case)
    assert len(frames) == 3 and [frame["label"] for frame in data["frames"]] == ["strain 0", "strain 0.2", "strain 0.4"], data["frames"][0]["label"]
    for strain, frame in zip((0, 0.2, 0.4), frames):
        surface = one.surface("rbc", strain=strain)
        assert (abs(frame["rbc"] - surface.points) <= 0.51 * precision).all(), abs(frame["rbc"] - surface.points).max()
    assert (unpacked(data["meshes"]["rbc"]["triangles"], "<u4").reshape(-1, 3) == surface.triangles).all()
    assert data["field"] == "stretch" and data["box"] == [2e-5] * 3, data["box"]
    stretch, (low, high) = surface.pointData["stretch"], data["bounds"]
    drawn = low + unpacked(data["frames"][-1]["meshes"]["rbc"]["values"], "u1") / 255 * (high - low)
    assert abs(drawn - stretch).max() < 0.6 * (high - low) / 255, abs(drawn - stretch).max()
    pictures = [attributes["src"] for tag, attributes in page.elements if tag == "img"]
    assert len(pictures) == 1 and base64.b64decode(pictures[0].split(",")[1])[:4] == b"\x89PNG"
    links = [attributes[key] for _, attributes in page.elements for key in ("src", "href", "xlink:href") if key in attributes]
    assert all(link.startswith(("data:", "#")) for link in links), "the page needs nothing else"
    record = one.record
    for words, heading in ((f"{record['groups']['Ca']:.6g}", "Dimensionless groups and parameters"), ("residualShare", "Budget of energy and momentum"),
                           (str(record["performance"]["steps"]), "Cost and steps"), ("system/numerics.yaml", "Settings"), ("kuchelFackerell", "Settings")):
        assert words in page.text[heading], (words, heading)
    assert "deformation/rbc:" in page.text["Curves"] and "balance/budget:" in page.text["Curves"]
    assert page.text["Curves"].index("deformation/rbc:") < page.text["Curves"].index("balance/budget:")
    only = Page(pathlib.Path(json.loads(run(case, "-table", "deformation/rbc", "-pictures", 0, "-field", "none", "-output", folder / "few.html", "-json"))["output"]))
    assert "balance/budget:" not in only.text["Curves"] and not any(tag == "img" for tag, _ in only.elements) and meshes(only)[0]["field"] is None
    beside(case, folder)
    # Text of the case is text of the page.
    (case / "log.dmpFlow").open("a").write("warning: <b>odd</b> & 1 of 3\nwarning: <b>odd</b> & 2 of 3\n")
    run(case, "-pictures", 0)
    assert "dmpFlow: <b>odd</b> & 1 of 3 (and 1 more like it)" in Page(case / "postProcessing/report.html").text["Warnings"]

    before = (case / "postProcessing/report.html").read_bytes()
    refused(case, 1, "Did you mean '-field'", "-feild", "x")
    refused(case, 1, "allowed is a whole number", "-pictures", "many")
    refused(case, 2, "no cell has an array 'areaStrein'", "-field", "areaStrein")
    refused(case, 2, "there is no table 'deformation/red'", "-table", "deformation/red")
    refused(case, 2, "there is no such reference", "-reference", folder / "none.csv")
    for name, text, message in (("a.csv", "D12_inertia\n1\n", "no column strain, time_s or stage"), ("b.csv", "strain,other\n1,2\n", "no column that a table has too"),
                                ("c.csv", "strain,D12_inertia\n0,much\n", "is not of numbers"), ("d.csv", "", "is no CSV file"), ("e.csv", "\0\1\2", "")):
        (folder / name).write_text(text)
        refused(case, 2, message, "-reference", folder / name)
    refused(case, 4, "", "-output", "/proc/report.html")
    assert (case / "postProcessing/report.html").read_bytes() == before and not list((case / "postProcessing").glob("*.new"))
    (case / "run.json").rename(case / "away.json")
    refused(case, 2, "run the case first")
    refused(folder, 4, "is not a case")
    refused(folder / "nowhere", 4, "there is no such directory")


def beside(case, folder):
    """Another case is a copy with one setting, one column and the end of a table changed by known amounts."""
    other = folder / "other" / case.name
    shutil.copytree(case, other)
    table = other / "postProcessing/deformation/rbc.csv"
    lines = table.read_text().splitlines()
    first = next(k for k, line in enumerate(lines) if not line.startswith("#"))
    head, rows = lines[first].split(","), [line.split(",") for line in lines[first + 1:]]
    column = head.index("D12_inertia")
    for row in rows:
        row[column] = repr(float(row[column]) + 0.25)
    table.write_text("\n".join([*lines[:first + 1], *(",".join(row) for row in rows[:-1])]) + "\n")  # ends one row earlier
    used = (other / "used.yaml").read_text()
    changed = re.sub(r"(endStrain: )\S+", r"\g<1>0.375", used)
    assert changed != used
    (other / "used.yaml").write_text(changed)
    page = Page(pathlib.Path(json.loads(run(case, "-with", other, "-pictures", 0, "-output", folder / "beside.html", "-json"))["output"]))
    names = [f"{case.parent.name}/{case.name}", f"other/{case.name}"]
    assert page.text["Settings that differ"].split() == ["setting", *names, "system/control.yaml:/endStrain", "0.4", "0.375"], page.text["Settings that differ"]
    values = page.text["Last values"].split("\n")
    at = values.index("deformation/rbc: D12_inertia")
    end, mine = float(rows[-2][head.index("strain")]), float(rows[-2][column]) - 0.25
    assert abs(float(values[at + 1]) - end) < 1e-6 and abs(float(values[at + 2]) - mine) < 1e-5 and abs(float(values[at + 3]) - mine - 0.25) < 1e-5, (values[at:at + 4], end, mine)
    same = values.index("deformation/rbc: length_m")
    assert values[same + 2] == values[same + 3], values[same:same + 4]
    assert all(page.text["Curves"].count(name) >= 5 for name in names), "each curve has its name"
    refused(case, 2, "compared with itself", "-with", case)
    refused(case, 4, "is -with right?", "-with", folder / "nowhere")
    (other / "run.json").unlink()
    refused(case, 2, "run the case first", "-with", other)


def manyCells(folder):
    case = tutorial("capsuleShear", folder / "many", MANY, ["constant/flow.yaml:/walls", "system/observers.yaml:/wall"])
    page = Page(pathlib.Path(json.loads(run(case, "-pictures", 1, "-json"))["output"]))
    data, frames, precision = meshes(page)
    one = corpuscle.Case(case)
    name = one.streams[0] if one.streams[0] != "fluid" else one.streams[1]
    surface = one.surface(name)
    cells = surface.pointData["cell"]
    assert sorted(set(cells)) == [1, 2, 3]
    size, offset = numpy.array([12e-6] * 3), float(surface.fieldData["imageOffset"][0])
    for cell in (1, 2, 3):
        moved = frames[-1][name][cells == cell] - surface.points[cells == cell]
        assert (abs(moved - moved[0]) < 1.1 * precision).all(), "a cell is moved as a whole"
        middle = frames[-1][name][cells == cell].mean(axis=0)
        assert (abs(middle) <= size / 2 * 1.001).all(), middle
        times = numpy.rint(moved[0][2] / size[2])
        rest = moved[0] - times * numpy.array([offset, 0, size[2]])
        rest -= size * numpy.rint(rest / size)
        assert (abs(rest) < 2 * precision).all(), (moved[0], offset)


with tempfile.TemporaryDirectory() as scratch:
    for check in [one for one in (oneCell, manyCells) if one.__name__ in (sys.argv[3:] or one.__name__)]:
        check(pathlib.Path(scratch))
        print(check.__name__, "passed")
