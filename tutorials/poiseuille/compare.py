#!/usr/bin/env python3
"""Start-up of plane Poiseuille flow against its series; exit code 1 when an error exceeds the tolerance.

    u = F L^2/nu [ y (1 - y)/2 - sum_{n>=0} 4/((2n+1)^3 pi^3) sin((2n+1) pi y) exp(-(2n+1)^2 pi^2 nu t/L^2) ],   y = z/L + 1/2

walls at z = +-L/2 at rest, force F per unit mass from t = 0. Error: root of the mean square over the layers, over that of the series.

    compare.py CASE...        cases in order of refinement
"""
import csv
import math
import sys

NU, L, F = 1.0e-6, 1.0e-3, 1.0e-4  # constant/fluid.yaml, system/mesh.yaml, constant/flow.yaml
TIMES = (0.05, 0.1, 0.2, 0.5)  # s
TOLERANCE = 0.002  # of the finest case, at every one of these times


def series(z, t):
    y, decay = z / L + 0.5, math.pi**2 * NU * t / L**2
    terms = (4 / (n * math.pi) ** 3 * math.sin(n * math.pi * y) * math.exp(-n * n * decay) for n in range(1, 200, 2))
    return F * L**2 / NU * (0.5 * y * (1 - y) - math.fsum(terms))


def errors(case):
    """Relative error at the first output at or after each of TIMES."""
    with open(case + "/postProcessing/profile/profile.csv") as file:
        rows = [{k: float(v) for k, v in row.items()} for row in csv.DictReader(line for line in file if not line.startswith("#"))]
    result = []
    for time in TIMES:
        t = min(row["time_s"] for row in rows if row["time_s"] >= time * (1 - 1e-9))  # steps add up to it except for rounding
        pairs = [(row["u_m_s"], series(row["position_m"], t)) for row in rows if row["time_s"] == t]
        result.append(math.sqrt(sum((u - e) ** 2 for u, e in pairs) / sum(e * e for _, e in pairs)))
    return result


def main(cases):
    print("relative error of u" + " " * 9 + "".join(f"  t {t:6.4f} s" for t in TIMES))
    table = [errors(case) for case in cases]
    for case, row in zip(cases, table):
        print(f"{case:28s}" + "".join(f"{100 * e:10.3f} %" for e in row))
    for first, second in zip(table, table[1:]):
        print(f"{'  order':28s}" + "".join(f"{math.log2(a / b):10.2f}  " for a, b in zip(first, second)))
    good = all(error <= TOLERANCE for error in table[-1])
    print(f"{'within' if good else 'OUTSIDE'} the tolerance: {100 * max(table[-1]):.3f} % against {100 * TOLERANCE:g} % in {cases[-1]}")
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
