#!/usr/bin/env python3
"""Red cell: length of the tongue beside Evans' relation and a second method; white cell: suction beside Laplace's law.

Exit code 1 if the white cell deviates by more than 5 % of the suction at L = R, or the red cell's tongue, from 1.3 R on, by more than 15 % of that of the
second method.
"""
import csv
import math

GS, AREA_MODULUS, RED_BORE, RED_LIP = 4e-6, 80e-6, 1e-6, 0.35e-6                # redCell: Gs, area.local [N/m]; radius, half the wall [m]
GLOBAL, REST, WHITE_BORE, WHITE_LIP = 3e-4, 201.5e-12, 2e-6, 0.5e-6             # whiteCell: area.global [N/m], rest [m^2]; the same


def rows(cell):
    with open(f"runs/{cell}/postProcessing/relax/{cell}.csv", newline="") as file:
        return [{key: float(value) for key, value in row.items()} for row in csv.DictReader(line for line in file if not line.startswith("#"))]


class FlatSheet:
    """A flat neo-Hookean disc with an area modulus K, units of Gs and R, drawn over a round lip; axisymmetric, no bending.

    dT1/ds = -(T1 - T2) cos(psi)/rho, dr0/ds = 1/l1, l2 = rho/r0, from a hemispherical cap of tension P R/2 to the free border.
    """

    def __init__(self, modulus, lip, border):
        self.modulus, self.lip, self.border = modulus, lip, border

    def tension(self, along, across):
        return (along - 1 / (along ** 3 * across ** 2)) / across + self.modulus * (along * across - 1)

    def stretch(self, tension, across):
        along = 1 / across
        for _ in range(6):  # Newton
            slope = (1 + 3 / (along ** 4 * across ** 2)) / across + self.modulus * across
            along -= (self.tension(along, across) - tension) / slope
        return along

    def border_tension(self, pressure, covered, parts=60):
        tension, rho, isotropic = 0.5 * pressure, 1.0, 1.0
        for _ in range(20):
            slope = (self.tension(isotropic + 1e-6, isotropic + 1e-6) - self.tension(isotropic, isotropic)) * 1e6
            isotropic -= (self.tension(isotropic, isotropic) - tension) / slope
        r0 = math.sqrt(2) / isotropic

        def go(tension, rho, r0, ds, slope):
            across = rho / r0
            along = self.stretch(tension, across)
            change = (self.tension(along, across) - self.tension(across, along)) * slope / rho * ds
            return tension - change, rho + slope * ds, r0 + ds / along

        for _ in range(parts):
            tension, rho, r0 = go(tension, rho, r0, covered / parts, 0)
        for k in range(parts):
            ds = 0.5 * math.pi * self.lip / parts
            tension, rho, r0 = go(tension, rho, r0, ds, math.sin(0.5 * math.pi * (k + 0.5) / parts))
        while r0 < self.border:
            tension, rho, r0 = go(tension, rho, r0, 0.03, 1)
        return tension

    def length(self, pressure):
        if self.border_tension(pressure, 0) < 0:
            return math.nan  # shorter than a cap on the lip
        low, high = 0.0, 5.0
        for _ in range(25):
            middle = 0.5 * (low + high)
            low, high = (middle, high) if self.border_tension(pressure, middle) > 0 else (low, middle)
        return 1 + self.lip + low


red, compared, bad = rows("redCell"), set(), False
half = math.sqrt(0.5 * red[0]["area_m2"] / math.pi) / RED_BORE  # radius of a disc with half of the cell's area
sheet = FlatSheet(AREA_MODULUS / GS, RED_LIP / RED_BORE, half)
print("red cell; second method: a flat disc of half its area, with the lip and the area modulus")
print(f"{'P R/Gs':>7}  {'L/R':>7}  {'second method':>13}  {'error':>7}  {'P R/Gs by Evans':>15}")
for row in red:
    pressure, x = row["suction_Pa"] * RED_BORE / GS, row["lengthOverRadius"]
    second = sheet.length(pressure)
    if second > 1.3:
        compared.add("red")
        bad = bad or not abs(x / second - 1) <= 0.15
    print(f"{pressure:7.3f}  {x:7.4f}  {second:13.4f}  {x / second - 1:+7.1%}  {2 * x - 1 + math.log(2 * x):15.3f}")

print("white cell; P = 2 T (1/R_cap - 1/R_cell), T = global (A/rest - 1), the cap tangent to the lip")
print(f"{'P [Pa]':>7}  {'L/R':>7}  {'T [uN/m]':>8}  {'Laplace [Pa]':>12}  {'error':>7}")
for row in rows("whiteCell"):
    length, middle = row["length_m"], WHITE_BORE + WHITE_LIP
    tension = GLOBAL * (row["area_m2"] / REST - 1)
    cap = ((length - WHITE_LIP) ** 2 + middle ** 2 - WHITE_LIP ** 2) / (2 * length)
    tongue = math.pi * length ** 2 * (cap - length / 3)
    cell = (3 * (row["volume_m3"] - tongue) / (4 * math.pi)) ** (1 / 3)
    laplace = 2 * tension * (1 / cap - 1 / cell)
    compared.add("white")
    bad = bad or not abs(row["suction_Pa"] - laplace) <= 0.05 * 2 * tension * (1 / WHITE_BORE - 1 / cell)
    print(f"{row['suction_Pa']:7.2f}  {length / WHITE_BORE:7.4f}  {1e6 * tension:8.3f}  {laplace:12.3f}  {row['suction_Pa'] / laplace - 1:+7.1%}")
for cell in {"red", "white"} - compared:
    print(f"of the {cell} cell nothing was compared")
raise SystemExit(bad or len(compared) < 2)
