"""A red cell in shear flow, its membrane the continuum of the hexagonal lattice of springs, against boundary elements in unbounded flow."""
from redCells import DRAWN, TUMBLING, RedCells

TITLE = "red cell in shear flow, lattice law"
ACROSS = "particles along the radius"
RESOLUTIONS = (6, 8, 12)
MISSED = {8: ("Ca 0.2: D12 by inertia *",)}
ALLOWED = {  # D12, degrees, % of turns, points of area
    6: {"3": (0.04, 3, 0, 6)},
    8: {"0.02": (0.02, 2, 3, 1), "0.2": (0.02, 2, 3, 1), "3": (0.02, 2, 0, 4)},
    12: {"0.02": (0.02, 2, 2, 1), "0.2": (0.02, 2, 2, 1), "3": (0.02, 2, 0, 3)}}

cells = RedCells("redCellLattice", {"0.02": (10.9, TUMBLING), "0.2": (24.5, TUMBLING), "3": (6, DRAWN)}, ALLOWED, [
    "constant/membranes.yaml:/rbc/bonds=none", "constant/membranes.yaml:/rbc/triangles={type: lattice, k: 5e-4 N/m}"])
runs, figures, curves = cells.runs, cells.figures, cells.curves
