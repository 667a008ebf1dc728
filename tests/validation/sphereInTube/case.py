"""A rigid sphere on the axis of a round tube, free and held, against an exact solution."""
import math
import pathlib

from suite import PROGRAMS, Plot, Run, permitted, relative, rows

HERE = pathlib.Path(__file__).parent
TITLE = "sphere on the axis of a tube"
ACROSS = "particles across the tube"
RESOLUTIONS = (12, 16, 24, 40)
RATIOS = (0.2, 0.3, 0.5, 0.7, 0.8)  # radius of the sphere over that of the tube
SMALLEST = 4  # spheres and gaps with fewer particles across are left out

R, NU, RHO, FORCE = 1e-4, 1e-6, 1000.0, 4e-3  # SI, as in constant
LENGTH = 8  # of the box, over R
TAU = R**2 / (5.78 * NU)  # time in which the flow settles by a factor e
STEPS = 8  # each of three times that
SETTLED = 3 * TAU * FORCE * R**2 / (4 * NU) / R  # of a step, in units of strain

exact = {row["lambda"]: row for row in rows(HERE / "exact.csv")}


def ratios(n):
    return [x for x in RATIOS if x * n >= SMALLEST and (1 - x) * n / 2 >= 2]


def allowed(x, n):
    """1 % at most up to 0.5 and 3 % at 0.8, with a gap of at least 4 dx and at 24 across; of second order."""
    bar = 1 if x <= 0.5 else 3
    return bar * max(1, (24 / n) ** 2, (4 / ((1 - x) * n / 2)) ** 2)


def runs(n):
    return [run(x, n, motion) for x in ratios(n) for motion in ("free", "held")]


def run(x, n, motion):
    dx = 2e6 * R / n
    return Run(f"{motion}{x:g}", HERE, [
        f"system/numerics.yaml:/spacing={dx:.10g} um",
        f"system/numerics.yaml:/implicit/step={SETTLED:.6g}",
        f"system/control.yaml:/endTime={3 * STEPS * TAU:.8g} s",
        f"system/mesh.yaml:/domain/size=[{1e6 * R * LENGTH:g} um, {2e6 * R:g} um, {2e6 * R:g} um]",
        f"system/mesh.yaml:/bodies/0/shape/radius={1e6 * x * R:g} um",
        f"system/mesh.yaml:/bodies/0/edge={max(0.5 * dx, 1e6 * x * R / 16):.6g} um",
        f"constant/bodies.yaml:/sphere/motion={motion}"], PROGRAMS)


def speed(folder):
    """Velocity on the axis far from the sphere: twice the mean one."""
    return 2 * rows(folder / "postProcessing/flow/flowRate.csv")[-1]["meanVelocity_m_s"]


def measured(done, x):
    """U/Vmax of the free sphere; K2 of the held one; K1, their quotient."""
    free, held = done[f"free{x:g}"], done[f"held{x:g}"]
    velocity = rows(free / "postProcessing/force/sphere.csv")[-1]["velocity_x_m_s"] / speed(free)
    K2 = rows(held / "postProcessing/force/sphere.csv")[-1]["force_x_N"] / (6 * math.pi * RHO * NU * x * R * speed(held))
    return velocity, K2, K2 / velocity


def figures(done, n):
    found = []
    for x in ratios(n):
        velocity, _, K1 = measured(done, x)
        found += [relative(f"U/Vmax of the free sphere, a/R = {x:g}", velocity, exact[x]["U_over_Vmax"], allowed(x, n), order=True),
                  relative(f"K1, a/R = {x:g}", K1, exact[x]["K1"], allowed(x, n), order=True)]
    return found


def curves(done):
    sizes = sorted(float(name[4:]) for name in done if name.startswith("free"))
    return Plot("a/R", "U/Vmax", [("this program", sizes, [measured(done, x)[0] for x in sizes])],
                [("exact", RATIOS, [exact[x]["U_over_Vmax"] for x in RATIOS])], ["set key right top", "set yrange [0:1.05]"])
