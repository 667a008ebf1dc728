"""What the cases with a Kuchel-Fackerell cell in shear flow share: comparison with boundary elements by their own definitions."""
import math

from membranes import Course, settings, worst
from suite import TUTORIALS, Figure, Plot, Run, at, relative, rows

SOURCE = TUTORIALS / "rbcShear" / "Ca0.02"


def reference(here, Ca):
    return rows(here / f"reference_Ca{Ca}.csv")


def turnOf(table, degrees):
    """Strain at which the main axis has turned so far; nan if it never does."""
    for a, b in zip(table, table[1:]):
        if a["angle_deg"] < degrees <= b["angle_deg"]:
            return a["strain"] + (b["strain"] - a["strain"]) * (degrees - a["angle_deg"]) / (b["angle_deg"] - a["angle_deg"])
    return math.nan


def run(Ca, n, box, strain, more=(), programs=("membraneMesh", "particleFill", "dmpFlow"), edge=1.0):
    return Run(f"Ca{Ca}", SOURCE, settings(n, box, strain, [
        f"constant/flow.yaml:/Ca={Ca}", "constant/flow.yaml:/inertia/Re=0.01",
        "system/observers.yaml:/deformation/every=0.05 strain", *more], edge), programs)


def figures(here, done, allowed):
    """allowed, by Ca: of D12_inertia, of the angle [degrees], of strains of turns [%], of the change of area [points]."""
    found = []
    for name, folder in done.items():
        Ca, course = name[2:], Course(folder)
        theirs, label = reference(here, Ca), f"Ca {Ca}"
        dD, dAngle, dTurn, dArea = allowed[Ca]
        end = 0.5 * int(2 * course.end + 1e-6)  # the last step may go beyond
        strains = [0.5 * k for k in range(1, int(2 * end) + 1)]
        tumbles = turnOf(theirs, 90) < end
        found.append(Figure(f"{label}: D12 by inertia to strain {end:g}, worst", worst(course, theirs, "D12_inertia", strains), dD, ""))
        if tumbles:
            # Where the cell turns fast, an error of the rate is an error of the angle by that speed: compared by strain there.
            found.append(relative(f"{label}: strain of a quarter turn", course.turn(90), turnOf(theirs, 90), dTurn))
            if turnOf(theirs, 180) < end:
                found.append(relative(f"{label}: strain of half a turn", course.turn(180), turnOf(theirs, 180), dTurn))
        slow = [t for t in strains if not tumbles or at(theirs, t, "angle_deg") < 30]
        mine, their = -course.at(slow[-1], "angle_deg"), -at(theirs, slow[-1], "angle_deg")
        found.append(Figure(f"{label}: inclination to strain {slow[-1]:g}, worst", worst(course, theirs, "angle_deg", slow, -1), dAngle, "degrees"))
        found.append(Figure(f"{label}: inclination at strain {slow[-1]:g}", mine - their, dAngle, "degrees", mine, their))
        area, areaTheirs = 100 * course.area(end), 100 * (at(theirs, end, "area") - 1)
        found.append(Figure(f"{label}: change of area at strain {end:g} (%)", area - areaTheirs, dArea, "points", area, areaTheirs))
        found += course.kept(label)
    return found


def curves(here, done):
    ours, theirs = [], []
    for name, folder in done.items():
        course = Course(folder)
        table = [row for row in reference(here, name[2:]) if row["strain"] <= course.end]
        ours.append((f"Ca {name[2:]}", *course.curve("D12_inertia", 0.25)))
        theirs.append(("", [row["strain"] for row in table], [row["D12_inertia"] for row in table]))
    return Plot("strain", "D12 by inertia", ours, theirs, ["set key right center"])
