"""Start-up of plane Poiseuille flow against its series."""
from plates import Plates

TITLE = "start-up of Poiseuille flow"
ACROSS = "particles across the gap"
RESOLUTIONS = (16, 32, 64)

plates = Plates("poiseuille", {16: 1.0, 32: 0.3, 64: 0.1}, lambda flow: flow.F * flow.L**2 / (8 * flow.NU))  # 0.1 % at 64 is the aim
runs, figures = plates.runs, plates.figures


def curves(done):
    return plates.curves(done, "u/(F L^2/8 nu)")
