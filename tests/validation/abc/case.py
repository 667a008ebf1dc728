"""Decay of the Arnold-Beltrami-Childress flow on moving particles against the exact one: kinetic energy."""
import math

from suite import HERE, Figure, Plot, Run, rows

TITLE = "ABC flow"
ACROSS = "particles in a wavelength"
RESOLUTIONS = (16, 32, 64)
ALLOWED = {16: 0.8, 32: 0.3, 64: 0.5}  # % of E(0); 0.5 % at 64 is the aim
NU, L = 1.0e-6, 1.0e-3  # constant/fluid.yaml, system/mesh.yaml
RATE = 2 * NU * (2 * math.pi / L) ** 2


def runs(n):
    return [Run("flow", HERE / "abc", [f"system/numerics.yaml:/spacing={1000 / n} um"], ("particleFill", "sphFlow"))]


def decay(folder):
    """Times in those in which the energy falls to 1/e, and kinetic energies over the first."""
    (path,) = folder.glob("postProcessing/balance/*/conservation.csv")
    table = rows(path)
    return [(row["time_s"] * RATE, row["kineticEnergy_J"] / table[0]["kineticEnergy_J"]) for row in table]


def viscosity(points):
    """That this decay to 1/e stands for, over the nominal one."""
    for (t0, e0), (t1, e1) in zip(points, points[1:]):
        if e1 <= math.exp(-1):
            return 1 / (t0 + (t1 - t0) * (math.log(e0) + 1) / math.log(e0 / e1))
    return math.nan


def figures(done, n):
    points, allowed = decay(done["flow"]), ALLOWED.get(n, 0.8 * 16 / n)
    worst = max((e - math.exp(-t) for t, e in points if t <= 1), key=abs)
    felt = viscosity(points)
    return [Figure("E/E(0) until 1/e, largest error", 100 * worst, allowed, order=True),
            Figure("viscosity felt, from the time of 1/e", 100 * (felt - 1), 2 * allowed, "%", felt, 1, order=True)]


def curves(done):
    points = decay(done["flow"])
    times = [t for t, _ in points]
    return Plot("2 nu k^2 t", "E/E(0)", [("particles", times[::2], [e for _, e in points][::2])],
                [("exact", times, [math.exp(-t) for t in times])], ["set logscale y"])
