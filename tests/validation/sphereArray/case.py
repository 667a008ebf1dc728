"""Drag of simple cubic arrays of fixed spheres in Stokes flow against Zick and Homsy (zickHomsy.csv).

The flow between walls has LAYERS layers of spheres across it; drag and flux are those of the middle layer and of its cells. There the walls are
two cells away: their effect falls as exp(-2 pi) = 1/535 per cell, or as cosh(z/sqrt(k)) with k = L^3/(6 pi a K), sqrt(k) = 0.38 L at c = 0.027
and less in denser arrays; and K is the ratio of two numbers that both decrease by the same factor.
"""
import math
import pathlib

from suite import PROGRAMS, Plot, Run, relative, rows

HERE = pathlib.Path(__file__).parent
TITLE = "drag of cubic arrays of spheres"
ACROSS = "particles along the diameter, about"
RESOLUTIONS = (8, 12, 16, 24)
FRACTIONS = (0.027, 0.064, 0.125, 0.216, 0.45)
ALLOWED = {8: (2, 10), 12: (1, 2), 16: (1, 2), 24: (1, 3)}  # %: c <= 0.216; c = 0.45. At 24 the aim

L, NU, RHO = 1e-3, 1e-6, 1000.0  # m, m^2/s, kg/m^3: of a cell; constant/fluid.yaml
RE, LAYERS = 1e-3, 5  # Re = U a/nu
STEPS = 6  # each of three times the response time of the flow: the missing part falls by a factor of 3 to 4 in each
EDGES = 16  # of the mesh along the radius
REACH = 2.4  # system/numerics.yaml: support over dx

# Sangani and Acrivos (zickHomsy.csv): K = sum q_s chi^s, chi = (c/0.5236)^(1/3); for the plot
SERIES = (1.0, 1.418649, 2.012564, 2.331523, 2.564809, 2.584787, 2.873609, 3.340163, 3.536763, 3.504092, 3.253622, 2.689757, 2.037769, 1.809341,
          1.877347, 1.534685, 0.9034708, 0.2857896, -0.5512626, -1.278724, 1.013350, 5.492491, 4.615388, -0.5736023, -2.865924, -4.709215,
          -6.870076, 0.1455304, 12.51891, 9.742811, -5.566269)

reference = {row["c"]: row["K_ZickHomsy"] for row in rows(HERE / "zickHomsy.csv")}


def series(c):
    chi = (6 * c / math.pi) ** (1 / 3)
    return sum(q * chi**s for s, q in enumerate(SERIES))


def radius(c):
    return (3 * c / (4 * math.pi)) ** (1 / 3) * L


def across(c, n):
    """Particles along a cell."""
    return round(n * L / (2 * radius(c)))


def wide(c, n):
    """Cells side by side: a body must not reach its own image within the kernel's support."""
    return 1 if across(c, n) >= n + 2 * REACH + 1 else 2


def name(c):
    return f"c{c:g}"


def runs(n):
    """Runs at n; from 16 on also at n/2, for the extrapolation."""
    return [run(c, n) for c in FRACTIONS] + [run(c, n // 2, "half-") for c in FRACTIONS if n >= 16]


def run(c, n, prefix=""):
    N, m, a, K = across(c, n), wide(c, n), radius(c), reference[c]
    force = 6 * math.pi * RE * NU**2 * K / L**3  # per mass, so that U = RE nu/a
    tau = L**3 / (6 * math.pi * NU * a * K) * (1 + c / 2) / (1 - c)  # the factor: inertia of a flow that winds around spheres
    sound = 0.5 * L / tau  # pressure spreads over a cell, against the drag, at a rate of pi^2/tau
    rate = force * LAYERS * L / (8 * NU)  # shear rate of the flow between walls without spheres, the unit of the steps
    bodies = ", ".join(
        f"{{name: sphere{x}{y}{z}, body: sphere, shape: {{type: sphere, radius: {1e6 * a:.8g} um}}, edge: {1e6 * a / EDGES:.6g} um, "
        f"centre: [{1e3 * L * (x - (m - 1) / 2):g} mm, {1e3 * L * (y - (m - 1) / 2):g} mm, {1e3 * L * (z - (LAYERS - 1) / 2):g} mm]}}"
        for x in range(m) for y in range(m) for z in range(LAYERS))
    return Run(prefix + name(c), HERE, [
        f"system/numerics.yaml:/spacing={1e6 * L / N:.10g} um",
        f"system/numerics.yaml:/implicit/step={3 * tau * rate:.6g}",
        f"system/mesh.yaml:/domain/size=[{1e3 * L * m:g} mm, {1e3 * L * m:g} mm, {1e3 * L * LAYERS:g} mm]",
        f"system/mesh.yaml:/bodies=[{bodies}]",
        f"system/observers.yaml:/flux/bins={N * LAYERS}",
        f"system/control.yaml:/endTime={3 * STEPS * tau:.8g} s",
        f"constant/fluid.yaml:/equationOfState={{type: tait, soundSpeed: {sound:.6g} m/s}}",
        f"constant/flow.yaml:/bodyForce={force:.8g} m/s^2"], PROGRAMS)


def drag(folder, c, n):
    """K of the middle layer at the end."""
    N, m, middle = across(c, n), wide(c, n), LAYERS // 2
    files = [folder / "postProcessing/force" / f"sphere{x}{y}{middle}.csv" for x in range(m) for y in range(m)]
    force = sum(rows(path)[-1]["force_x_N"] for path in files) / m**2
    flux = rows(folder / "postProcessing/flux/profile.csv")
    flux = [row for row in flux if row["time_s"] == flux[-1]["time_s"] and abs(row["position_m"]) < L / 2]
    velocity = sum(row["u_m_s"] * row["count"] for row in flux if row["count"]) / (N**3 * m**2)
    return force / (6 * math.pi * RHO * NU * radius(c) * velocity)


def figures(done, n):
    dilute, dense = ALLOWED.get(n, (60 / n, 240 / n))
    found = []
    for c in FRACTIONS:
        K = drag(done[name(c)], c, n)
        found.append(relative(f"K at c = {c:g}", K, reference[c], dense if c > 0.3 else dilute, order=True))
    for c in FRACTIONS if n >= 16 else ():
        fine, coarse = drag(done[name(c)], c, n), drag(done["half-" + name(c)], c, n // 2)
        ratio = (across(c, n) / across(c, n // 2)) ** 2  # of errors of second order
        K = fine + (fine - coarse) / (ratio - 1)
        found.append(relative(f"K at c = {c:g}, from this and half the resolution", K, reference[c], dense if c > 0.3 else dilute))
    return found


def curves(done):
    """K over that of Zick and Homsy, at all resolutions that have been run."""
    work = next(iter(done.values())).parent.parent
    ours = []
    for n in RESOLUTIONS:
        folders = {c: work / str(n) / name(c) for c in FRACTIONS}
        if all((folder / "run.json").exists() for folder in folders.values()):
            ours.append((f"{n} particles along the diameter", FRACTIONS, [drag(folder, c, n) / reference[c] for c, folder in folders.items()]))
    dilute = [c for c in FRACTIONS if c < 0.3]
    return Plot("c", "K over that of Zick and Homsy", ours,
                [("Zick and Homsy", FRACTIONS, [1 for _ in FRACTIONS]), ("Sangani and Acrivos, series", dilute, [series(c) / reference[c] for c in dilute])],
                ["set key left top", "set xrange [0:0.5]", "set yrange [:1.12]"])
