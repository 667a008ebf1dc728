"""Creeping flow through round tubes whose radius varies as a cosine, against exact solutions."""
import math
import pathlib

from suite import Plot, Run, permitted, relative, rows

HERE = pathlib.Path(__file__).parent
TITLE = "flow through sinusoidal tubes"
ACROSS = "particles across the throat"
RESOLUTIONS = (8, 12, 16, 24)
ALLOWED = {8: 9, 12: 4, 16: 2.25, 24: 1}  # %; 1 % at 24, of second order

R0, NU = 10e-6, 1e-6  # m, m^2/s: mean radius; constant/fluid.yaml
RE = 0.01  # mean velocity of a straight tube times R0/nu
CASES = [(row["eps"], row["L_over_R0"], row["ratio"]) for row in rows(HERE / "exact.csv")]


def name(eps, length):
    return f"eps{eps:g}-L{length:g}"


def runs(n):
    return [run(*case, n) for case in CASES]


def run(eps, length, ratio, n):
    count = round(length * n / (2 * (1 - eps)))
    dx = length * R0 / count
    wide = 2 * math.ceil(R0 * (1 + eps) / dx - 1e-9) * dx
    U = RE * NU / R0
    force = 8 * NU * U * ratio / R0**2
    travel = 0.5 * length * R0 / U  # the fluid moves by half the length on average
    return Run(name(eps, length), HERE, [
        f"system/numerics.yaml:/spacing={1e6 * dx:.12g} um",
        f"system/mesh.yaml:/domain/size=[{1e6 * length * R0:.12g} um, {1e6 * wide:.12g} um, {1e6 * wide:.12g} um]",
        f"system/control.yaml:/endTime={travel:.8g} s",
        f"system/observers.yaml:/flow/every={travel / 40:.8g} s",
        f"constant/flow.yaml:/bodyForce={force:.8g} m/s^2",
        f"constant/flow.yaml:/walls={{type: sinusoidalTube, diameter: {2e6 * R0:g} um, amplitude: {eps}}}"],
        ("particleFill", "sphFlow"))


def ratios(folder, length):
    """Pressure drop over that of a straight tube, at each look but the first."""
    table = rows(folder / "postProcessing/flow/flowRate.csv")[1:]
    return [row["pressureDrop_Pa"] * math.pi * R0**4 / (8 * NU * 1000 * row["flowRate_m3_s"] * length * R0) for row in table]


def figures(done, n):
    allowed, found = permitted(ALLOWED, n, 2), []
    for eps, length, exact in CASES:
        all_ = ratios(done[name(eps, length)], length)
        where = f"eps {eps:g}, L = {length:g} R0"
        found += [relative(f"pressure drop, {where}, at the start", all_[0], exact, allowed, order=True),
                  relative(f"pressure drop, {where}, later, mean", sum(all_[10:]) / len(all_[10:]), exact, allowed, order=True)]
    return found


def curves(done):
    return Plot("mean way of the fluid over L", "pressure drop over the exact one",
                [(f"eps {eps:g}, L = {length:g} R0", *zip(*[((k + 1) / 80, r / exact) for k, r in enumerate(ratios(done[name(eps, length)], length))]))
                 for eps, length, exact in CASES], [("exact", (0, 0.5), (1, 1))], ["set key right top"])
