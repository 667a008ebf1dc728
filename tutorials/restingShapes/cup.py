#!/usr/bin/env python3
"""A cup as an OFF file, from which the search for the stomatocyte starts: a shell around a part of a sphere, with a round rim. Lengths in um.

    python3 cup.py > cup.off
"""
import math

MIDDLE, HALF, OPENING = 2.4, 0.95, math.radians(115)  # radius of the shell's middle, half its thickness, angle of the rim from below
SEGMENTS, RINGS = 48, 60


def profile(t):
    """(rho, z) along the meridian, from t = 0 at the bottom of the outer side, over the rim, to t = 1 on the inner side."""
    outer, inner = (MIDDLE + HALF) * OPENING, (MIDDLE - HALF) * OPENING
    rim = math.pi * HALF
    s = t * (outer + rim + inner)
    if s < outer:
        angle = s / (MIDDLE + HALF)
        return (MIDDLE + HALF) * math.sin(angle), -(MIDDLE + HALF) * math.cos(angle)
    if s < outer + rim:
        turn = (s - outer) / HALF
        rho, z = MIDDLE * math.sin(OPENING), -MIDDLE * math.cos(OPENING)
        return rho + HALF * math.sin(OPENING + turn), z - HALF * math.cos(OPENING + turn)
    angle = OPENING - (s - outer - rim) / (MIDDLE - HALF)
    return (MIDDLE - HALF) * math.sin(angle), -(MIDDLE - HALF) * math.cos(angle)


points = [(0.0, 0.0, profile(0)[1])]
for ring in range(1, RINGS):
    rho, z = profile(ring / RINGS)
    points += [(rho * math.cos(a), rho * math.sin(a), z) for a in (2 * math.pi * k / SEGMENTS for k in range(SEGMENTS))]
points.append((0.0, 0.0, profile(1)[1]))
last = len(points) - 1
triangles = []
for k in range(SEGMENTS):
    nxt = (k + 1) % SEGMENTS
    triangles.append((0, 1 + nxt, 1 + k))
    triangles.append((last, last - SEGMENTS + k, last - SEGMENTS + nxt))
    for ring in range(RINGS - 2):
        a, b = 1 + ring * SEGMENTS, 1 + (ring + 1) * SEGMENTS
        triangles += [(a + k, a + nxt, b + nxt), (a + k, b + nxt, b + k)]
print(f"OFF\n{len(points)} {len(triangles)} 0")
print("\n".join("{:.6f} {:.6f} {:.6f}".format(*p) for p in points))
print("\n".join("3 {} {} {}".format(*t) for t in triangles))
