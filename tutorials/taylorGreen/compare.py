#!/usr/bin/env python3
"""Decay of Taylor-Green vortices against the exact one; exit code 1 when an error exceeds the tolerance.

    u = U sin(kx) cos(kz) exp(-2 nu k^2 t),  w = -U cos(kx) sin(kz) exp(-2 nu k^2 t),   E(t)/E(0) = exp(-4 nu k^2 t),  k = 2 pi/L

exact at any Reynolds number. Error: largest |E/E(0) - exp(-4 nu k^2 t)| over the run. Viscosity: from the time at which the energy
has fallen to 1/e, over the nominal one.

    compare.py CASE...        cases in order of refinement
"""
import csv
import math
import sys

NU, L = 1.0e-6, 1.0e-3  # constant/fluid.yaml, system/mesh.yaml
RATE = 4 * NU * (2 * math.pi / L) ** 2  # 1/s
TOLERANCE = 0.005  # of the finest case, of E(0)


def decay(case):
    """Times and kinetic energies over the first."""
    with open(case + "/postProcessing/balance/conservation.csv") as file:
        lines = (line for line in file if not line.startswith("#"))
        rows = [(float(row["time_s"]), float(row["kineticEnergy_J"])) for row in csv.DictReader(lines)]
    return [(t, energy / rows[0][1]) for t, energy in rows]


def viscosity(points, rate=RATE):
    """Effective viscosity of this decay over the nominal one. rate: nominal decay rate of the energy, in units of the inverse times of the points."""
    for (t0, e0), (t1, e1) in zip(points, points[1:]):
        if e1 <= math.exp(-1):
            return 1 / (rate * (t0 + (t1 - t0) * (math.log(e0) + 1) / math.log(e0 / e1)))
    raise SystemExit("the energy never fell to 1/e: the run is too short")


def main(cases):
    print(f"{'':28s}{'error of E/E(0)':>18s}{'order':>8s}{'viscosity':>12s}")
    before = None
    for case in cases:
        points = decay(case)
        found = [abs(e - math.exp(-RATE * t)) for t, e in points]
        error = max(found) if all(map(math.isfinite, found)) else math.nan
        order = f"{math.log2(before / error):8.2f}" if before else " " * 8
        print(f"{case:28s}{100 * error:16.3f} %{order}{viscosity(points):12.4f}")
        before = error
    good = error <= TOLERANCE
    print(f"{'within' if good else 'OUTSIDE'} the tolerance: {100 * error:.3f} % against {100 * TOLERANCE:g} % in {cases[-1]}")
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
