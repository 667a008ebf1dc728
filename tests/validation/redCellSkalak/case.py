"""A red cell in shear flow, its membrane of Skalak's law, C = 10, against boundary elements in unbounded flow."""
from redCells import DRAWN, TUMBLING, RedCells

TITLE = "red cell in shear flow, Skalak C = 10"
ACROSS = "particles along the radius"
RESOLUTIONS = (5, 6, 8, 12)
UNBOUNDED = True
MISSED = {8: {"Ca 0.2: D12 by inertia *": 0.06, "Ca 0.2: inclination *": 2.9}}
ALLOWED = {  # D12, degrees, % of turns, points of area
    5: {"3": (0.03, 2, 0, 0.5)},
    6: {"0.2": (0.16, 11, 10, 0.4), "3": (0.02, 2, 0, 0.5)},
    8: {"0.2": (0.02, 2, 3, 1), "3": (0.02, 2, 0, 1)},
    12: {"0.2": (0.02, 2, 2, 1), "3": (0.02, 2, 0, 1)}}
RECORDED = {5: {"3": (0.6887, 14.05)}}  # D12, degrees, at strain 15: programs of 2026-11-26, which are not the reference

cells = RedCells("redCellSkalak", {"0.2": (25.5, TUMBLING), "3": (15, DRAWN)}, ALLOWED, [
    "constant/membranes.yaml:/rbc/bonds=none", "constant/membranes.yaml:/rbc/triangles={type: skalak, Gs: 2e-4 N/m, C: 10}"], recorded=RECORDED)
runs, figures, curves = cells.runs, cells.figures, cells.curves
