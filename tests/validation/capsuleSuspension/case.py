"""A suspension of capsules in a shear flow without walls: viscosity over the volume fraction."""
import math
import pathlib
import statistics

from membranes import settings
from restingShapes.axisymmetric import solve
from suite import Figure, Plot, Run, relative, worst
from summary import series

HERE = pathlib.Path(__file__).resolve().parent
TITLE = "suspension of capsules, volume fractions to 0.4"
ACROSS = "particles along the radius"
RESOLUTIONS = (3, 4, 6)  # 3: a short run of the densest, to see that nothing is lost
CAPSULES = {0.05: (33, 14), 0.1: (32, 11), 0.2: (35, 9), 0.3: (37, 8), 0.4: (33, 7)}  # their number, and the edge of the box in radii
STRAIN, STEADY, SHORT = 20, 5, 3
DILUTE = 1.90  # intrinsic viscosity: ../capsuleStress
COARSE = 4
CUBIC, PAIR, TWO, CONTACT = 10, 5, 3, 2  # %: of mu_r - 1 at phi 0.4; of the dilute limit; between two resolutions; of the stress
MISSED = {4: {"part of third order *": 30}, 6: {"part of third order *": 27, "phi 0.4: mu_r against *": 3.3}}


def label(fraction):
    return f"phi{fraction:g}"


def fractions(n):
    return tuple(CAPSULES)[-1:] if n == RESOLUTIONS[0] else tuple(CAPSULES)


def runs(n):
    strain = SHORT if n == RESOLUTIONS[0] else STRAIN
    return [Run(label(fraction), HERE, settings(n, 3 * (CAPSULES[fraction][1],), strain, [f"system/pack.yaml:/cells/0/number={CAPSULES[fraction][0]}"]),
                ("cellPack", "membraneMesh", "particleFill", "dmpFlow")) for fraction in fractions(n)]


def table(folder):
    return series(folder, "stress", "suspension.csv")


def viscosity(folder):
    """Volume fraction; relative viscosity minus 1, and the share of contact in it: means from STEADY on."""
    steady = [row for row in table(folder) if row["strain"] > STEADY]
    mean = lambda key: statistics.mean(row[key] for row in steady)
    of = mean("shearStress_membranes_Pa") + mean("shearStress_interiors_Pa") + mean("shearStress_contact_Pa")
    return mean("haematocrit"), mean("relativeViscosity") - 1, mean("shearStress_contact_Pa") / of


def polynomial(points, degree):
    """Least squares of (mu_r - 1)/phi = sum_k c_k phi^k over (phi, mu_r - 1)."""
    powers = range(degree + 1)
    return solve([[sum(phi ** (i + j) for phi, _ in points) for j in powers] for i in powers], [sum(value / phi * phi**i for phi, value in points) for i in powers])


def figures(done, n):
    found = [] if n == RESOLUTIONS[0] else ofViscosity(done, n)
    for fraction in fractions(n):
        balance, name = series(done[label(fraction)], "balance", "conservation.csv"), f"phi {fraction:g}"
        found.append(Figure(f"{name}: volume of a cell, at most", 100 * worst(row["volumeChange"] for row in balance), 1e-4))
        found.append(Figure(f"{name}: particles that changed side, at most", worst(row["changedSide"] for row in balance), 0, ""))
    return found


def ofViscosity(done, n):
    points = {fraction: viscosity(done[label(fraction)]) for fraction in CAPSULES}
    straight, curved = (polynomial([point[:2] for point in points.values()], degree) for degree in (1, 2))
    phi, most, _ = points[0.4]
    found = [Figure("part of third order in mu_r - 1 at phi 0.4", 100 * curved[2] * phi**3 / most, CUBIC),
             relative("(mu_r - 1)/phi at phi 0, by a straight line", straight[0], DILUTE, PAIR),
             Figure("share of contact in the stress, largest", 100 * worst(abs(point[2]) for point in points.values()), CONTACT)]
    if n > COARSE:
        for fraction, (_, value, _) in points.items():
            coarse = done[label(fraction)].parent.parent / str(COARSE) / label(fraction)
            other = viscosity(coarse)[1] if coarse.exists() else math.nan
            found.append(relative(f"phi {fraction:g}: mu_r against that of {COARSE} {ACROSS}", 1 + value, 1 + other, TWO, earlier=True))
    return found


def curves(done):
    points = [viscosity(folder)[:2] for folder in done.values() if table(folder)[-1]["strain"] > STEADY]
    phis = [0.01 * k for k in range(1, 42)]
    lines = [("dilute limit", phis, [1 + DILUTE * phi for phi in phis])]
    if len(points) == len(CAPSULES):
        first, second = polynomial(points, 1)
        lines.append(("quadratic fit", phis, [1 + first * phi + second * phi**2 for phi in phis]))
    return Plot("phi", "mu_r", [("suspension", [phi for phi, _ in points], [1 + value for _, value in points])], lines, ["set key top left"])
