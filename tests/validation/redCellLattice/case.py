"""A red cell in shear flow, its membrane the continuum of the hexagonal lattice of springs, against boundary elements in unbounded flow."""
from redCells import DRAWN, TUMBLING, RedCells

TITLE = "red cell in shear flow, lattice law"
ACROSS = "particles along the radius"
RESOLUTIONS = (5, 6, 8, 12)
UNBOUNDED = True
MISSED = {8: {"Ca 0.02: strain of *": 3.4, "Ca 0.02: inclination *": 2.7, "Ca 0.2: D12 by inertia *": 0.075, "Ca 0.2: inclination *": 2.6,
              "Ca 0.2: change of area *": 1.15}}
ALLOWED = {  # D12, degrees, % of turns, points of area
    5: {"3": (0.06, 2, 0, 10)},
    6: {"0.02": (0.007, 5, 6, 0.2), "0.2": (0.2, 11, 9, 2), "3": (0.05, 2, 0, 10)},
    8: {"0.02": (0.005, 2, 3, 0.2), "0.2": (0.02, 2, 3, 1), "3": (0.03, 2, 0, 6)},
    12: {"0.02": (0.005, 2, 2, 0.2), "0.2": (0.02, 2, 2, 1), "3": (0.02, 2, 0, 3)}}
RECORDED = {5: {"3": (0.7361, 11.22)}}  # D12, degrees, at strain 15: programs of 2026-11-26, which are not the reference

cells = RedCells("redCellLattice", {"0.02": (10.95, TUMBLING), "0.2": (25.5, TUMBLING), "3": (15, DRAWN)}, ALLOWED, [
    "constant/membranes.yaml:/rbc/bonds=none", "constant/membranes.yaml:/rbc/triangles={type: lattice, k: 5e-4 N/m}"], recorded=RECORDED)
runs, figures, curves = cells.runs, cells.figures, cells.curves
