#!/usr/bin/env python3
"""Start-up of plane Couette flow against its series; exit code 1 when an error exceeds the tolerance.

    u/U = 2 eta + sum_{n>=1} 2/(n pi) (-1)^n sin(2 n pi eta) exp(-4 n^2 pi^2 nu t/L^2),   eta = z/L in (-1/2, 1/2)

walls at z = +-L/2 moving with +-U from t = 0. Error: root of the mean square over the layers, over that of the series.

    compare.py CASE...        cases in order of refinement
"""
import csv
import math
import sys

NU, L, U = 1.0e-6, 1.0e-3, 6.25e-6  # constant/fluid.yaml, system/mesh.yaml, constant/flow.yaml
TIMES = (0.0225, 0.045, 0.1125, 0.225)  # s, of Morris, Fox and Zhu (1997)
TOLERANCE = 0.002  # of the finest case, at every one of these times


def series(z, t):
    eta, decay = z / L, 4 * math.pi**2 * NU * t / L**2
    terms = (2 / (n * math.pi) * (-1) ** n * math.sin(2 * n * math.pi * eta) * math.exp(-n * n * decay) for n in range(1, 200))
    return U * (2 * eta + math.fsum(terms))


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
