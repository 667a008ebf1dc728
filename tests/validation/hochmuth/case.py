"""Recovery of a stretched red cell, against Hochmuth, Worthy and Evans 1979 (recovery.csv) and the Kelvin-Voigt sheet.

membraneRelax stretches the cell; this shape starts in fluid at rest, with the undeformed mesh as its stress-free shape.
"""
import math
import shutil

import vtp
from membranes import Course
from suite import HERE, Figure, Plot, Run, outside, permitted, relative, rows, worst

FOLDER = HERE / "hochmuth"
TITLE = "recovery of a stretched red cell"
ACROSS = "particles along the radius"
RESOLUTIONS = (6, 8, 12)
UNBOUNDED = True
RADIUS, BOX, EDGE = 3.91, (6, 4, 3), 1.0  # um; radii; of the mesh, in spacings
ETA, GS = 5e-7, 4e-6  # N s/m, N/m: constant/membranes.yaml
ALLOWED = {6: 5, 8: 5, 12: 5}  # %, of the time of recovery
WORST = 3  # %, of length over width
LEAST = 0.04  # share of the stretch down to which the plot goes
THIN = 8  # resolutions from which on the cell is also run without a viscous interior


def runs(n):
    return [run("interior6", n, 6)] + ([run("interior1", n, 1)] if n >= THIN else [])


def run(name, n, ratio):
    dx = RADIUS / n
    return Run(name, FOLDER, [
        f"system/numerics.yaml:/spacing={dx:.10g} um",
        f"system/mesh.yaml:/domain/size=[{', '.join(f'{k * RADIUS:g} um' for k in BOX)}]",
        f"system/mesh.yaml:/cells/0/edge={EDGE * dx:.8g} um",
        f"system/relax.yaml:/cell/edge={EDGE * dx:.8g} um",
        f"constant/membranes.yaml:/rbc/interior/viscosityRatio={ratio}"], ("membraneMesh", "membraneRelax", stretch, "particleFill", "dmpFlow"))


def stretch(folder):
    """Makes the original mesh the stress-free shape, and the last shape of membraneRelax the cell."""
    made = vtp.File(folder / "0/rbc.vtp")
    last = vtp.File(max((folder / "results/rbc").glob("*/*.vtp")))
    shutil.move(folder / "0/rbc.vtp", folder / "constant/stressFree.vtp")
    vtp.write(folder / "0/rbc.vtp", last.points, made.triangles, made.arrays["id"], made.arrays["spacing"][0], made.texts)
    for part in ("results", "postProcessing"):
        shutil.rmtree(folder / part)
    (folder / "run.json").unlink()  # of membraneRelax
    with open(folder / "constant/membranes.yaml", "a") as laws:
        laws.write("  stressFree: constant/stressFree.vtp\n")


def sheet(t, first, tc, last):
    """Length over width of Evans' sheet with viscosity: (R - last)/(R + last) = (first - last)/(first + last) exp(-t/tc)."""
    q = (first - last) / (first + last) * math.exp(-t / tc)
    return last * (1 + q) / (1 - q)


def fit(times, ratios, last=None):
    """first, tc and, if not given, last by least squares, with the Gauss-Newton method."""
    p = [ratios[0], 0.13] + ([1.05] if last is None else [])
    end, count, h = [] if last is None else [last], range(len(p)), 1e-6
    for _ in range(50):
        values = [sheet(t, *p, *end) for t in times]
        slopes = [[(sheet(t, *(q + h * (i == j) for i, q in enumerate(p)), *end) - v) / h for j in count] for t, v in zip(times, values)]
        matrix = [[sum(s[i] * s[j] for s in slopes) for j in count] for i in count]
        step = solve(matrix, [sum(s[i] * (r - v) for s, r, v in zip(slopes, ratios, values)) for i in count])
        p = [q + dq for q, dq in zip(p, step)]
    return [*p, *end]


def solve(m, right):
    """Cramer's rule, for two or three unknowns."""
    def det(a):
        if len(a) == 2:
            return a[0][0] * a[1][1] - a[0][1] * a[1][0]
        return sum(a[0][i] * (a[1][(i + 1) % 3] * a[2][(i + 2) % 3] - a[1][(i + 2) % 3] * a[2][(i + 1) % 3]) for i in range(3))

    count = range(len(m))
    return [det([[right[i] if j == k else m[i][j] for j in count] for i in count]) / det(m) for k in count]


def measured():
    cells = {}
    for row in rows(FOLDER / "recovery.csv"):
        times, ratios = cells.setdefault(int(row["cell"]), ([], []))
        times.append(row["time_s"])
        ratios.append(row["ratio"])
    return cells


def ours(folder):
    shape = Course(folder).shape
    return [row["time_s"] for row in shape], [row["length_m"] / row["width_m"] for row in shape]


def figures(done, n):
    allowed, cells = permitted(ALLOWED, n, 1), [fit(*cell)[1] for cell in measured().values()]
    low, high = min(cells), max(cells)
    found = []
    for name, folder in done.items():
        label = f"interior of {name[len('interior'):]} mPa s"
        times, ratios = ours(folder)
        (_, free, _), (_, tc, _) = fit(times, ratios), fit(times, ratios, 1)
        furthest = worst(r / sheet(t, ratios[0], ETA / GS, 1) - 1 for t, r in zip(times, ratios))
        found += [Figure(f"{label}: time of recovery, R1 fitted too, outside the four cells' {low:.3f} to {high:.3f} s",
                         outside(free, low, high), 0, "%", free),
                  relative(f"{label}: time of recovery, against eta/Gs", tc, ETA / GS, allowed),
                  Figure(f"{label}: length over width, worst, against the sheet with eta/Gs", 100 * furthest, WORST)]
        found += Course(folder).kept(label)
    return found


def left(times, ratios, last=None):
    """Times and the remaining stretch by the sheet's formula, with the ratios of the fit at the start and at the end."""
    first, _, last = fit(times, ratios, last)
    points = [(t, (r - last) * (first + last) / ((r + last) * (first - last))) for t, r in zip(times, ratios)]
    return zip(*((t, share) for t, share in points if share > LEAST))


def curves(done):
    mine = [(f"interior of {name[len('interior'):]} mPa s", *left(*ours(folder), 1)) for name, folder in done.items()]
    theirs = [("" if cell > 1 else "four cells", *left(*data)) for cell, data in measured().items()]
    sheets = f"set arrow from 0, 1 to {-math.log(LEAST) * ETA / GS:g}, {LEAST} nohead lw 2 dashtype 2 lc rgb 'black'"
    return Plot("time, s", "share of the stretch that is left; dashed: exp(-t Gs/eta)", mine, theirs,
                ["set logscale y", "set xrange [0:0.41]", f"set yrange [{LEAST}:1.1]", sheets])
