#!/usr/bin/python3
"""The flows of couette, poiseuille and taylorGreen2D by PySPH (Debian: python3-pysph, with its own python3), for a line in the diagrams.

    pysphPeer.py CASE PARTICLES FOLDER [-dimensions 2|3] [-steps COUNT]     PARTICLES: across the gap or in a wavelength

Same viscosity, spacing, walls, looks and end time as the case, and the box of it: a slice of 8 dx across and, between plates, along the flow. In two
dimensions the direction across is left out, which Corpuscle cannot do. All else is as in PySPH's own examples of these flows (couette.py,
poiseuille.py, taylor_green.py): TVFScheme, quintic spline with h = dx, its integrator, five layers of wall, sound at ten times the largest velocity,
and the smallest of their three limits of the step. FOLDER gets what the case's compare.py reads, and run.json: processor seconds of the loop,
without reading, compiling and results. -steps: so many steps only, for the cost of one.
"""
import argparse
import csv
import json
import math
import os
import pathlib
import sys
import tempfile
import time
from dataclasses import dataclass

for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS"):
    os.environ[name] = "1"

import numpy
from pysph.base.nnps import DomainManager
from pysph.base.utils import get_particle_array
from pysph.solver.application import Application
from pysph.sph.scheme import TVFScheme

NU, L, RHO = 1.0, 1.0, 1.0  # mm^2/s, mm, any: constant/fluid.yaml of the tutorials
ACROSS = 8  # particles along a periodic direction whose length is arbitrary
LAYERS = 5  # of wall particles
TO_METRES = 1e-3


@dataclass
class Flow:
    end: float  # s
    every: float  # s, between outputs
    fastest: float  # mm/s
    walls: float = 0.0  # mm/s, speed of the upper wall; the lower one moves the opposite way
    force: float = 0.0  # mm/s^2
    plates: bool = True


COUETTE_U, FORCE, VORTEX_U = 6.25e-3, 0.1, 10.0  # constant/flow.yaml
FLOWS = {
    "couette": Flow(0.225, 0.0225, COUETTE_U, walls=COUETTE_U),
    "poiseuille": Flow(0.5, 0.05, FORCE * L**2 / (8 * NU), force=FORCE),
    "taylorGreen2D": Flow(0.02, 0.0005, VORTEX_U, plates=False)}


class Peer(Application):
    """x along the flow or a wavelength, y across the gap or the other wavelength, z across the slice."""

    def __init__(self, flow, n, dimensions, results):
        self.flow, self.n, self.dx, self.dim = flow, n, L / n, dimensions
        self.looks, self.next = [], 0.0
        self.sound = 10 * flow.fastest
        limits = [0.25 * self.dx / (self.sound + flow.fastest), 0.125 * self.dx**2 / NU]
        if flow.force:
            limits.append(0.25 * math.sqrt(self.dx / flow.force))
        self.step = min(limits)
        super().__init__(fname="pysphPeer", output_dir=results)

    def create_domain(self):
        narrow = ACROSS * self.dx
        sides = {"xmin": 0, "xmax": narrow if self.flow.plates else L, "periodic_in_x": True}
        if not self.flow.plates:
            sides.update(ymin=0, ymax=L, periodic_in_y=True)
        if self.dim == 3:
            sides.update(zmin=0, zmax=narrow, periodic_in_z=True)
        return DomainManager(**sides)

    def lattice(self, layers):
        """Positions in the box, at these layers of y."""
        along = range(ACROSS if self.flow.plates else self.n)
        across = range(ACROSS if self.dim == 3 else 1)
        x, y, z = (self.dx * (numpy.array(one) + 0.5) for one in zip(*((i, j, k) for i in along for j in layers for k in across)))
        return x, y, z if self.dim == 3 else 0 * z

    def particles_at(self, name, layers):
        x, y, z = self.lattice(layers)
        return get_particle_array(name=name, x=x, y=y, z=z, m=RHO * self.dx**self.dim, rho=RHO, h=self.dx)

    def create_particles(self):
        self.fluid = self.particles_at("fluid", range(self.n))
        arrays = [self.fluid]
        if self.flow.plates:
            arrays.append(self.particles_at("walls", [*range(-LAYERS, 0), *range(self.n, self.n + LAYERS)]))
        self.scheme.setup_properties(arrays)
        for array in arrays:
            array.V[:] = 1 / self.dx**self.dim
        if self.flow.plates:
            arrays[1].u[:] = numpy.where(arrays[1].y > L / 2, self.flow.walls, -self.flow.walls)
        else:
            k = 2 * math.pi / L
            self.fluid.u[:] = self.flow.fastest * numpy.sin(k * self.fluid.x) * numpy.cos(k * self.fluid.y)
            self.fluid.v[:] = -self.flow.fastest * numpy.cos(k * self.fluid.x) * numpy.sin(k * self.fluid.y)
        return arrays

    def create_scheme(self):
        pressure = RHO * self.sound**2
        scheme = TVFScheme(["fluid"], ["walls"] if self.flow.plates else [], dim=self.dim, rho0=RHO, c0=self.sound, nu=NU, p0=pressure, pb=pressure,
                           h0=self.dx, gx=self.flow.force)
        scheme.configure_solver(tf=self.flow.end, dt=self.step, pfreq=10**9)
        return scheme

    def look(self, t):
        """Output at the first step at or after each output time, as the observers do."""
        if t < self.next * (1 - 1e-9):
            return
        self.next += self.flow.every * (math.floor((t - self.next) / self.flow.every + 1e-9) + 1)
        y, u, v, w, m = self.fluid.get("y", "u", "v", "w", "m")
        if self.flow.plates:
            layer = numpy.clip((y / self.dx).astype(int), 0, self.n - 1)
            count = numpy.bincount(layer, minlength=self.n)
            mean = numpy.bincount(layer, u, minlength=self.n) / count
            self.looks += [(t, ((j + 0.5) / self.n - 0.5) * L * TO_METRES, mean[j] * TO_METRES) for j in range(self.n)]
        else:
            self.looks.append((t, 0.5 * float(numpy.sum(m * (u * u + v * v + w * w)))))

    def post_step(self, solver):
        self.look(solver.t + solver.dt)  # PySPH advances its clock after this


def main():
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("case", choices=FLOWS)
    words.add_argument("particles", type=int)
    words.add_argument("folder", type=pathlib.Path)
    words.add_argument("-dimensions", type=int, choices=(2, 3), default=3)
    words.add_argument("-steps", type=int)
    given = words.parse_args()
    flow = FLOWS[given.case]
    with tempfile.TemporaryDirectory() as results:
        peer = Peer(flow, given.particles, given.dimensions, results)
        peer.setup(["--no-openmp", "--disable-output", "--quiet", *(["--max-steps", str(given.steps)] if given.steps else [])])
        peer.look(0.0)
        began = time.process_time()
        peer.solver.solve(show_progress=False)
        seconds = time.process_time() - began
    name, columns = ("profile", ("time_s", "position_m", "u_m_s")) if flow.plates else ("conservation", ("time_s", "kineticEnergy_J"))
    folder = given.folder / "postProcessing" / ("profile" if flow.plates else "balance")
    folder.mkdir(parents=True, exist_ok=True)
    with open(folder / f"{name}.csv", "w") as text:
        writer = csv.writer(text, lineterminator="\n")
        writer.writerow(columns)
        writer.writerows([f"{value:.10g}" for value in row] for row in peer.looks)
    steps, particles = peer.solver.count, sum(array.get_number_of_particles(True) for array in peer.particles)
    record = {"status": "stopped" if given.steps else "done", "parameters": {"particles": particles, "step_s": peer.step},
              "performance": {"processorSeconds": seconds, "steps": steps, "stepsToEnd": math.ceil(flow.end / peer.step)}}
    (given.folder / "run.json").write_text(json.dumps(record, indent=1) + "\n")
    print(json.dumps(record))


if __name__ == "__main__":
    sys.exit(main())
