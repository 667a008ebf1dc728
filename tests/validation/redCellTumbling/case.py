"""A nearly rigid red cell in shear flow, Ca 0.002, through three tumbles, against boundary elements in unbounded flow."""
from membranes import Sheared
from redCells import STIFF
from suite import TUTORIALS, Figure, outside, relative, worst

TITLE = "red cell in shear flow, Ca 0.002: three tumbles"
ACROSS = "particles along the radius"
RESOLUTIONS = (6, 8, 12)
TUMBLES = {6: 1, 8: 3, 12: 3}
PERIOD = 20.45  # in units of 1/gammadot: of the rigid cell and of this one, by boundary elements
RANGE = (0.565, 0.568)  # of D12 by inertia
ALLOWED = {6: (5, 0.005), 8: (3, 0.005), 12: (1, 0.005)}  # % of the period, D12
cells = {n: Sheared("redCellTumbling", TUTORIALS / "rbcShear" / "Ca0.02", {"0.002": (20.8 * TUMBLES[n] + 1, STIFF)}, "0.002",
                    ["constant/flow.yaml:/inertia/Re=0.01", "system/observers.yaml:/deformation/every=0.1 strain"], edge=1.25)
         for n in RESOLUTIONS}


def runs(n):
    return cells[n].runs(n)


def figures(done, n):
    ((_, course),) = cells[n].courses(done)
    allowed, within = ALLOWED[n]
    turns = [0, *(course.turn(360 * k) for k in range(1, TUMBLES[n] + 1))]
    found = [relative(f"tumble {k}: period", b - a, PERIOD, allowed) for k, (a, b) in enumerate(zip(turns, turns[1:]), 1)]
    beyond = worst(outside(row["D12_inertia"], *RANGE, percent=False) for row in course.shape)
    area = worst(row[f"{course.cell}_areaChange"] for row in course.balance)
    return [*found, Figure(f"D12 by inertia throughout, outside {RANGE[0]} to {RANGE[1]}", beyond, within, ""),
            Figure("change of area, at most", 100 * area, 0.5, "%"), *course.kept("throughout")]


def curves(done):
    return cells[max(RESOLUTIONS)].drawn(done, "D12 by inertia", 0.5, ["set yrange [0.55:0.58]", "set key right top"])
