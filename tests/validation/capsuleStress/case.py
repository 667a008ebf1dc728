"""Stress of a dilute suspension of capsules in a shear flow without walls, against boundary elements."""
import math
import pathlib
import statistics

from membranes import Course, settings
from suite import PROGRAMS, Figure, Plot, Run, fromOn, published, relative
from summary import series

HERE = pathlib.Path(__file__).resolve().parent
TITLE = "stress of a dilute suspension of capsules"
ACROSS = "particles along the radius"
RESOLUTIONS = (4, 6, 8, 12)
UNBOUNDED = True
BOX = {4: (6, 6, 6), 6: (10, 10, 10)}  # radii: volume fractions of 1.9 and 0.42 %
STRAIN, STEADY = 7, 5  # a period of the sliding images at the end
LAWS = {"skalak": "{type: skalak, Gs: 1e-5 N/m, C: 1}", "neoHookean": "{type: neoHookean, Gs: 1e-5 N/m}"}
CAPSULES = (("skalak", 0.3), ("skalak", 0.6), ("neoHookean", 0.3))
ALLOWED = {4: (8, 12, 0.15), 6: (4, 5, 0.1), 8: (3, 4, 0.07), 12: (2, 3, 0.05)}  # % of viscosity and N1; N2
VISCOSITY, RADIUS = 1e-3, 4e-6


def label(law, Ca):
    return f"{law}{Ca:g}"


def runs(n):
    few = CAPSULES if n > RESOLUTIONS[0] else CAPSULES[:1]
    return [Run(label(law, Ca), HERE, settings(n, fromOn(BOX, n), STRAIN, [f"constant/flow.yaml:/Ca={Ca}", f"constant/membranes.yaml:/capsule/triangles={LAWS[law]}"]),
                PROGRAMS) for law, Ca in few]


def courses(done):
    """(law, Ca, rows of the stress) of runs that have ended."""
    return [(law, Ca, series(done[label(law, Ca)], "stress", "suspension.csv")) for law, Ca in CAPSULES if label(law, Ca) in done]


def expected(law, Ca):
    (row,) = published(HERE / "reference.csv", nodes=0, Ca=Ca)[law]
    return row


def intrinsic(row, key):
    """Intrinsic value of a stress [Pa]: over mu gammadot phi."""
    return row[key] / (VISCOSITY * row["strain"] / row["time_s"] * row["haematocrit"])


def mean(table, key):
    return statistics.mean(intrinsic(row, key) for row in table if row["strain"] > STEADY)


def byImages(folder, n):
    """Relative viscosity from the work of the sliding images."""
    first, *_, last = [row for row in series(folder, "balance", "budget.csv") if row["strain"] > STEADY - 1e-9]
    rate = last["strain"] / last["time_s"]
    volume = math.prod(fromOn(BOX, n)) * RADIUS**3
    return (last["workOfImages_J"] - first["workOfImages_J"]) / (last["time_s"] - first["time_s"]) / (VISCOSITY * rate**2 * volume)


def figures(done, n):
    viscosity, first, second = fromOn(ALLOWED, n)
    found = []
    for law, Ca, table in courses(done):
        theirs, name = expected(law, Ca), f"{law}, Ca {Ca:g}"
        found.append(relative(f"{name}: intrinsic viscosity", mean(table, "shearStress_membranes_Pa"), theirs["viscosity"], viscosity))
        byCells = statistics.mean(row["relativeViscosity"] for row in table if row["strain"] > STEADY)
        found.append(relative(f"{name}: relative viscosity by the work of images, against that by cells", byImages(done[label(law, Ca)], n), byCells, 1))
        found.append(relative(f"{name}: N1", mean(table, "N1_Pa"), theirs["N1"], first))
        N2 = mean(table, "N2_Pa")
        found.append(Figure(f"{name}: N2", N2 - theirs["N2"], second, "", N2, theirs["N2"]))
        found += Course(done[label(law, Ca)]).kept(name)
    return found


def curves(done):
    ours, theirs = [], []
    for law, Ca, table in courses(done):
        strains = [row["strain"] for row in table if row["strain"] > 0]
        for key, what in (("shearStress_membranes_Pa", "viscosity"), ("N1_Pa", "N1")):
            ours.append((f"{law} {Ca:g}: {what}", strains, [intrinsic(row, key) for row in table if row["strain"] > 0]))
            theirs.append(("", [STEADY, STRAIN], 2 * [expected(law, Ca)[what]]))
    return Plot("strain", "stress/(mu gammadot phi)", ours, theirs, ["set key bottom right"])
