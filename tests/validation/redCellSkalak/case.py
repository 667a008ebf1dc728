"""A red cell in shear flow, its membrane of Skalak's law, C = 10, against boundary elements in unbounded flow."""
import pathlib

import redCells

HERE = pathlib.Path(__file__).resolve().parent
TITLE = "red cell in shear flow, Skalak C = 10"
ACROSS = "particles along the radius"
RESOLUTIONS = (6, 8, 12)
ENDS = {6: {"3": 6}, 8: {"0.2": 13, "3": 6}, 12: {"0.2": 13, "3": 6}}  # strain, by Ca
BOX = {"0.2": (6, 6, 6), "3": (8, 6, 8)}  # radii, along the flow, the vorticity and the gradient
EDGE = 0.5  # of the mesh, in spacings
ALLOWED = {  # D12, degrees, % of turns, points of area
    6: {"3": (0.02, 2, 0, 2)},
    8: {"0.2": (0.02, 2, 3, 1), "3": (0.02, 2, 0, 1)},
    12: {"0.2": (0.02, 2, 2, 1), "3": (0.02, 2, 0, 1)}}


def runs(n):
    return [redCells.run(Ca, n, BOX[Ca], strain, [
        "constant/membranes.yaml:/rbc/bonds=none", "constant/membranes.yaml:/rbc/triangles={type: skalak, Gs: 2e-4 N/m, C: 10}"], edge=EDGE)
        for Ca, strain in ENDS.get(n, ENDS[12]).items()]


def figures(done, n):
    return redCells.figures(HERE, done, ALLOWED.get(n, ALLOWED[12]))


def curves(done):
    return redCells.curves(HERE, done)
