"""Decay of Taylor-Green vortices in three dimensions against a spectral simulation: kinetic energy."""
import math

from decay import decay
from suite import HERE, Figure, Plot, Run, permitted, rows

TITLE = "Taylor-Green vortices, three dimensions"
ACROSS = "particles in a wavelength"
RESOLUTIONS = (16, 32, 64)
ALLOWED = {16: 2, 32: 0.6, 64: 0.25}  # % of E(0); the aim is 0.5 % at 64
NU, L = 1.0e-6, 1.0e-3  # constant/fluid.yaml, system/mesh.yaml
K = 2 * math.pi / L
REYNOLDS = (1, 10)
STEP = 0.0025  # in units of 1/(nu k^2), the same at each Re

reference = rows(HERE / "taylorGreen3D" / "dns.csv")


def runs(n):
    return [Run(f"Re{Re}", HERE / "taylorGreen3D", [
        f"system/numerics.yaml:/spacing={1000 / n} um", f"constant/flow.yaml:/speed={Re * NU * K:.16g} m/s",
        f"system/numerics.yaml:/implicit/step={STEP * Re}"], ("particleFill", "sphFlow"))
        for Re in REYNOLDS]


def energies(done, Re):
    """Times in 1/(k U), U = Re nu k, and kinetic energies over the first."""
    return decay(done[f"Re{Re}"], K * K * NU * Re)


def between(points, time):
    """The energy at that time, with its logarithm interpolated linearly."""
    for (t0, e0), (t1, e1) in zip(points, points[1:]):
        if t0 <= time <= t1:
            return e0 * (e1 / e0) ** ((time - t0) / (t1 - t0))
    return math.nan


def figures(done, n):
    allowed, found = permitted(ALLOWED, n, 1), []
    for Re in REYNOLDS:
        points = energies(done, Re)
        for row in reference:
            if row["Re"] == Re and row["time"] > 0:
                energy, exact = between(points, row["time"]), row["energy"] / 0.125
                found.append(Figure(f"Re {Re}, E/E(0) at k U t = {row['time']:g}", 100 * (energy - exact), allowed, "%", energy, exact,
                                    order=True))
    return found


def curves(done):
    """The decay, and its error at all resolutions that have been run."""
    work, ours, theirs, off = next(iter(done.values())).parent.parent, [], [], []
    for Re in REYNOLDS:
        points = energies(done, Re)[::4]
        table = [row for row in reference if row["Re"] == Re]
        ours.append((f"particles, Re = {Re}", [t / Re for t, _ in points], [e for _, e in points]))
        theirs.append((f"spectral, Re = {Re}", [row["time"] / Re for row in table], [row["energy"] / 0.125 for row in table]))
        for n in (n for n in RESOLUTIONS if (work / f"{n}/Re{Re}/run.json").exists()):
            points = energies({f"Re{Re}": work / f"{n}/Re{Re}"}, Re)
            off.append((f"Re = {Re}, {n} in a wavelength", [row["time"] / Re for row in table],
                        [100 * (between(points, row["time"]) - row["energy"] / 0.125) for row in table]))
    errors = Plot("nu k^2 t", "error of E, per cent of E(0)", off, [("spectral", [0, 0.3], [0, 0])], ["set key outside"])
    return [Plot("nu k^2 t", "E/E(0)", ours, theirs, ["set logscale y"]), errors]
