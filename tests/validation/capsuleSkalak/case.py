"""A spherical capsule of Skalak's law, C = 1, in shear flow, against boundary elements in unbounded flow."""
import math

from capsules import STRAIN, Capsules
from membranes import treadPeriod
from suite import HERE, Figure, at, relative, rows, worst

TITLE = "capsule in shear flow, Skalak C = 1"
ACROSS = "particles along the radius"
RESOLUTIONS = (6, 8, 12)
UNBOUNDED = True
ALLOWED = {6: {"0.3": 2}, 8: {"0.3": 2, "0.6": 2.5, "1.2": 5}}  # % of D12; 2 % at the finest is the aim
PERIOD = {6: 4, 8: 3}  # %; likewise
STRAINS = [0.1 * k for k in range(5, 10 * STRAIN + 1)]  # all observations from the strain at which D12 is half of its final value

capsules = Capsules("capsuleSkalak", ("0.3", "0.6", "1.2"))
runs = capsules.runs
periods = {row["Ca"]: row["period"] for row in rows(HERE / "capsuleSkalak" / "periods.csv")}


def figures(done, n):
    found = []
    for Ca, course in capsules.courses(done):
        label, theirs, allowed = f"Ca {Ca}", capsules.reference(Ca), ALLOWED.get(n, {}).get(Ca, 2)
        error = worst(course.at(t, "D12_inertia") / at(theirs, t, "D12_inertia") - 1 for t in STRAINS)
        mine, their = math.degrees(course.at(STRAIN, "inclination_rad")), at(theirs, STRAIN, "inclination_deg")
        found += [
            Figure(f"{label}: D12 from strain {STRAINS[0]:g} to {STRAIN}, worst", 100 * error, allowed),
            relative(f"{label}: D12 at strain {STRAIN}", course.at(STRAIN, "D12_inertia"), at(theirs, STRAIN, "D12_inertia"), allowed),
            Figure(f"{label}: inclination at strain {STRAIN}", mine - their, 1, "degrees", mine, their),
            relative(f"{label}: tank-treading period", treadPeriod(course), periods[float(Ca)], PERIOD.get(n, 2)),
            *course.kept(label)]
    return found


def curves(done):
    return capsules.drawn(done, "D12 by inertia", 0.2, ["set key right bottom", "set yrange [0:]"])
