"""Two layers of equal thickness and density between plane walls, z = +-h: exact solutions from rest, by the modes

    phi_n = sin(a (z + h))/sin(a h) below z = 0 with a = sqrt(lambda_n/nu_1),   sin(b (h - z))/sin(b h) above with b = sqrt(lambda_n/nu_2),
    mu_1 a cot(a h) + mu_2 b cot(b h) = 0,      u = u_steady - sum_n c_n phi_n exp(-lambda_n t)

which are continuous with continuous stress and orthogonal, since the density is uniform. SI.
"""
import math

from plates import profiles, slab
from suite import HERE, Figure, Plot, Run, permitted

H, DENSITY, MU = 0.5e-3, 1000.0, (1.0e-3, 5.0e-3)  # half the gap; below and above z = 0
MODES = 80


def mu(z):
    return MU[1] if z > 0 else MU[0]


def _rates():
    """The square roots of lambda_n: one between each two neighbouring poles of the condition, where it falls from +inf to -inf."""
    poles = sorted([0.0] + [n * math.pi / H * math.sqrt(m / DENSITY) for m in MU for n in range(1, MODES + 1)])
    found = []
    for low, high in zip(poles[:MODES], poles[1:]):
        for _ in range(200):
            s = 0.5 * (low + high)
            value = sum(math.sqrt(m) / math.tan(s * math.sqrt(DENSITY / m) * H) for m in MU)
            low, high = (s, high) if value > 0 else (low, s)
        found.append(0.5 * (low + high))
    return found


RATES = _rates()
NUMBERS = [tuple(s * math.sqrt(DENSITY / m) for m in MU) for s in RATES]  # a and b
NORMS = [sum((H / 2 - math.sin(2 * a * H) / (4 * a)) / math.sin(a * H) ** 2 for a in pair) for pair in NUMBERS]  # integral of phi^2


def _modes(z, t, coefficients):
    side, depth = (1, H - z) if z > 0 else (0, z + H)
    return math.fsum(c * math.sin(pair[side] * depth) / math.sin(pair[side] * H) * math.exp(-s * s * t)
                     for c, pair, s in zip(coefficients, NUMBERS, RATES))


def couette(z, t, U):
    """Walls that move with -U and +U from t = 0."""
    coefficients = []
    for s, pair, norm in zip(RATES, NUMBERS, NORMS):
        below, above = (m * a / math.sin(a * H) for m, a in zip(MU, pair))  # mu phi' at the lower wall; minus it at the upper
        coefficients.append((above - below) * U / (s * s * DENSITY * norm))
    return couette_steady(z, U) - _modes(z, t, coefficients)


def couette_stress(U):
    return 2 * U / (H / MU[0] + H / MU[1])


def couette_steady(z, U):
    return couette_stress(U) / mu(z) * (z - H) + U if z > 0 else couette_stress(U) / mu(z) * (z + H) - U


def poiseuille(z, t, F):
    """A force F per mass from t = 0."""
    coefficients = [F * sum((1 - math.cos(a * H)) / (a * math.sin(a * H)) for a in pair) / (s * s * norm)
                    for s, pair, norm in zip(RATES, NUMBERS, NORMS)]
    return poiseuille_steady(z, F) - _modes(z, t, coefficients)


def poiseuille_steady(z, F):
    """mu u' = tau - rho F z; tau is the stress at the interface, from the same velocity on both sides of it."""
    stress = DENSITY * F * H / 2 * (MU[0] - MU[1]) / (MU[0] + MU[1])
    edge = H if z > 0 else -H
    return (stress * (z - edge) - 0.5 * DENSITY * F * (z * z - H * H)) / mu(z)


# Plain operators (Morris, harmonic mean) by super-time-stepping, corrected ones by the implicit step.
SCHEMES = {"plain": ["integrator=rkl2"], "corrected": ["integrator=implicit", "operators=corrected"]}
RATE = 0.0125  # 1/s, of both cases: converts an implicit step in seconds into a strain


def deviation(profile, exact):
    """Root mean square error over the layers of particles, over the root mean square of the exact profile."""
    return math.sqrt(math.fsum((u - exact(z)) ** 2 for z, u in profile) / math.fsum(exact(z) ** 2 for z, _ in profile))


class Layers:
    """name: the case's folder. exact(z, t): velocity. times: at which it is compared [s]. step: of the implicit scheme [s], times n.
    allowed: per cent, by resolution, of the largest error in time."""

    def __init__(self, name, exact, times, step, allowed):
        self.source, self.exact, self.times, self.step, self.allowed = HERE / name, exact, times, step, allowed

    def runs(self, n):
        more = {"plain": [], "corrected": [f"system/numerics.yaml:/implicit/step={RATE * (self.step / n):.6g}",
                                           "system/numerics.yaml:/implicit/tolerance=1e-6"]}
        return [Run(scheme, self.source, slab(n) + [f"system/numerics.yaml:/{word}" for word in words] + more[scheme], ("particleFill", "sphFlow"))
                for scheme, words in SCHEMES.items()]

    def permitted(self, n):
        return permitted(self.allowed, n, 1.5)

    def deviations(self, done, n, scheme):
        return [Figure(f"{scheme}: L2 of u at t = {time:g} s", 100 * deviation(profile, lambda z: self.exact(z, t)), self.permitted(n), order=True)
                for time, (t, profile) in zip(self.times, profiles(done[scheme], self.times))]

    def figures(self, done, n):
        return [figure for scheme in SCHEMES for figure in self.deviations(done, n, scheme)]

    def curves(self, done, scale, label, key):
        ours, theirs = [], []
        for time, (t, profile) in zip(self.times, profiles(done["corrected"], self.times)):
            ours.append((f"t = {time:g} s", [u / scale for _, u in profile], [z / (2 * H) for z, _ in profile]))
            dense = [H * (2 * (k + 0.5) / 400 - 1) for k in range(400)]
            theirs.append(("", [self.exact(z, t) / scale for z in dense], [z / (2 * H) for z in dense]))
        return Plot(label, "z/L", ours, theirs, [f"set key {key}"])
