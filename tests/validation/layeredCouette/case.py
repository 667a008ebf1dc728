"""Start-up of Couette flow of two layers of fluid, viscosities 1 to 5, against the exact solution (layers.py)."""
import layers
from layers import couette, couette_stress, deviation, profiles
from suite import HERE, Figure, relative, rows

TITLE = "layered Couette flow, viscosities 1 to 5"
ACROSS = "particles across the gap"
RESOLUTIONS = (16, 32, 64)
ALLOWED = {16: 1.8, 32: 0.7, 64: 0.3}  # %; 0.3 % at 64 is the aim
U = 6.25e-6  # constant/flow.yaml
TIMES = (0.0225, 0.045, 0.1125, 0.45)


def runs(n):
    return layers.runs(HERE / "layeredCouette", n, 16e-3 / n)


def figures(done, n):
    allowed, found = ALLOWED.get(n, 1.5 * 16 / n), []
    for scheme in layers.SCHEMES:
        for time, (t, profile) in zip(TIMES, profiles(done[scheme], TIMES)):
            error = deviation(profile, lambda z: couette(z, t, U))
            found.append(Figure(f"{scheme}: L2 of u at t = {time:g} s", 100 * error, allowed, order=True))
        (path,) = done[scheme].glob("postProcessing/wall/*/wallStress.csv")
        stress = rows(path)[-1]["effectiveViscosity"]
        exact = couette_stress(U) / (layers.MU[0] * U / layers.H)
        found.append(relative(f"{scheme}: stress on the walls at the end, over mu_1 2U/L", stress, exact, allowed, order=True))
    return found


def curves(done):
    return layers.curves(done, TIMES, lambda z, t: couette(z, t, U), U, "u/U", "left top")
