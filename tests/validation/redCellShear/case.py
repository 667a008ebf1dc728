"""A red cell in shear flow, its membrane a network of springs, against boundary elements on the same network in unbounded flow."""
import pathlib

import redCells
from membranes import otherMesh

HERE = pathlib.Path(__file__).resolve().parent
TITLE = "red cell in shear flow, springs"
ACROSS = "particles along the radius"
RESOLUTIONS = (6, 8, 12)
ENDS = {6: {"3": 6}, 8: {"0.002": 11, "0.02": 11, "3": 6}, 12: {"0.002": 11, "0.02": 11, "3": 6}}  # strain, by Ca
BOX = {"0.002": (6, 6, 6), "0.02": (6, 6, 6), "3": (8, 6, 8)}  # radii, along the flow, the vorticity and the gradient
ALLOWED = {  # D12, degrees, % of turns, points of area
    6: {"3": (0.04, 3, 0, 8)},
    8: {"0.002": (0.005, 2, 3, 0.5), "0.02": (0.02, 2, 3, 1), "3": (0.03, 2, 0, 7)},
    12: {"0.002": (0.005, 2, 1, 0.5), "0.02": (0.02, 2, 2, 1), "3": (0.02, 2, 0, 4)}}
MESH = HERE / "mesh642.off"  # of the reference at Ca 0.002 and 0.02; at Ca 3 it had the same with edges halved


def runs(n):
    return [redCells.run(Ca, n, BOX[Ca], strain, programs=("membraneMesh", otherMesh(MESH, "rbc"), "particleFill", "dmpFlow"))
            for Ca, strain in ENDS.get(n, ENDS[12]).items()]


def figures(done, n):
    return redCells.figures(HERE, done, ALLOWED.get(n, ALLOWED[12]))


def curves(done):
    return redCells.curves(HERE, done)
