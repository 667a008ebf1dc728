"""Start-up of Couette flow of two layers of fluid, viscosities 1 to 5, against the exact solution (layers.py)."""
import layers
from suite import relative, rows

TITLE = "layered Couette flow, viscosities 1 to 5"
ACROSS = "particles across the gap"
RESOLUTIONS = (16, 32, 64)
ALLOWED = {16: 1.8, 32: 0.7, 64: 0.3}  # %; 0.3 % at 64 is the aim
U = 6.25e-6  # constant/flow.yaml

flow = layers.Layers("layeredCouette", lambda z, t: layers.couette(z, t, U), (0.0225, 0.045, 0.1125, 0.45), 16e-3, ALLOWED)
runs = flow.runs


def stress(done, n, scheme):
    path = done[scheme] / "postProcessing/wall/wallStress.csv"
    mine, exact = rows(path)[-1]["effectiveViscosity"], layers.couette_stress(U) / (layers.MU[0] * U / layers.H)
    return relative(f"{scheme}: stress on the walls at the end, over mu_1 2U/L", mine, exact, flow.permitted(n), order=True)


def figures(done, n):
    return [figure for scheme in layers.SCHEMES for figure in (*flow.deviations(done, n, scheme), stress(done, n, scheme))]


def curves(done):
    return flow.curves(done, U, "u/U", "left top")
