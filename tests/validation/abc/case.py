"""Decay of the Arnold-Beltrami-Childress flow on moving particles against the exact one: kinetic energy."""
import math

from decay import Decay
from suite import HERE

TITLE = "ABC flow"
ACROSS = "particles in a wavelength"
RESOLUTIONS = (16, 32, 64)
NU, L = 1.0e-6, 1.0e-3  # constant/fluid.yaml, system/mesh.yaml
ALLOWED = {16: 0.8, 32: 0.3, 64: 0.15}  # % of E(0); the aim is 0.5 % at 64

flow = Decay(HERE / "abc", 2 * NU * (2 * math.pi / L) ** 2, "2 nu k^2 t", ALLOWED, 1, viscosity=2)
runs, figures, curves = flow.runs, flow.figures, flow.curves
