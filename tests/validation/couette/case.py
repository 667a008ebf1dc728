"""Start-up of plane Couette flow against its series."""
from plates import Plates

TITLE = "start-up of Couette flow"
ACROSS = "particles across the gap"
RESOLUTIONS = (16, 32, 64)

plates = Plates("couette", {16: 1.5, 32: 0.4, 64: 0.1}, lambda flow: flow.U)  # 0.1 % at 64 is the aim
runs, figures = plates.runs, plates.figures


def curves(done):
    return plates.curves(done, "u/U")
