"""A spherical neo-Hookean capsule in shear flow, against the band of published curves and own boundary elements."""
import csv
import math
import pathlib

from membranes import Course, settings
from suite import TUTORIALS, Figure, Plot, Run, at, rows

HERE = pathlib.Path(__file__).resolve().parent
TITLE = "capsule in shear flow, neo-Hookean"
ACROSS = "particles along the radius"
RESOLUTIONS = (6, 8, 12)
CAPILLARY = {6: ("0.3",), 8: ("0.075", "0.3", "0.6"), 12: ("0.075", "0.3", "0.6")}
BOX = (8, 6, 8)  # radii, along the flow, the vorticity and the gradient
EDGE = 0.5  # of the mesh, in spacings
STRAIN = 5
TIMES = (1, 3, 4, 5)
READING, MESH = 0.003, 0.002  # errors of D: of reading published curves; of the boundary elements, 642 against 2562 nodes
ALLOWED = {6: 0.5, 8: 0.5, 12: 0}  # % outside the band; inside at the finest is the aim


def runs(n):
    return [Run(f"Ca{Ca}", TUTORIALS / "capsuleShear", settings(n, BOX, STRAIN, [
        f"constant/flow.yaml:/Ca={Ca}", "constant/membranes.yaml:/capsule/triangles={type: neoHookean, Gs: 1e-5 N/m}"], EDGE),
        ("membraneMesh", "particleFill", "dmpFlow")) for Ca in CAPILLARY.get(n, CAPILLARY[12])]


def published(Ca):
    """Curves by their source: rows of strain and D."""
    found = {}
    with open(HERE / "published.csv") as text:
        for row in csv.DictReader(line for line in text if not line.startswith("#")):
            if float(row["Ca"]) == float(Ca):
                found.setdefault(row["source"], []).append({"strain": float(row["strain"]), "D": float(row["D"])})
    return found


def band(Ca, strain):
    """Least and greatest D of all sources that reach this strain, each with its error."""
    found = [(at(table, strain, "D"), READING) for table in published(Ca).values()]
    found.append((at(rows(HERE / f"reference_Ca{Ca}.csv"), strain, "D12_inertia"), MESH))
    found = [(value, error) for value, error in found if math.isfinite(value)]
    return min(value - error for value, error in found), max(value + error for value, error in found)


def outside(value, low, high):
    """Per cent of the nearest edge; 0 inside."""
    return 100 * (value / high - 1 if value > high else value / low - 1 if value < low else 0)


def figures(done, n):
    found, allowed = [], ALLOWED.get(n, 0)
    for name, folder in done.items():
        Ca, course = name[2:], Course(folder)
        for strain in TIMES:
            low, high = band(Ca, strain)
            value = course.at(strain, "D12_inertia")
            found.append(Figure(f"Ca {Ca}: D12 at strain {strain}, outside {low:.3f} to {high:.3f}", outside(value, low, high), allowed, "%", value))
        found += course.kept(f"Ca {Ca}")
    return found


def curves(done):
    ours, theirs = [], []
    for name, folder in done.items():
        ours.append((f"Ca {name[2:]}", *Course(folder).curve("D12_inertia", 0.2)))
        for table in published(name[2:]).values():
            table = [row for row in table if row["strain"] <= STRAIN]
            theirs.append(("", [row["strain"] for row in table], [row["D"] for row in table]))
        table = [row for row in rows(HERE / f"reference_Ca{name[2:]}.csv") if row["strain"] <= STRAIN]
        theirs.append(("", [row["strain"] for row in table], [row["D12_inertia"] for row in table]))
    return Plot("strain", "D12", ours, theirs, ["set key at 4.8, 0.28", "set xrange [0:]", "set yrange [0:0.6]"])
