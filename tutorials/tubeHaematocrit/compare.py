#!/usr/bin/env python3
"""Apparent viscosity and haematocrit of blood in a tube, beside formulas for blood in glass tubes and the two-layer model.

    compare.py CASE DIAMETER FROM      DIAMETER in um; FROM: time from which on means are taken, ms

Apparent viscosity, D in um, at the discharge haematocrit HD (Pries, Neuhaus, Gaehtgens, Am. J. Physiol. 263:H1770, 1992):
    mu45 = 220 exp(-1.3 D) + 3.2 - 2.44 exp(-0.06 D^0.645),   w = 1/(1 + 1e-11 D^12),   C = (0.8 + exp(-0.075 D)) (w - 1) + w
    mu/mu_plasma = 1 + (mu45 - 1) ((1 - HD)^C - 1)/((1 - 0.45)^C - 1)
Tube over discharge haematocrit (Pries, Secomb, Gaehtgens, Gross, Circ. Res. 67:826, 1990):
    HT/HD = HD + (1 - HD) (1 + 1.7 exp(-0.415 D) - 0.6 exp(-0.011 D))
Two layers: a core of viscosity mu_c and of the radius s R, s = 1 - d/R, in a layer of plasma as thick as the cell-free layer d. The apparent viscosity
mu gives mu_c, and with m = mu_plasma/mu_c the haematocrits:
    mu_plasma/mu = 1 - s^4 (1 - m),   HD/HT = (2 (1 - s^2) + m s^2)/(1 - s^4 (1 - m))
"""
import csv
import math
import sys


def viscosity(D, HD):
    mu45 = 220 * math.exp(-1.3 * D) + 3.2 - 2.44 * math.exp(-0.06 * D**0.645)
    w = 1 / (1 + 1e-11 * D**12)
    C = (0.8 + math.exp(-0.075 * D)) * (w - 1) + w
    return 1 + (mu45 - 1) * ((1 - HD) ** C - 1) / (0.55**C - 1)


def fahraeus(D, HD):
    return HD + (1 - HD) * (1 + 1.7 * math.exp(-0.415 * D) - 0.6 * math.exp(-0.011 * D))


def twoLayers(mu, s):
    """Apparent viscosity, HD/HT and mu_plasma/mu_c of a core of the radius s R with which the apparent viscosity is mu, or nearest to it."""
    m = max(1 - (1 - 1 / mu) / s**4, 0)  # 0: a core that is not sheared at all
    apparent = 1 / (1 - s**4 * (1 - m))
    return apparent, (2 * (1 - s**2) + m * s**2) * apparent, m


def means(path, start):
    with open(path) as file:
        rows = [{key: float(value) for key, value in row.items()} for row in csv.DictReader(line for line in file if not line.startswith("#"))]
    rows = [row for row in rows if row["time_s"] >= start] or rows[-1:]
    return {key: sum(row[key] for row in rows) / len(rows) for key in rows[0]}


def main():
    case, D, start = sys.argv[1], float(sys.argv[2]), 1e-3 * float(sys.argv[3])
    flow = means(case + "/postProcessing/flow/flowRate.csv", start)
    d = 1e6 * means(case + "/postProcessing/layer/cellFreeLayer.csv", start)["thickness_m"]
    mu, HT, HD = flow["relativeViscosity"], flow["haematocrit_tube"], flow["haematocrit_discharge"]
    apparent, ratio, m = twoLayers(mu, 1 - d / (0.5 * D))
    print(f"tube, discharge haematocrit                {HT:.4f}, {HD:.4f}")
    print(f"apparent viscosity over that of plasma     {mu:.4f}   glass tubes {viscosity(D, HD):.4f} ({100 * (mu / viscosity(D, HD) - 1):+.1f} %)")
    print(f"tube over discharge haematocrit            {HT / HD:.4f}   glass tubes {fahraeus(D, HD):.4f} ({100 * (HT / HD / fahraeus(D, HD) - 1):+.1f} %)")
    print(f"cell-free layer                            {d:.3f} um")
    print(f"viscosity of plasma over that of the core   {m:.2f}     apparent viscosity then {apparent:.4f} ({100 * (mu / apparent - 1):+.1f} %)")
    print(f"discharge over tube haematocrit            {HD / HT:.4f}   two layers {ratio:.4f} ({100 * (HD / HT / ratio - 1):+.1f} %)")


if __name__ == "__main__":
    main()
