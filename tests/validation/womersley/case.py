"""Oscillating flow through a round tube, from rest, against the exact solution."""
import cmath
import math
import pathlib

from suite import Figure, Plot, Run, permitted, relative, rows

HERE = pathlib.Path(__file__).parent
TITLE = "oscillating flow through a tube"
ACROSS = "particles across the tube"
RESOLUTIONS = (8, 12, 16, 24)
ALLOWED = {8: 9, 12: 4, 16: 2.25, 24: 1}  # %; 1 % at 24, of second order
ALLOWED_ANGLE = {8: 9, 12: 4, 16: 2.25, 24: 1}  # degrees; likewise
# The Stokes layer of alpha = 10 is 0.6 dx wide there.
MISSED = {8: {"amplitude of the flow rate, alpha 10": 9.7}}

R, NU = 12e-6, 1e-6  # m, m^2/s: constant/flow.yaml, constant/fluid.yaml
FORCE = 10  # m/s^2, constant/flow.yaml
ALPHAS = (1, 3, 10)  # R sqrt(omega/nu)
PERIODS, LOOKS = 3, 64  # looks in each period


def zeros_of_J0(count):
    """The zeros of the Bessel function J0: McMahon's expansion, improved by Newton's method with the power series where that is accurate."""
    found = []
    for k in range(1, count + 1):
        b = (k - 0.25) * math.pi
        j = b + 1 / (8 * b) - 124 / (3 * (8 * b) ** 3) + 120928 / (15 * (8 * b) ** 5)
        for _ in range(3 if j < 12 else 0):
            terms = [(-0.25 * j * j) ** m / math.factorial(m) ** 2 for m in range(60)]
            slope = sum(2 * m / j * term for m, term in enumerate(terms))
            j -= sum(terms) / slope
        found.append(j)
    return found


ZEROS = zeros_of_J0(400)


def exact(omega, t):
    """Flow rate that the force FORCE cos(omega t) drives from rest, by the modes of the tube [m^3/s]."""
    total = 0
    for j in ZEROS:
        rate = NU * (j / R) ** 2
        total += 4 * math.pi * R**2 / j**2 * (
            rate * math.cos(omega * t) + omega * math.sin(omega * t) - rate * math.exp(-rate * t)) / (rate**2 + omega**2)
    return FORCE * total


def omega_of(alpha):
    return NU * (alpha / R) ** 2


def name(alpha):
    return f"alpha{alpha}"


def runs(n):
    return [run(alpha, n) for alpha in ALPHAS]


def run(alpha, n):
    dx, period = 2 * R / n, 2 * math.pi / omega_of(alpha)
    return Run(name(alpha), HERE, [
        f"system/numerics.yaml:/spacing={1e6 * dx:.10g} um",
        f"system/mesh.yaml:/domain/size=[{8e6 * dx:.10g} um, {2e6 * R:.10g} um, {2e6 * R:.10g} um]",
        f"system/control.yaml:/endTime={PERIODS * period:.10g} s",
        f"system/observers.yaml:/flow/every={period / LOOKS:.10g} s",
        f"constant/flow.yaml:/drive/frequency={1 / period:.10g} Hz"],
        ("particleFill", "sphFlow"))


def seen(folder):
    """Time and flow rate at each look but the start."""
    return [(row["time_s"], row["flowRate_m3_s"]) for row in rows(folder / "postProcessing/flow/flowRate.csv")[1:]]


def response(curve, omega):
    """Complex amplitude over the last period: 2/T times the integral of Q exp(-i omega t)."""
    return 2 / LOOKS * sum(rate * cmath.exp(-1j * omega * t) for t, rate in curve[-LOOKS:])


def figures(done, n):
    found = []
    for alpha in ALPHAS:
        omega, curve = omega_of(alpha), seen(done[name(alpha)])
        ours, wanted = (response(c, omega) for c in (curve, [(t, exact(omega, t)) for t, _ in curve]))
        found += [relative(f"amplitude of the flow rate, alpha {alpha}", abs(ours), abs(wanted), permitted(ALLOWED, n, 2), order=True),
                  Figure(f"phase of the flow rate, alpha {alpha}", math.degrees(cmath.phase(ours / wanted)),
                         permitted(ALLOWED_ANGLE, n, 2), "degrees", order=True)]
    return found


def curves(done):
    ours, wanted = [], []
    for alpha in ALPHAS:
        omega, curve = omega_of(alpha), seen(done[name(alpha)])
        steady = math.pi * R**4 * FORCE / (8 * NU)
        times = [omega * t / (2 * math.pi) for t, _ in curve]
        ours.append((f"alpha {alpha}", times, [rate / steady for _, rate in curve]))
        wanted.append((f"exact, alpha {alpha}", times, [exact(omega, t) / steady for t, _ in curve]))
    return Plot("periods", "flow rate over that of the steady force", ours, wanted, ["set key right top"])
