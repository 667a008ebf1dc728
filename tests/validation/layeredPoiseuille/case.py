"""Start-up of Poiseuille flow of two layers of fluid, viscosities 1 to 5, against the exact solution (layers.py)."""
import layers
from layers import deviation, poiseuille, profiles
from suite import HERE, Figure

TITLE = "layered Poiseuille flow, viscosities 1 to 5"
ACROSS = "particles across the gap"
RESOLUTIONS = (16, 32, 64)
ALLOWED = {16: 1.8, 32: 0.7, 64: 0.3}  # %; 0.3 % at 64 is the aim
F = 1e-4  # constant/flow.yaml
TIMES = (0.05, 0.1, 0.2, 0.5)


def runs(n):
    return layers.runs(HERE / "layeredPoiseuille", n, 32e-3 / n)


def figures(done, n):
    allowed = ALLOWED.get(n, 1.5 * 16 / n)
    return [Figure(f"{scheme}: L2 of u at t = {time:g} s", 100 * deviation(profile, lambda z: poiseuille(z, t, F)), allowed, order=True)
            for scheme in layers.SCHEMES for time, (t, profile) in zip(TIMES, profiles(done[scheme], TIMES))]


def curves(done):
    scale = F * (2 * layers.H) ** 2 / (8 * layers.MU[0] / layers.DENSITY)
    return layers.curves(done, TIMES, lambda z, t: poiseuille(z, t, F), scale, "u/(F L^2/8 nu_1)", "left center")
