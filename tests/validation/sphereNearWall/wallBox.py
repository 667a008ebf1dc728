"""Mobility of a sphere in a box that is periodic along two plane walls, minus that near one wall alone, to first order in the sphere's radius.

Velocity at the sphere's centre from the Stokeslets of its images along the wall (Blake's tensor, J. R. Blake, Proc. Camb. Phil. Soc. 70:303 (1971)),
plus the change by the second wall: a sum over wave vectors k of the box, each a solution of Stokes flow between z = 0 and H that is exact in z.
Lengths in a; results over 1/(6 pi mu a).
"""
import math


def images(h, W, towards, reach=40):
    """Sum of the Stokeslets at (i W, j W, h) near a wall at z = 0, without that of the sphere itself."""
    # Farther Stokeslets decrease as 1/s^5 towards the wall, and as 6 h^2/s^3 along it: added is their integral outside the square.
    total = 0.0 if towards else 6 * h**2 * 4 * math.sqrt(2) / ((reach + 0.5) * W**3)
    for i in range(-reach, reach + 1):
        for j in range(-reach, reach + 1):
            if i or j:
                s = W * math.hypot(i, j)
                R = math.hypot(s, 2 * h)
                if towards:
                    total += 1 / s - 1 / R - 2 * h**2 / R**3 - 24 * h**4 / R**5
                else:  # mean over both directions along the wall, which the square lattice allows
                    total += 1.5 / s - 1 / R - (0.5 * s**2 + 2 * h**2) / R**3 + 3 * h**2 * s**2 / R**5
    return 0.75 * total


def solve(matrix, right):
    """Gauss elimination with pivots."""
    rows = [[*row, value] for row, value in zip(matrix, right)]
    for c in range(len(rows)):
        p = max(range(c, len(rows)), key=lambda r: abs(rows[r][c]))
        rows[c], rows[p] = rows[p], rows[c]
        for r in range(len(rows)):
            if r != c:
                factor = rows[r][c] / rows[c][c]
                rows[r] = [x - factor * y for x, y in zip(rows[r], rows[c])]
    return [row[-1] / row[c] for c, row in enumerate(rows)]


def oneWall(k, h, towards):
    """mu times what a wall at 0 adds at h to the velocity of a unit force at h, of wave number k; along the wall the mean over directions of k."""
    x, decay = k * h, math.exp(-2 * k * h) / (4 * k)
    return -decay * (1 + 2 * x + 2 * x**2) if towards else -0.5 * decay * (3 - 2 * x + 2 * x**2)


def twoWalls(k, h, H, towards):
    """The same of walls at 0 and H.

    (D^2 - k^2)^2 w = 0 beside the force, w and Dw zero on the walls; w is the normal velocity; u = -Dw/k along walls and k, both up to a phase.
    Without walls w = (1 + k|s|) exp(-k|s|)/(4 k) of a force towards the wall, s = z - h, and w = -s exp(-k|s|)/4 of one along it. Across k, along
    the walls: (D^2 - k^2) u = 0, u zero on the walls.
    """
    up, near, far, gap = H - h, math.exp(-k * h), math.exp(-k * (H - h)), math.exp(-k * H)
    if towards:  # w and Dw at the walls, in unbounded fluid
        free = [(1 + k * h) * near / (4 * k), k * h * near / 4, (1 + k * up) * far / (4 * k), -k * up * far / 4]
    else:
        free = [h * near / 4, -(1 - k * h) * near / 4, -up * far / 4, -(1 - k * up) * far / 4]
    A, B, C, E = solve([[1, 0, gap, k * H * gap], [-k, k, k * gap, k * (k * H - 1) * gap],
                        [gap, k * H * gap, 1, 0], [-k * gap, k * (1 - k * H) * gap, k, -k]], [-value for value in free])
    if towards:
        return (A + B * k * h) * near + (C + E * k * up) * far
    slope = (-A + B * (1 - k * h)) * near + (C - E * (1 - k * up)) * far  # Dw/k
    return 0.5 * (math.sinh(k * h) * math.sinh(k * up) / (k * math.sinh(k * H)) - 1 / (2 * k) - slope)


def mobility(h, W, H, towards):
    """(images along the wall, second wall)."""
    near = min(h, H - h)
    most = int(25 / near * W / (2 * math.pi)) + 1
    second = 0.0 if towards else -(h**2) / H  # of k = 0: both walls stop a mean flow, one alone does not; none towards them
    for i in range(-most, most + 1):
        for j in range(-most, most + 1):
            k = 2 * math.pi / W * math.hypot(i, j)
            if 0 < k * near < 25:
                second += twoWalls(k, h, H, towards) - oneWall(k, h, towards)
    return images(h, W, towards), 6 * math.pi * second / W**2
