"""Flows between two plates that start from rest: the cases, series and norms of tutorials/couette and poiseuille."""
from suite import TUTORIALS, Figure, Plot, Run, module, rows


class Plates:
    """name: the tutorial. allowed: per cent, by resolution, of the largest error in time. unit(its compare.py): velocity to draw by [m/s]."""

    def __init__(self, name, allowed, unit):
        self.source = TUTORIALS / name
        self.tutorial = module(self.source / "compare.py", name)
        self.allowed = allowed
        self.unit = unit(self.tutorial)

    def runs(self, n):
        dx, width = 1000 / n, 8 / n  # um, mm: the slice is 8 dx thick
        return [Run("flow", self.source, [
            f"system/numerics.yaml:/spacing={dx} um", f"system/mesh.yaml:/domain/size=[{width}, {width}, 1] mm",
            f"system/observers.yaml:/profile/bins={n}"], ("particleFill", "sphFlow"))]

    def figures(self, done, n):
        coarsest = min(self.allowed)
        allowed = self.allowed.get(n, self.allowed[coarsest] * (coarsest / n) ** 2)
        series = self.tutorial
        return [Figure(f"L2 of u at nu t/L^2 = {series.NU * t / series.L**2:g}", 100 * error, allowed, order=error > 1e-4)
                for t, error in zip(series.TIMES, series.errors(str(done["flow"])))]

    def curves(self, done, xlabel):
        (path,) = done["flow"].glob("postProcessing/profile/*/profile.csv")
        table, ours, theirs, L = rows(path), [], [], self.tutorial.L
        for time in self.tutorial.TIMES:
            t = min(row["time_s"] for row in table if row["time_s"] >= time)
            look = [row for row in table if row["time_s"] == t]
            heights = [row["position_m"] for row in look]
            ours.append((f"t = {time:g} s", [row["u_m_s"] / self.unit for row in look], [z / L for z in heights]))
            theirs.append(("", [self.tutorial.series(z, t) / self.unit for z in heights], [z / L for z in heights]))
        return Plot(xlabel, "z/L", ours, theirs, ["set key left top"])
