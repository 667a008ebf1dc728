"""A red cell whose inside is more or less viscous than the fluid around it, in shear flow, against boundary elements with both fluids."""
from membranes import otherMesh
from redCells import RedCells
from suite import HERE

TITLE = "red cell in shear flow, another viscosity inside"
ACROSS = "particles along the radius"
RESOLUTIONS = (6, 8, 12)
UNBOUNDED = True
AIM = (0.02, 2, 2, 1)  # D12, degrees, % of turns, points of area
ALLOWED = {6: {"0.2": (0.1, 10, 6, 1.5), "5": (0.04, 2, 3, 1)}, 8: {"0.2": (0.04, 3, 4, 1), "5": (0.03, 2, 2.5, 1)}, 12: {"0.2": AIM, "5": AIM}}
MISSED = {8: {"ratio 0.2: D12 *": 0.09, "ratio 0.2: strain of *": 5.2, "ratio 0.2: inclination *": 7.8, "ratio 0.2: change of area *": 1.3,
              "ratio 5: D12 *": 0.031},
          12: {"ratio 0.2: D12 *": 0.05, "ratio 0.2: strain of *": 2.5, "ratio 0.2: inclination *": 4.2}}
BOX = {6: (8, 6, 8)}
MESH = HERE / "redCellShear" / "mesh642.off"  # of the reference

cells = RedCells("redCellViscosity", {"0.2": (8, BOX), "5": (8, BOX)}, ALLOWED, ["constant/flow.yaml:/Ca=0.2"],
                 programs=("membraneMesh", otherMesh(MESH, "rbc"), "particleFill", "dmpFlow"),
                 varied=("ratio", "constant/membranes.yaml:/rbc/interior/viscosityRatio"))
runs, figures, curves = cells.runs, cells.figures, cells.curves
