"""A sheared cubic lattice of free rigid spheres, one in each cell: relative viscosity and spin over the strain, against Stokes flow.

The viscosity follows from the work of the sliding images (budget.csv) over each step.
"""
import math
import pathlib
import statistics

from suite import PROGRAMS, Figure, Plot, Run, fromOn, rows, worst
from summary import series

HERE = pathlib.Path(__file__).resolve().parent
TITLE = "lattice of free rigid spheres in shear flow"
ACROSS = "particles along a cell"
RESOLUTIONS = (16, 24, 32, 48)
FRACTIONS = {16: (0.05, 0.1), 32: (0.05, 0.1, 0.3)}  # a sphere must not reach its own image within two supports
ALLOWED = (1, 0.01)  # % of the viscosity; of the spin over gammadot
FROM = 1.5  # strain; before, the initial lattice of particles is sheared and becomes disordered
L, MU, RATE = 10e-6, 1e-3, 100.0  # m, Pa s, 1/s: of system/mesh.yaml and constant
EDGES = 16  # of the mesh along the radius

reference = {c: [row for row in rows(HERE / "reference.csv") if row["phi"] == c] for c in FRACTIONS[32]}


def name(c):
    return f"phi{c:g}"


def runs(n):
    found = []
    for c in fromOn(FRACTIONS, n):
        a = (3 * c / (4 * math.pi)) ** (1 / 3) * L * 1e6
        found.append(Run(name(c), HERE, [
            f"system/numerics.yaml:/spacing={1e6 * L / n:.10g} um",
            f"system/mesh.yaml:/bodies/0/shape/radius={a:.8g} um",
            f"system/mesh.yaml:/bodies/0/edge={a / EDGES:.6g} um"], PROGRAMS))
    return found


def theirs(c, key, strain):
    """Reference value at a strain. It is even and of period 1 in the strain: the sum of cosines through the rows, at 0, 1/8, ..., 1/2."""
    values = [row[key] for row in reference[c]]
    N = len(values) - 1
    ends = [0.5 if k in (0, N) else 1 for k in range(N + 1)]
    waves = [2 / N * sum(ends[j] * values[j] * math.cos(math.pi * j * k / N) for j in range(N + 1)) for k in range(N + 1)]
    return sum(ends[k] * waves[k] * math.cos(2 * math.pi * k * strain) for k in range(N + 1))


def viscosities(folder):
    """(strain, relative viscosity) of the middle of each step."""
    table = series(folder, "balance", "budget.csv")
    return [(0.5 * (a["strain"] + b["strain"]), (b["workOfImages_J"] - a["workOfImages_J"]) / (b["time_s"] - a["time_s"]) / (MU * RATE**2 * L**3))
            for a, b in zip(table, table[1:]) if b["time_s"] > a["time_s"] * (1 + 1e-9)]


def spins(folder):
    return [(row["strain"], row["angularVelocity_y_1_s"] / RATE) for row in series(folder, "motion", "sphere.csv")]


def figures(done, n):
    ofViscosity, ofSpin = ALLOWED
    found = []
    for c in fromOn(FRACTIONS, n):
        mu = [(s, value) for s, value in viscosities(done[name(c)]) if s > FROM]
        error = lambda s, value: 100 * (value / theirs(c, "mu_r", s) - 1)
        mean = statistics.mean(error(s, value) for s, value in mu)
        found.append(Figure(f"phi {c:g}: relative viscosity, mean over a period", mean, ofViscosity))
        found.append(Figure(f"phi {c:g}: relative viscosity, worst", worst(error(s, value) for s, value in mu), ofViscosity))
        found.append(Figure(f"phi {c:g}: spin, worst", worst(value + theirs(c, "omega_over_gd", s) for s, value in spins(done[name(c)]) if s > FROM), ofSpin, ""))
        moved = [row for row in series(done[name(c)], "motion", "sphere.csv")]
        found.append(Figure(f"phi {c:g}: way of the sphere from its place, over its radius", worst(
            math.dist([row[f"centre_{k}_m"] for k in "xyz"], [moved[0][f"centre_{k}_m"] for k in "xyz"]) for row in moved) / ((3 * c / (4 * math.pi)) ** (1 / 3) * L), 0.02, ""))
    return found


def curves(done):
    ours, exact = [], []
    for c in FRACTIONS[32]:
        if name(c) not in done:
            continue
        mu = viscosities(done[name(c)])
        ours.append((f"phi {c:g}", [s for s, _ in mu], [value for _, value in mu]))
        strains = [0.02 * k for k in range(126)]
        exact.append(("", strains, [theirs(c, "mu_r", s) for s in strains]))
    return Plot("strain", "relative viscosity", ours, exact, ["set key top right", "set yrange [1:2.4]"])
