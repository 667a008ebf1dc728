"""A red cell in shear flow, its membrane of Skalak's law, C = 10, against boundary elements in unbounded flow."""
from redCells import DRAWN, TUMBLING, RedCells

TITLE = "red cell in shear flow, Skalak C = 10"
ACROSS = "particles along the radius"
RESOLUTIONS = (6, 8, 12)
MISSED = {8: ("Ca 0.2: D12 by inertia *",)}
ALLOWED = {  # D12, degrees, % of turns, points of area
    6: {"3": (0.02, 2, 0, 2)},
    8: {"0.2": (0.02, 2, 3, 1), "3": (0.02, 2, 0, 1)},
    12: {"0.2": (0.02, 2, 2, 1), "3": (0.02, 2, 0, 1)}}

cells = RedCells("redCellSkalak", {"0.2": (24.5, TUMBLING), "3": (6, DRAWN)}, ALLOWED, [
    "constant/membranes.yaml:/rbc/bonds=none", "constant/membranes.yaml:/rbc/triangles={type: skalak, Gs: 2e-4 N/m, C: 10}"])
runs, figures, curves = cells.runs, cells.figures, cells.curves
