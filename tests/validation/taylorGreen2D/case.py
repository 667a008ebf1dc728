"""Decay of Taylor-Green vortices in the plane against the exact one: the case and the definitions of tutorials/taylorGreen."""
from decay import Decay, tutorial
from suite import TUTORIALS

TITLE = "Taylor-Green vortices, plane"
ACROSS = "particles in a wavelength"
RESOLUTIONS = (16, 32, 64)
ALLOWED = {16: 1.5, 32: 0.4, 64: 0.15}  # % of E(0); the aim is 0.5 % at 64

flow = Decay(TUTORIALS / "taylorGreen", tutorial.RATE, "4 nu k^2 t", ALLOWED, 2,
             settings=lambda n: [f"system/mesh.yaml:/domain/size=[1 mm, {8 / n} mm, 1 mm]"])  # a slice of 8 dx
runs, figures, curves = flow.runs, flow.figures, flow.curves
