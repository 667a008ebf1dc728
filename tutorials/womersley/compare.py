#!/usr/bin/env python3
"""The flow rate of the last beat beside Womersley's solution for the same pressure gradient; writes postProcessing/womersley.csv for plot.gp.

A harmonic F exp(i omega t) of the force per mass drives the flow rate
    Q = pi R^2 F/(i omega) [1 - 2 J1(z)/(z J0(z))] exp(i omega t),   z = alpha i^(3/2), alpha = R sqrt(omega/nu)
through a round tube (Womersley, J. Physiol. 127 (1955) 553), and the mean force F0 drives pi R^4 F0/(8 nu). Exit code 1 if the largest
difference is above the tolerance.

    compare.py [TOLERANCE]        of the largest flow rate; 0.02 if not given
"""
import cmath
import csv
import math
import sys

NU, R, F = 3.5e-3 / 1060, 2e-3, 0.1  # constant/fluid.yaml, constant/flow.yaml
PERIOD = 1 / 1.2  # s, constant/beat.csv
TOLERANCE = float(sys.argv[1]) if len(sys.argv) > 1 else 0.02
HARMONICS = 12
COLUMNS = ("time_s", "drive", "flowRate_mL_s", "exact_mL_s")  # of womersley.csv


def rows(path):
    with open(path) as text:
        return [{key: float(value or "nan") for key, value in row.items()} for row in csv.DictReader(line for line in text if not line.startswith("#"))]


def bessel(order, z):
    """J0 or J1 by the power series."""
    return sum((-1) ** m / (math.factorial(m) * math.factorial(m + order)) * (z / 2) ** (2 * m + order) for m in range(60))


def response(n):
    """Flow rate over the force of harmonic n [m^2 s]."""
    if n == 0:
        return math.pi * R**4 / (8 * NU)
    omega = 2 * math.pi * n / PERIOD
    z = R * math.sqrt(omega / NU) * cmath.exp(0.75j * math.pi)
    return math.pi * R**2 / (1j * omega) * (1 - 2 * bessel(1, z) / (z * bessel(0, z)))


beat = [row["factor"] for row in rows("constant/beat.csv")[:-1]]
force = [2 * F / len(beat) * sum(f * cmath.exp(-2j * math.pi * n * k / len(beat)) for k, f in enumerate(beat)) for n in range(HARMONICS)]
force[0] /= 2


def womersley(t):
    return sum((response(n) * force[n] * cmath.exp(2j * math.pi * n * t / PERIOD)).real for n in range(HARMONICS))


table = [row for row in rows("postProcessing/flow/flowRate.csv") if row["time_s"] > 0]
last = [row for row in table if row["time_s"] > table[-1]["time_s"] - PERIOD]
with open("postProcessing/womersley.csv", "w") as out:
    print(*COLUMNS, sep=",", file=out)
    for row in table:
        print(f"{row['time_s']:.6g},{row['pressureDrop_Pa']:.6g},{1e6 * row['flowRate_m3_s']:.6g},{1e6 * womersley(row['time_s']):.6g}", file=out)
most = max(abs(womersley(row["time_s"])) for row in last)
error = max(abs(row["flowRate_m3_s"] - womersley(row["time_s"])) for row in last) / most
mean = sum(row["flowRate_m3_s"] for row in last) / len(last)
print(f"alpha {R * math.sqrt(2 * math.pi / PERIOD / NU):.2f}; flow rate of the last beat: mean {1e6 * mean:.3f} mL/s, exact {1e6 * response(0) * force[0].real:.3f}; "
      f"largest {1e6 * max(row['flowRate_m3_s'] for row in last):.3f}, exact {1e6 * max(womersley(row['time_s']) for row in last):.3f}")
print(f"largest difference {100 * error:.2f} % of the largest flow rate; {'within' if error <= TOLERANCE else 'OUTSIDE'} {100 * TOLERANCE:g} %")
sys.exit(0 if error <= TOLERANCE else 1)
