"""Start-up of plane Poiseuille flow against its series."""
from plates import Plates

TITLE = "start-up of Poiseuille flow"
ACROSS = "particles across the gap"
RESOLUTIONS = (16, 32, 64)
ALLOWED = {16: 1.0, 32: 0.3, 64: 0.1}  # %; 0.1 % at 64 is the aim

plates = Plates("poiseuille", ALLOWED, lambda flow: flow.F * flow.L**2 / (8 * flow.NU), "u/(F L^2/8 nu)")
runs, figures, curves = plates.runs, plates.figures, plates.curves
