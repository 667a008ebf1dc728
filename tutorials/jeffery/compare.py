#!/usr/bin/env python3
"""Free sphere and spheroid in shear flow against Jeffery; exit code 1 when an error exceeds the tolerance.

    compare.py RUNS        RUNS: folder with sphere, gradient, flow and, if it has been run, turn

Axis ratio r = c/a = 0.5, axis in the shear plane at phi from the direction of the gradient, towards the flow (Jeffery, Proc. R. Soc. A
102:161, 1922):
    dphi/dt = gammadot/(r^2 + 1) (r^2 cos^2 phi + sin^2 phi),   tan phi = r tan(gammadot t/(r + 1/r)),   period 2 pi (r + 1/r)/gammadot
The rate has the form alpha cos^2 phi + beta sin^2 phi for any body of revolution; two runs, with the axis near the gradient and near the
flow, give alpha and beta, and these the period 2 pi/sqrt(alpha beta). Rates are means over the strains from START on.
"""
import csv
import math
import os
import sys

RATE, R = 100.0, 0.5  # 1/s, constant/flow.yaml; axis ratio
START = 0.2           # strain; before it the flow around the body is still developing
TOLERANCE = 0.03


def jeffery(phi):
    return (R**2 * math.cos(phi) ** 2 + math.sin(phi) ** 2) / (R**2 + 1)


def motion(case):
    """Strain, phi without jumps, and angular velocity about y over gammadot, row by row."""
    rows, phi = [], None
    with open(case + "/postProcessing/motion/body.csv") as file:
        for row in csv.DictReader(line for line in file if not line.startswith("#")):
            angle = math.atan2(float(row["axis_x"]), float(row["axis_z"]))
            phi = angle if phi is None else angle + 2 * math.pi * round((phi - angle) / (2 * math.pi))
            rows.append((float(row["strain"]), phi, float(row["angularVelocity_y_1_s"]) / RATE))
    return rows


def late(case):
    """Mean phi and mean rate from START on."""
    rows = [row for row in motion(case) if row[0] >= START]
    return sum(r[1] for r in rows) / len(rows), sum(r[2] for r in rows) / len(rows)


def alpha_beta(one, other):
    (phi1, rate1), (phi2, rate2) = one, other
    c1, s1, c2, s2 = math.cos(phi1) ** 2, math.sin(phi1) ** 2, math.cos(phi2) ** 2, math.sin(phi2) ** 2
    determinant = c1 * s2 - c2 * s1
    return (rate1 * s2 - rate2 * s1) / determinant, (c1 * rate2 - c2 * rate1) / determinant


def quarter(rows):
    """Strain at which phi passes a right angle."""
    for (t0, a, _), (t1, b, _) in zip(rows, rows[1:]):
        if a < math.pi / 2 <= b:
            return t0 + (math.pi / 2 - a) / (b - a) * (t1 - t0)
    return None


def main(runs):
    table = [("sphere: angular velocity/gammadot", late(f"{runs}/sphere")[1], 0.5)]
    ends = [late(f"{runs}/{name}") for name in ("gradient", "flow")]
    for name, (phi, rate) in zip(("gradient", "flow"), ends):
        table.append((f"spheroid, axis near the {name}, phi = {math.degrees(phi):5.1f} deg: rate/gammadot", rate, jeffery(phi)))
    alpha, beta = alpha_beta(*ends)
    table.append(("spheroid: period x gammadot, from both rates", 2 * math.pi / math.sqrt(alpha * beta), 2 * math.pi * (R + 1 / R)))
    if os.path.exists(f"{runs}/turn/postProcessing/motion/body.csv"):
        strain = quarter(motion(f"{runs}/turn")) or math.nan
        table.append(("spheroid, 8 along its axis: four quarter turns x gammadot", 4 * strain, 2 * math.pi * (R + 1 / R)))
    print(f"{'':70s}   measured     Jeffery    error")
    errors = [abs(value / exact - 1) for _, value, exact in table]
    for name, value, exact in table:
        print(f"{name:70s} {value:10.4f}  {exact:10.4f}  {100 * (value / exact - 1):+6.2f} %")
    good = all(error <= TOLERANCE for error in errors)  # false for nan: a spheroid that has not turned
    print(f"{'within' if good else 'OUTSIDE'} the tolerance: {100 * max(errors):.2f} % against {100 * TOLERANCE:g} %")
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
