"""A spherical capsule whose inside is more or less viscous than the fluid around it, in shear flow, against boundary elements with both fluids."""
import math

from capsules import STRAIN, Capsules
from suite import Figure, at, relative, worst

TITLE = "capsule in shear flow, another viscosity inside"
ACROSS = "particles along the radius"
RESOLUTIONS = (6, 8, 12)
UNBOUNDED = True
ALLOWED = {6: (5, 1.5), 8: (4, 1.2), 12: (2, 1)}  # % of D12, degrees; at the finest the aim
MISSED = {12: {"*: D12 *": 2.8}}
STRAINS = [0.1 * k for k in range(5, 10 * STRAIN + 1)]

capsules = Capsules("capsuleViscosity", ("0.2", "5"), ["constant/flow.yaml:/Ca=0.3", "constant/membranes.yaml:/capsule/triangles={type: neoHookean, Gs: 1e-5 N/m}"],
                    varied=("ratio", "constant/membranes.yaml:/capsule/interior/viscosityRatio"))
runs = capsules.runs


def figures(done, n):
    found = []
    for ratio, course in capsules.courses(done):
        label, theirs, (allowed, degrees) = capsules.label(ratio), capsules.reference(ratio), ALLOWED.get(n, ALLOWED[12])
        error = worst(course.at(t, "D12_inertia") / at(theirs, t, "D12_inertia") - 1 for t in STRAINS)
        found.append(Figure(f"{label}: D12 from strain {STRAINS[0]:g} to {STRAIN}, worst", 100 * error, allowed))
        for strain in (1, STRAIN):
            found.append(relative(f"{label}: D12 at strain {strain}", course.at(strain, "D12_inertia"), at(theirs, strain, "D12_inertia"), allowed))
            mine, their = math.degrees(course.at(strain, "inclination_rad")), at(theirs, strain, "inclination_deg")
            found.append(Figure(f"{label}: inclination at strain {strain}", mine - their, degrees, "degrees", mine, their))
        found += course.kept(label)
    return found


def curves(done):
    return capsules.drawn(done, "D12 by inertia", 0.2, ["set key right bottom", "set yrange [0:]"])
