"""Force on a sphere that moves near a plane wall, towards it and along it (wallDrag.csv).

The box is periodic along the wall and has a second wall; the effect of both is computed (wallBox.py) and added to the mobility near one wall.
"""
import math

from suite import HERE, PROGRAMS, Plot, Run, module, permitted, relative, rows

FOLDER = HERE / "sphereNearWall"
TITLE = "sphere near a wall"
ACROSS = "particles along the diameter"
RESOLUTIONS = (8, 12, 16)
WAYS, DISTANCES = ("towards", "along"), (1.5, 2, 3)  # h/a
COARSEST = 8  # runs two of them
ALLOWED = {8: (6, 3.5), 12: (5, 3), 16: (4, 2)}  # %: at h = 1.5 a, where the gap is half a radius; elsewhere. At the finest the aim

A, NU, MU, U, FORCE = 1e-4, 1e-6, 1e-3, 1e-7, 1.25e-5  # SI, as in constant: Re = U a/nu = 1e-5
WIDE, HIGH = 12, 10  # of the box along the walls and across, in a
STEP, STEPS = 0.2, 5  # s, 20 a^2/nu; flow across the box decays in 10 a^2/nu, so by a factor of 3 in each

box = module(FOLDER / "wallBox.py", "wallBox")
reference = rows(FOLDER / "wallDrag.csv")


def runs(n):
    return [run(way, x, n) for way in WAYS for x in distances(n)]


def distances(n):
    return DISTANCES if n > COARSEST else DISTANCES[1:]


def run(way, x, n):
    velocity = f"[0 m/s, 0 m/s, {U} m/s]" if way == "towards" else f"[0 m/s, {U} m/s, 0 m/s]"
    side = 1e6 * A * WIDE
    return Run(f"{way}{x:g}", FOLDER, [
        f"system/numerics.yaml:/spacing={2e6 * A / n:.10g} um",
        f"system/numerics.yaml:/implicit/step={STEP * FORCE * HIGH * A / (8 * NU):g}",
        f"system/control.yaml:/endTime={STEP * STEPS:g} s",
        f"system/mesh.yaml:/domain/size=[{side:g} um, {side:g} um, {1e6 * A * HIGH:g} um]",
        f"system/mesh.yaml:/bodies/0/centre=[0 um, 0 um, {1e6 * A * (x - HIGH / 2):g} um]",
        f"constant/bodies.yaml:/sphere/motion/velocity={velocity}"], PROGRAMS)


def expected(way, x):
    """Force in this box over 6 pi mu a U, the force near one wall alone, and the changes of the mobility by images and by the second wall."""
    (alone,) = (row[way] for row in reference if row["h_over_a"] == x)
    changes = box.mobility(x, WIDE, HIGH, way == "towards")
    return 1 / (1 / alone + sum(changes)), alone, changes


def drag(folder, way):
    """Force over 6 pi mu a U at the end."""
    last = rows(folder / "postProcessing/force/sphere.csv")[-1]
    return -last["force_z_N" if way == "towards" else "force_y_N"] / (6 * math.pi * MU * A * U)


def figures(done, n):
    near, other = permitted({m: pair[0] for m, pair in ALLOWED.items()}, n, 1), permitted({m: pair[1] for m, pair in ALLOWED.items()}, n, 1)
    found = []
    for way in WAYS:
        for x in distances(n):
            wanted, _, _ = expected(way, x)
            found.append(relative(f"{way} the wall, h/a = {x:g}", drag(done[f"{way}{x:g}"], way), wanted,
                                  near if x < 2 else other, order=True))
    return found


def curves(done):
    """Our results, corrected for the effect of the box."""
    ours, theirs = [], []
    for way in WAYS:
        found = {x: done[f"{way}{x:g}"] for x in DISTANCES if f"{way}{x:g}" in done}
        values = [1 / (1 / drag(folder, way) - sum(expected(way, x)[2])) for x, folder in found.items()]
        ours.append((f"{way} the wall", list(found), values))
    for key, title in (("towards", "Brenner"), ("along", "fundamental solutions")):
        theirs.append((title, [row["h_over_a"] for row in reference], [row[key] for row in reference]))
    return Plot("h/a", "force/(6 pi mu a U)", ours, theirs, ["set xrange [1.2:4]", "set yrange [0.9:]"])
