"""Start-up of plane Poiseuille flow against its series: the case, series and norm of tutorials/poiseuille."""
from suite import TUTORIALS, Figure, Plot, Run, module, rows

TITLE = "start-up of Poiseuille flow"
ACROSS = "particles across the gap"
RESOLUTIONS = (16, 32, 64)
ALLOWED = {16: 1.0, 32: 0.3, 64: 0.1}  # %, at the earliest time; 0.1 % at 64 is the aim

tutorial = module(TUTORIALS / "poiseuille" / "compare.py", "poiseuille")
FASTEST = tutorial.F * tutorial.L**2 / (8 * tutorial.NU)  # in the end


def runs(n):
    dx, width = 1000 / n, 8 / n  # um, mm: the slice is 8 dx thick
    return [Run("flow", TUTORIALS / "poiseuille", [
        f"system/numerics.yaml:/spacing={dx} um", f"system/mesh.yaml:/domain/size=[{width}, {width}, 1] mm",
        f"system/observers.yaml:/profile/bins={n}"], ("particleFill", "sphFlow"))]


def figures(done, n):
    allowed = ALLOWED.get(n, 1.0 * (16 / n) ** 2)
    return [Figure(f"L2 of u at nu t/L^2 = {tutorial.NU * t / tutorial.L**2:g}", 100 * error, allowed, order=error > 1e-4)
            for t, error in zip(tutorial.TIMES, tutorial.errors(str(done["flow"])))]


def curves(done):
    (path,) = done["flow"].glob("postProcessing/profile/*/profile.csv")
    table, ours, theirs = rows(path), [], []
    for time in tutorial.TIMES:
        t = min(row["time_s"] for row in table if row["time_s"] >= time)
        look = [row for row in table if row["time_s"] == t]
        z = [row["position_m"] for row in look]
        ours.append((f"t = {time:g} s", [row["u_m_s"] / FASTEST for row in look], [x / tutorial.L for x in z]))
        theirs.append(("", [tutorial.series(x, t) / FASTEST for x in z], [x / tutorial.L for x in z]))
    return Plot("u/(F L^2/8 nu)", "z/L", ours, theirs, ["set key left top"])
