"""A spherical neo-Hookean capsule in shear flow, against the band of published curves and own boundary elements."""
import math

from capsules import Capsules
from membranes import treadPeriod
from suite import HERE, Figure, at, outside, published, relative, rows, worst

TITLE = "capsule in shear flow, neo-Hookean"
ACROSS = "particles along the radius"
RESOLUTIONS = (6, 8, 12)
UNBOUNDED = True
TIMES = (1, 3, 4, 5)
INCLINED = {"0.075": 1, "0.3": 5, "0.6": 5}  # strain; at Ca 0.075 the reference's membrane, which has no bending, wrinkles later: its D swings by 5 %
READING, MESH = 0.003, 0.002  # errors of D: of reading published curves; of the boundary elements, 642 against 2562 nodes
ALLOWED = {6: 0.5, 8: 0.5, 12: 0}  # % outside the band; inside at the finest is the aim
BARE = 0.5  # % outside the band of the published curves without their errors
PERIOD = {6: 4, 8: 3}  # %; 2 from 12 on

capsules = Capsules("capsuleNeoHookean", ("0.075", "0.3", "0.6"), ["constant/membranes.yaml:/capsule/triangles={type: neoHookean, Gs: 1e-5 N/m}"],
                    {"0.6": {12: (10, 8, 10)}})  # BOX adds 0.6 % to D12, more than the margin of the band
runs = capsules.runs
periods = {row["Ca"]: row["period"] for row in rows(HERE / "capsuleNeoHookean" / "periods.csv")}


def sources(Ca):
    return published(HERE / "capsuleNeoHookean" / "published.csv", Ca=float(Ca)).values()


def band(Ca, strain, reading=READING, mesh=MESH):
    """Least and greatest D of all sources that reach this strain, each with its error."""
    found = [(at(table, strain, "D"), reading) for table in sources(Ca)]
    found.append((at(capsules.reference(Ca), strain, "D12_inertia"), mesh))
    found = [(value, error) for value, error in found if math.isfinite(value)]
    return min(value - error for value, error in found), max(value + error for value, error in found)


def figures(done, n):
    found, allowed = [], ALLOWED.get(n, 0)
    for Ca, course in capsules.courses(done):
        for strain in TIMES:
            low, high = band(Ca, strain)
            value = course.at(strain, "D12_inertia")
            found.append(Figure(f"Ca {Ca}: D12 at strain {strain}, outside {low:.3f} to {high:.3f}", outside(value, low, high), allowed, "%", value))
        beyond = worst(outside(course.at(strain, "D12_inertia"), *band(Ca, strain, 0, 0)) for strain in TIMES)
        found.append(Figure(f"Ca {Ca}: D12, worst outside the band without the errors of its curves", beyond, BARE))
        strain = INCLINED[Ca]
        mine, their = math.degrees(course.at(strain, "inclination_rad")), at(capsules.reference(Ca), strain, "inclination_deg")
        found.append(Figure(f"Ca {Ca}: inclination at strain {strain}", mine - their, 1, "degrees", mine, their))
        if float(Ca) in periods:
            found.append(relative(f"Ca {Ca}: tank-treading period", treadPeriod(course), periods[float(Ca)], PERIOD.get(n, 2)))
        found += course.kept(f"Ca {Ca}")
    return found


def curves(done):
    def others(Ca, end):
        tables = [[row for row in table if row["strain"] <= end] for table in sources(Ca)]
        return [([row["strain"] for row in table], [row["D"] for row in table]) for table in tables]

    return capsules.drawn(done, "D12", 0.2, ["set key at 4.8, 0.28", "set xrange [0:]", "set yrange [0:0.6]"], others)
