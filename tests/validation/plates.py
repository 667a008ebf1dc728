"""Flows between two plates that start from rest: the cases, series and norms of tutorials/couette and poiseuille."""
from suite import TUTORIALS, Figure, Plot, Run, module, permitted, rows


def slab(n):
    """A layer of fluid 1 mm high with n particles across, 8 dx long and thick, and its profile by layers of particles."""
    dx, width = 1000 / n, 8 / n  # um, mm
    return [f"system/numerics.yaml:/spacing={dx} um", f"system/mesh.yaml:/domain/size=[{width} mm, {width} mm, 1 mm]",
            f"system/observers.yaml:/profile/bins={n}"]


def profiles(folder, times):
    """(time, [(z, u)]) at the first output at or after each of these times."""
    table, found = rows(folder / "postProcessing/profile/profile.csv"), []
    for time in times:
        t = min(row["time_s"] for row in table if row["time_s"] >= time * (1 - 1e-9))
        found.append((t, [(row["position_m"], row["u_m_s"]) for row in table if row["time_s"] == t]))
    return found


class Plates:
    """name: the tutorial. allowed: per cent, by resolution, of the largest error in time. unit(its compare.py): velocity unit of the plot [m/s]."""

    def __init__(self, name, allowed, unit, label):
        self.source = TUTORIALS / name
        self.tutorial = module(self.source / "compare.py", name)
        self.allowed, self.unit, self.label = allowed, unit(self.tutorial), label

    def runs(self, n):
        return [Run("flow", self.source, slab(n), ("particleFill", "sphFlow"))]

    def figures(self, done, n):
        allowed, series = permitted(self.allowed, n, 2), self.tutorial
        return [Figure(f"L2 of u at nu t/L^2 = {series.NU * t / series.L**2:g}", 100 * error, allowed, order=error > 1e-4)
                for t, error in zip(series.TIMES, series.errors(str(done["flow"])))]

    def curves(self, done):
        ours, theirs, L = [], [], self.tutorial.L
        for time, (t, profile) in zip(self.tutorial.TIMES, profiles(done["flow"], self.tutorial.TIMES)):
            heights = [z / L for z, _ in profile]
            ours.append((f"t = {time:g} s", [u / self.unit for _, u in profile], heights))
            theirs.append(("", [self.tutorial.series(z, t) / self.unit for z, _ in profile], heights))
        return Plot(self.label, "z/L", ours, theirs, ["set key outside right"])
