"""Kinetic energy of decaying flows in a periodic box, with the definitions of tutorials/taylorGreen."""
import math

from suite import TUTORIALS, Figure, Plot, Run, module, permitted, worst

tutorial = module(TUTORIALS / "taylorGreen" / "compare.py", "taylorGreen")


def decay(folder, rate):
    """Times over 1/rate and kinetic energies over the first."""
    return [(rate * t, energy) for t, energy in tutorial.decay(str(folder))]


class Decay:
    """A flow whose energy falls as exp(-t), t over 1/rate. allowed: by resolution, per cent of E(0) until 1/e; `whole` times that over the whole
    run; `viscosity` times that of the effective viscosity (an error of the viscosity e times as large causes this error of E at 1/e). settings(n):
    in addition to the spacing."""

    def __init__(self, source, rate, time, allowed, order, viscosity=math.e, settings=lambda n: [], whole=2):
        self.source, self.rate, self.time, self.allowed, self.order = source, rate, time, allowed, order
        self.viscosity, self.settings, self.whole = viscosity, settings, whole

    def runs(self, n):
        return [Run("flow", self.source, [f"system/numerics.yaml:/spacing={1000 / n} um", *self.settings(n)], ("particleFill", "sphFlow"))]

    def figures(self, done, n):
        points, allowed = decay(done["flow"], self.rate), permitted(self.allowed, n, self.order)
        error, all_ = (worst(energy - math.exp(-t) for t, energy in points if t <= end) for end in (1, math.inf))
        felt = tutorial.viscosity(points, 1)
        return [Figure("E/E(0) until 1/e, largest error", 100 * error, allowed, order=True),
                Figure(f"the whole run, until exp(-{points[-1][0]:.1f}), largest error", 100 * all_, self.whole * allowed),
                Figure("viscosity felt, from the time of 1/e", 100 * (felt - 1), self.viscosity * allowed, "%", felt, 1, order=True)]

    def curves(self, done):
        points = decay(done["flow"], self.rate)
        times = [t for t, _ in points]
        return Plot(self.time, "E/E(0)", [("particles", times, [e for _, e in points])], [("exact", times, [math.exp(-t) for t in times])],
                    ["set logscale y"])
