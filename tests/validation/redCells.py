"""Shared by the cases with a Kuchel-Fackerell cell in shear flow: comparison with boundary elements by the same definitions."""
from membranes import Sheared, turn, worst
from suite import PROGRAMS, TUTORIALS, Figure, at, relative

# Boxes in radii (flow, vorticity, gradient), from a resolution on: the finest runs have wider boxes, as their error is less than that of the box.
TUMBLING, STIFF, DRAWN = {6: (6, 6, 6), 12: (8, 6, 8)}, {6: (6, 6, 6), 12: (10, 8, 10)}, {6: (8, 6, 8)}


EVERY = 0.05  # strain between two observations of the shape; curves are compared at each


class RedCells(Sheared):
    """law: settings of the membrane. allowed: by resolution and Ca, of D12_inertia, angles [degrees], strains of turns [%] and the change of
    area [points].

    recorded: by resolution and Ca, D12_inertia and the inclination [degrees] at the end of an earlier run. A coarse resolution is far from the
    reference, so that its tolerance would hide a smaller fault of the program; the comparison with an earlier run reveals it."""

    def __init__(self, name, scenes, allowed, law, edge=1.0, programs=PROGRAMS, recorded=None, **varied):
        super().__init__(name, TUTORIALS / "rbcShear" / "Ca0.02", scenes, [
            "constant/flow.yaml:/inertia/Re=0.01", f"system/observers.yaml:/deformation/every={EVERY} strain", *law], edge, programs, coarse="3" if "3" in scenes else None, **varied)
        self.allowed, self.recorded = allowed, recorded or {}

    def figures(self, done, n):
        allowed = self.allowed.get(n, self.allowed[max(self.allowed)])
        found = [figure for Ca, course in self.courses(done) for figure in self.compared(Ca, course, *allowed[Ca])]
        kept = self.recorded.get(n, {})
        return found + [figure for Ca, course in self.courses(done) if Ca in kept for figure in self.unchanged(Ca, course, *kept[Ca])]

    def unchanged(self, Ca, course, deformation, inclination):
        D, angle = course.at(course.end, "D12_inertia"), -course.at(course.end, "angle_deg")
        return [Figure(f"{self.label(Ca)}: D12 by inertia at the end, against an earlier run", D - deformation, 0.002, "", D, deformation, earlier=True),
                Figure(f"{self.label(Ca)}: inclination at the end, against an earlier run", angle - inclination, 0.1, "degrees", angle, inclination, earlier=True)]

    def compared(self, Ca, course, dD, dAngle, dTurn, dArea):
        theirs, label = self.reference(Ca), self.label(Ca)
        end = 0.5 * int(2 * self.scenes[Ca][0] + 1e-6)  # a run that has not reached this strain has no figures
        strains = [EVERY * k for k in range(1, round(end / EVERY) + 1)]
        found = [Figure(f"{label}: D12 by inertia to strain {end:g}, worst", worst(course, theirs, "D12_inertia", strains), dD, "")]
        # Where the cell turns fast, a small delay means a large error of the angle: there the strains are compared.
        for name, degrees in (("a quarter turn", 90), ("half a turn", 180), ("a whole turn", 360)):
            if turn(theirs, degrees) < end:
                found.append(relative(f"{label}: strain of {name}", course.turn(degrees), turn(theirs, degrees), dTurn))
        slow = [t for t in strains if not turn(theirs, 90) < end or at(theirs, t, "angle_deg") < 30]
        mine, their = -course.at(slow[-1], "angle_deg"), -at(theirs, slow[-1], "angle_deg")
        found.append(Figure(f"{label}: inclination to strain {slow[-1]:g}, worst", worst(course, theirs, "angle_deg", slow, -1), dAngle, "degrees"))
        found.append(Figure(f"{label}: inclination at strain {slow[-1]:g}", mine - their, dAngle, "degrees", mine, their))
        area, areaTheirs = 100 * course.area(end), 100 * (at(theirs, end, "area") - 1)
        found.append(Figure(f"{label}: change of area at strain {end:g} (%)", area - areaTheirs, dArea, "points", area, areaTheirs))
        return found + course.kept(label)

    def curves(self, done):
        return self.drawn(done, "D12 by inertia", 0.25, ["set key right center"])
