"""Shared by cases with one membrane in shear flow: sizes, the course of a run, period of a tank-treading membrane, meshes from other sources."""
import math
import re
import xml.etree.ElementTree as ElementTree

import suite
import vtp
from suite import HERE, PROGRAMS, Figure, Plot, Run, at, fromOn, rows
from summary import axisTurned, series

RADIUS = 4  # um
COARSEST = 5  # particles along the radius


def settings(n, box, strain, more=(), edge=1.0):
    """n particles along the radius, in a box in radii (flow, vorticity, gradient), the mesh's edge in spacings; three results before the end."""
    spacing = RADIUS / n
    sides = ", ".join(f"{length * RADIUS:g} um" for length in box)
    return [f"system/mesh.yaml:/domain/size=[{sides}]", f"system/numerics.yaml:/spacing={spacing:.8g} um",
            f"system/mesh.yaml:/cells/0/edge={edge * spacing:.8g} um", f"system/control.yaml:/endStrain={strain}",
            "system/control.yaml:/write/strain=0.25", "system/control.yaml:/write/fields=[velocity]", "system/control.yaml:/write/keep=3", *more]


class Course:
    """Course of a finished run: shape, angle of the main axis with the flow, area and volume."""

    def __init__(self, folder):
        self.folder = folder
        self.shape = series(folder, "deformation", "*.csv")
        self.balance = series(folder, "balance", "conservation.csv")
        (self.cell,) = (path.stem for path in (folder / "postProcessing" / "deformation").glob("*.csv"))
        for row, turned in zip(self.shape, axisTurned(self.shape)):
            row["angle_deg"] = turned
        self.end = self.shape[-1]["strain"]

    def at(self, strain, key):
        return at(self.shape, strain, key)

    def curve(self, key, every):
        """Strains and values, for a plot."""
        strains = [every * k for k in range(int(self.end / every + 1e-6) + 1)]
        return strains, [self.at(t, key) for t in strains]

    def turn(self, degrees):
        return turn(self.shape, degrees)

    def kept(self, label):
        """Figures of quantities that must be conserved."""
        volume = suite.worst(row["volumeChange"] for row in self.balance)
        return [Figure(f"{label}: volume, at most", 100 * volume, 1e-5),
                Figure(f"{label}: particles that changed side, at most", suite.worst(row["changedSide"] for row in self.balance), 0, ""),
                Figure(f"{label}: particles moved back", suite.worst(row["guardMoves"] for row in self.balance), 0, "")]

    def area(self, strain):
        return at(self.balance, strain, "areaChange")


def turn(table, degrees):
    """Strain at which the main axis has turned by `degrees`; nan if it never does."""
    return at(table, degrees, "strain", "angle_deg")


def worst(course, reference, key, strains, scale=1.0):
    """Largest difference from the reference over these strains, with its sign; nan if the run has not reached them."""
    return suite.worst(scale * (course.at(t, key) - at(reference, t, key)) for t in strains)


class Sheared:
    """A case: one membrane in shear flow over Ca, or another number that is varied, against curves reference_Ca*.csv.

    name: the folder of the curves. source: the tutorial. scenes: by Ca (a word), strain of the end and boxes by the resolution from which on they hold.
    more: settings of every run. edge: of the mesh, in spacings. coarse: the only Ca that is run at the coarsest resolution; all without it.
    varied: the name of what is varied, and where it is set.
    """

    def __init__(self, name, source, scenes, more, edge=1.0, programs=PROGRAMS, coarse=None, varied=("Ca", "constant/flow.yaml:/Ca")):
        self.folder, self.source, self.scenes, self.more = HERE / name, source, scenes, more
        self.edge, self.programs, self.coarse = edge, programs, coarse
        self.varied, self.place = varied

    def runs(self, n):
        return [Run(f"{self.varied}{value}", self.source, settings(n, fromOn(boxes, n), strain, [f"{self.place}={value}", *self.more], self.edge),
                    self.programs)
                for value, (strain, boxes) in self.scenes.items() if n > COARSEST or self.coarse in (None, value)]

    def label(self, value):
        return f"{self.varied} {value}"

    def courses(self, done):
        """(Ca, course of the run) of finished runs."""
        return [(value, Course(done[f"{self.varied}{value}"])) for value in self.scenes if f"{self.varied}{value}" in done]

    def reference(self, value, end=math.inf):
        return [row for row in rows(self.folder / f"reference_{self.varied}{value}.csv") if row["strain"] <= end]

    def drawn(self, done, ylabel, every, extra, others=lambda Ca, end: []):
        """D12_inertia of each course and its reference. others: further published curves at a Ca up to a strain, (strains, values)."""
        ours, theirs = [], []
        for Ca, course in self.courses(done):
            ours.append((self.label(Ca), *course.curve("D12_inertia", every)))
            end = course.end + 1e-6
            table = self.reference(Ca, end)
            theirs += [("", *curve) for curve in others(Ca, end)]
            theirs.append(("", [row["strain"] for row in table], [row["D12_inertia"] for row in table]))
        return Plot("strain", ylabel, ours, theirs, extra)


def snapshots(folder, cell):
    """(strain, file) of the results of a membrane that are on disk, in order. Strains are read from each file, as the collection has times."""
    found = []
    for entry in ElementTree.parse(folder / "results" / f"{cell}.pvd").getroot().iter("DataSet"):
        path = folder / "results" / entry.get("file")
        if path.suffix == ".pvtp":
            pieces = [path.parent / piece.get("Source") for piece in ElementTree.parse(path).getroot().iter("Piece")]
            (path,) = [piece for piece in pieces if vtp.count(piece)]  # one for each rank; the cell is whole on one of them
        found.append((float(entry.get("timestep")), path))
    return sorted(found)


def treadPeriod(course):
    """Time in which the membrane goes once round, in units of 1/gammadot, from two results of a steady shape.

    Nodes near the shear plane (within 0.15 radii) pass each polar angle phi about the centroid at a speed that depends on phi only, w(phi); the integral
    of dphi/w over a turn is the period. The mean speed of a node between two results is that at the middle of its way.
    """
    (t1, one), (t2, two) = snapshots(course.folder, course.cell)[-2:]
    ratio = course.shape[-1]["strain"] / course.shape[-1]["time_s"]
    before, after = vtp.File(one).points, vtp.File(two).points
    centre = [sum(p[k] for p in after) / len(after) for k in range(3)]
    half = 0.15 * RADIUS * 1e-6
    marks = []
    for p, q in zip(before, after):
        if abs(q[1] - centre[1]) > half:
            continue
        a, b = (math.atan2(x[0] - centre[0], x[2] - centre[2]) for x in (p, q))  # with the flow
        way = (b - a + math.pi) % (2 * math.pi) - math.pi
        marks.append(((a + way / 2) % (2 * math.pi), (t2 - t1) * ratio / way))
    marks.sort()
    marks.append((marks[0][0] + 2 * math.pi, marks[0][1]))
    return sum(0.5 * (s + r) * (b - a) for (a, s), (b, r) in zip(marks, marks[1:]))


def otherMesh(path, cell):
    """A step of preparation: replaces the mesh made by membraneMesh with the surface of an OFF file, lengths in radii, axis along its y."""
    def replace(folder):
        words = re.sub(r"#.*", "", path.read_text()).split()[1:]
        count, triangles = int(words[0]), int(words[1])
        numbers = list(map(float, words[3 : 3 + 3 * count]))
        scale = RADIUS * 1e-6
        points = [(scale * x, -scale * z, scale * y) for x, y, z in zip(*(numbers[k::3] for k in range(3)))]  # the gradient is along y there, along z here
        corners = list(map(int, words[3 + 3 * count :]))
        file = folder / "0" / f"{cell}.vtp"
        made = vtp.File(file)
        vtp.write(file, points, [tuple(corners[4 * k + 1 : 4 * k + 4]) for k in range(triangles)], list(range(count)),
                  made.arrays["spacing"][0], made.texts)

    replace.__name__ = f"otherMesh {path.name}"
    replace.reads = (path,)
    return replace
