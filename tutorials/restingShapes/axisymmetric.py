#!/usr/bin/env python3
"""Vesicles of least bending energy by the axisymmetric shape equations: the second method for restingShapes.

    python3 axisymmetric.py [REDUCED_VOLUME ...]

Least kappa/2 Int (c1 + c2)^2 dA at given area and volume, among oblate shapes that are even in z. Along the arc length s from the pole, with
the meridian's angle psi, u = dpsi/ds, the distance x from the axis, pressure p and tension t over kappa, and gamma, the multiplier of
x' = cos psi (Seifert, Berndl and Lipowsky, Phys. Rev. A 44, 1182 (1991), c0 = 0; equations recalled, their solution has its own check):

    psi' = u,   x' = cos psi
    u'     = -u cos psi/x + cos psi sin psi/x^2 + gamma sin psi/x + p x cos psi/2
    gamma' = u^2/2 - sin^2 psi/(2 x^2) + p x sin psi + t

Pole: psi = x = gamma = 0. Equator, s = S: psi = pi/2, gamma = 0, area 2 pi, volume nu 2 pi/3. Unknown: u at the pole, p, t, S; Newton's
method with derivatives by differences, from near the sphere towards smaller nu. Check: E does not change with size, so 3 p V + 2 t A = 0 in the
convention of these equations. Energies are over 8 pi kappa.
"""
import math
import sys

STEPS = 500


def rates(y, p, t):
    psi, u, gamma, x = y[:4]
    sine, cosine = math.sin(psi), math.cos(psi)
    return (u,
            -u * cosine / x + cosine * sine / (x * x) + gamma * sine / x + 0.5 * p * x * cosine,
            0.5 * u * u - 0.5 * (sine / x) ** 2 + p * x * sine + t,
            cosine,
            2 * math.pi * x,                       # area
            math.pi * x * x * sine,                # volume
            0.25 * (u + sine / x) ** 2 * x)        # energy: that of both halves


def shoot(unknown):
    """psi, u, gamma, x, area, volume, energy at the equator."""
    u0, p, t, length = unknown
    s = 1e-4 * length
    y = [u0 * s, u0, t * s, s, math.pi * s * s, 0.25 * math.pi * u0 * s ** 4, 0.5 * u0 * u0 * s * s]  # next to the pole
    h = (length - s) / STEPS
    for _ in range(STEPS):  # Runge-Kutta of fourth order
        k1 = rates(y, p, t)
        k2 = rates([a + 0.5 * h * b for a, b in zip(y, k1)], p, t)
        k3 = rates([a + 0.5 * h * b for a, b in zip(y, k2)], p, t)
        k4 = rates([a + h * b for a, b in zip(y, k3)], p, t)
        y = [a + h / 6 * (b + 2 * c + 2 * d + e) for a, b, c, d, e in zip(y, k1, k2, k3, k4)]
    return y


def residual(unknown, nu):
    psi, _, gamma, _, area, volume, _ = shoot(unknown)
    return [psi - 0.5 * math.pi, gamma, area / (2 * math.pi) - 1, volume / (2 * math.pi / 3) - nu]


def solve(matrix, right):
    """Gaussian elimination with pivoting."""
    rows = [row + [b] for row, b in zip(matrix, right)]
    n = len(rows)
    for k in range(n):
        best = max(range(k, n), key=lambda r: abs(rows[r][k]))
        rows[k], rows[best] = rows[best], rows[k]
        for r in range(k + 1, n):
            factor = rows[r][k] / rows[k][k]
            rows[r] = [a - factor * b for a, b in zip(rows[r], rows[k])]
    x = [0.0] * n
    for k in reversed(range(n)):
        x[k] = (rows[k][n] - sum(rows[k][j] * x[j] for j in range(k + 1, n))) / rows[k][k]
    return x


def newton(unknown, nu):
    unknown = list(unknown)
    for _ in range(40):
        r = residual(unknown, nu)
        if max(map(abs, r)) < 1e-9:
            return unknown
        columns = []
        for k in range(4):
            step = 1e-6 * max(1.0, abs(unknown[k]))
            moved = unknown[:]
            moved[k] += step
            columns.append([(a - b) / step for a, b in zip(residual(moved, nu), r)])
        change = solve([[columns[k][i] for k in range(4)] for i in range(4)], [-a for a in r])
        scale = min(1.0, 0.3 / max(abs(c) / max(1.0, abs(u)) for c, u in zip(change, unknown)))
        unknown = [u + scale * c for u, c in zip(unknown, change)]
    raise RuntimeError(f"no shape found at the reduced volume {nu}")


def oblate(nu):
    """Energy over 8 pi kappa, diameter over that of the sphere of the same area, and the check's error."""
    unknown, at = newton((0.75, -6.0, 3.0, 1.57), 0.97), 0.97
    while at > nu:
        at = max(nu, at - 0.03)
        unknown = newton(unknown, at)
    y = shoot(unknown)
    p, t = unknown[1], unknown[2]
    return y[6], y[3], abs(3 * p * y[5] + 2 * t * y[4]) / abs(2 * t * y[4])


if __name__ == "__main__":
    for nu in [float(a) for a in sys.argv[1:]] or [0.642]:
        print("nu {}: energy {:.5f}, diameter {:.5f}, check {:.1e}".format(nu, *oblate(nu)))
