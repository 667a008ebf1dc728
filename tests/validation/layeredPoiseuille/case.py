"""Start-up of Poiseuille flow of two layers of fluid, viscosities 1 to 5, against the exact solution (layers.py)."""
import layers

TITLE = "layered Poiseuille flow, viscosities 1 to 5"
ACROSS = "particles across the gap"
RESOLUTIONS = (16, 32, 64)
ALLOWED = {16: 1.8, 32: 0.7, 64: 0.3}  # %; 0.3 % at 64 is the aim
F = 1e-4  # constant/flow.yaml

flow = layers.Layers("layeredPoiseuille", lambda z, t: layers.poiseuille(z, t, F), (0.05, 0.1, 0.2, 0.5), 32e-3, ALLOWED)
runs, figures = flow.runs, flow.figures


def curves(done):
    return flow.curves(done, F * (2 * layers.H) ** 2 / (8 * layers.MU[0] / layers.DENSITY), "u/(F L^2/8 nu_1)", "left center")
