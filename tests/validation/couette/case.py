"""Start-up of plane Couette flow against its series."""
from plates import Plates

TITLE = "start-up of Couette flow"
ACROSS = "particles across the gap"
RESOLUTIONS = (16, 32, 64)
ALLOWED = {16: 1.5, 32: 0.4, 64: 0.1}  # %; 0.1 % at 64 is the aim

plates = Plates("couette", ALLOWED, lambda flow: flow.U, "u/U")
runs, figures, curves = plates.runs, plates.figures, plates.curves
