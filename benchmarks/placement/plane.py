#!/usr/bin/python3
"""A flat membrane between two fluids on a lattice of particles: what its place between two layers of particles does to its nodes.

    plane.py [-viscosityRatio 1] [-R 2.5] [-weights moments|kink] [-mean side|laminate]

The flow is along the membrane and varies across it, so that sums over particles are sums over their layers, and the exact flow has straight lines
that meet at the membrane. Lengths in spacings, viscosity outside 1, support 2.4, Wendland C2, viscosity as in libs/sph/operators.hpp: a sum over
pairs with the viscosity outside, and an excess stress by the gradient. Errors, at ten places between two layers:
    film   jump of the line outside over the line inside at the membrane, for a shear stress of 1 and no load
    cross  velocity of a node in this flow
    self   velocity of a node whose load of 1 per area is spread by the nodes' weights
Weights of nodes within R, by least squares with W: sum w = 1, sum w q = 0, and
    moments   sum w q^2 = s (libs/coupling/nodeFluidMap.hpp)
    kink      sum w phi(z/R) = v and sum w (q^2 - z^2/R^2) = 0, z across the membrane, phi(z) = E|z - y|, y distributed as the sums over planes of
              weights W (c0 + c2 q^2) with the second moment 0.1; then a part t H of the gradient across is added.
Excess viscosity of a layer, whose share f inside is that of its thickness:
    side      (ratio - 1) where its particles are inside, 0 elsewhere
    laminate  harmonic mean of the viscosities by p - kappa (1 - 1/ratio)^2 p (1 - p)/(1 - p + p/ratio)^2 - 1, p the mean of f over the kernel
s, or v, t, kappa, are those for which the means over all places are 0. Needs Debian's python3-numpy.
"""
import argparse
import sys

import numpy as np

SUPPORT, REACH, LAYERS, ENDS = 2.4, 3, 40, 8
z = np.arange(-LAYERS, LAYERS + 1.0)
plane2 = np.add.outer(np.arange(-REACH, REACH + 1.0) ** 2, np.arange(-REACH, REACH + 1.0) ** 2).ravel()
W = lambda q: np.where(q < 1, (1 - q) ** 4 * (1 + 4 * q), 0.0)
F = lambda q: np.where(q < 1, (1 - q) ** 3, 0.0)


def sums(f):
    """Sums over the particles of a layer at each distance, of a function of r over the support."""
    return np.array([f(np.sqrt(plane2 + k * k) / SUPPORT).sum() for k in range(REACH + 1)])


def operators():
    """Matrices of the pairwise viscosity and of the gradient, for unit viscosity and exact for straight lines."""
    a = sums(F)
    a[0] = 0
    a /= (a * np.arange(REACH + 1) ** 2).sum()
    pairs, gradient = np.zeros((z.size, z.size)), np.zeros((z.size, z.size))
    for i in range(z.size):
        for k in range(1, REACH + 1):
            if i + k < z.size:
                pairs[[i, i + k], [i, i + k]] += a[k]
                pairs[[i, i + k], [i + k, i]] -= a[k]
            if REACH <= i < z.size - REACH:
                gradient[i, i + k] += 0.5 * k * a[k]
                gradient[i, i - k] -= 0.5 * k * a[k]
    return pairs, gradient


PAIRS, GRADIENT = operators()


def kink():
    """The function phi of z/R, tabulated."""
    q = np.linspace(0, 1, 4001)
    moment = lambda k: np.trapz(q ** (2 + k) * W(q), q) * 4 * np.pi
    c0, c2 = np.linalg.solve([[moment(0), moment(2)], [moment(2), moment(4)]], [1, 0.1])
    part = q * W(q) * (c0 + c2 * q**2)
    below = np.concatenate([[0], np.cumsum(0.5 * (part[1:] + part[:-1]))])
    y = np.linspace(-1, 1, 2001)
    share = np.interp(abs(y), q, below[-1] - below)
    share /= share.sum()
    table = np.linspace(0, 1, 501)
    values = [(abs(at - y) * share).sum() for at in table]
    return lambda x: np.interp(abs(x), table, values)


def weights(place, R, conditions, count):
    """Sums over layers of weights with 1 for one of the conditions and 0 for the others; mean over 36 places along the membrane."""
    found = np.zeros((count, z.size))
    along, across = np.arange(-REACH, REACH + 2.0), np.arange(np.floor(place - R), np.ceil(place + R) + 1)
    for x in (np.arange(6) + 0.5) / 6:
        for y in (np.arange(6) + 0.5) / 6:
            q = np.array([(i - x, j - y, k - place) for i in along for j in along for k in across]) / R
            layer = np.rint(q[:, 2] * R + place).astype(int) + LAYERS
            C, w = conditions(q), W(np.linalg.norm(q, axis=1))
            for row, coefficients in enumerate(np.linalg.inv(C.T @ (w[:, None] * C))):
                np.add.at(found[row], layer, w * (C @ coefficients) / 36)
    return found


def pinned(matrix, force, u):
    """Velocities in equilibrium, with those at both ends prescribed by u."""
    free, u = slice(ENDS, -ENDS), u.copy()
    ends = np.r_[0:ENDS, z.size - ENDS : z.size]
    u[free] = np.linalg.solve(matrix[free, free], force[free] - matrix[free][:, ends] @ u[ends])
    return u


class Plane:
    def __init__(self, ratio, R, kind, mean):
        self.ratio, self.kind, self.mean, self.step = ratio, kind, mean, SUPPORT / R
        phi = kink()
        square = lambda q: (q**2).sum(1)
        conditions = {"moments": lambda q: np.column_stack([np.ones(len(q)), q, square(q)]),
                      "kink": lambda q: np.column_stack([np.ones(len(q)), q, phi(q[:, 2]), square(q) - q[:, 2] ** 2])}[kind]
        self.places = np.arange(10) / 10 + 1e-6
        self.weights = [weights(place, R, conditions, {"moments": 5, "kink": 6}[kind]) for place in self.places]

    def excess(self, place, kappa):
        inside = np.clip(0.5 + place - z, 0, 1)
        if self.mean == "side":
            return (self.ratio - 1) * (z < place)
        w = sums(W)
        p = np.convolve(np.pad(inside, REACH, mode="edge"), np.concatenate([w[:0:-1], w]) / (2 * w.sum() - w[0]), "valid")
        resistance = p / self.ratio + 1 - p
        return 1 / resistance - 1 - kappa * ((1 - 1 / self.ratio) / resistance) ** 2 * p * (1 - p)

    def errors(self, x):
        """Rows: film, cross, self at each place."""
        rows = []
        for place, w in zip(self.places, self.weights):
            second, t, kappa = x
            matrix = PAIRS + GRADIENT.T @ (self.excess(place, kappa)[:, None] * GRADIENT)
            node = w[0] + second * w[4] + t * self.step * w[3]
            inside, outside = (z - place) / self.ratio * (z < place), (z - place) * (z >= place)
            shear, shifted = (pinned(matrix, 0 * z, inside + outside + k * (z >= place)) for k in (0, 1))
            stress = lambda u: (matrix @ u)[-ENDS:].sum()  # at the outer end; it is 1 for a straight line
            film = ((PAIRS @ z)[-ENDS:].sum() - stress(shear)) / (stress(shifted) - stress(shear))
            rows.append((film, node @ shear, node @ pinned(matrix, node, 0.5 * (inside - outside))))
        return np.array(rows)

    def calibrated(self):
        """(s or v, t, kappa) and the errors, by Newton's method on their means."""
        x = np.array([{"moments": -0.04, "kink": 0.16}[self.kind], 0.0, 0.3])
        # With `moments` no parameter acts on the cross error, with `side` none on the film error.
        solved = {"moments": [2], "kink": [2, 1] if self.ratio != 1 else [2]}[self.kind] + ([0] if self.mean == "laminate" and self.ratio != 1 else [])
        unknown = [{2: 0, 1: 1, 0: 2}[row] for row in solved]
        for _ in range(12):
            here = self.errors(x).mean(0)
            if max(abs(here[solved])) < 1e-6:
                break
            slopes = [(self.errors(x + 1e-4 * np.eye(3)[k]).mean(0) - here)[solved] / 1e-4 for k in unknown]
            x[unknown] -= np.linalg.solve(np.array(slopes).T, here[solved])
        else:
            sys.exit(f"plane: no constants found at the ratio of viscosities {self.ratio:g}: mean errors are still {here[solved]}")
        return x, self.errors(x)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("-viscosityRatio", type=float, default=1)
    parser.add_argument("-R", type=float, default=2.5)
    parser.add_argument("-weights", choices=("moments", "kink"), default="moments")
    parser.add_argument("-mean", choices=("side", "laminate"), default="side")
    words = parser.parse_args()
    x, found = Plane(words.viscosityRatio, words.R, words.weights, words.mean).calibrated()
    print(f"second condition {x[0]:.4f}, t {x[1]:.4f}, kappa {x[2]:.4f}")
    for name, values in zip(("film", "cross", "self"), found.T):
        print(f"{name:6s} mean {values.mean():+.4f}  from {values.min():+.4f} to {values.max():+.4f}")
