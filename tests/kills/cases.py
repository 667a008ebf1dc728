"""The runs that are killed: coarse, short cases of the tutorials, which write a checkpoint every 0.1 s and results and rows of observers all the time."""

CONTROL, NUMERICS, MESH = "system/control.yaml:/", "system/numerics.yaml:/", "system/mesh.yaml:/"
OFTEN = [CONTROL + "checkpoint={wallClock: 0.1 s, keep: 2}", CONTROL + "stop={}"]
CELL = ("membraneMesh", "particleFill", "dmpFlow")
COARSE = [NUMERICS + "spacing=1 um", MESH + "cells/0/edge=0.8 um"]


def box(x, y, z):
    return MESH + f"domain/size=[{x} um, {y} um, {z} um]"


def until(end, write):
    return [CONTROL + f"endStrain={end}", CONTROL + f"write/strain={write}"]


CASES = {  # name: tutorial, programs, settings
    "implicit": ("rbcShear/Ca0.02", CELL, [box(12, 11, 10), *COARSE, *until(1.5, 0.1), *OFTEN]),
    "rupture": ("rbcRupture", CELL, [box(16, 12, 10), *COARSE, *until(0.6, 0.05), *OFTEN]),
    "tear": ("rbcTear", CELL, [box(16, 12, 10), *COARSE, *until(1, 0.1), *OFTEN,
                               "constant/membranes.yaml:/rbc/rupture={type: cohesive, fractureEnergy: 4 pN, length: 2 um}"]),
    "manyCells": ("suspension", ("cellPack", *CELL), [box(12, 12, 12), NUMERICS + "spacing=1 um", MESH + "cells/0/edge=1 um", "system/pack.yaml:/cells/0/number=5",
                                                      *until(0.2, 0.05), *OFTEN]),
    "vessel": ("tubeFlow", CELL, [box(14, 10, 10), *COARSE, CONTROL + "endTime=1.2 ms", CONTROL + "write/time=0.1 ms", *OFTEN]),
    "fluid": ("taylorGreen", ("particleFill", "sphFlow"), [CONTROL + "endTime=5 ms", CONTROL + "write/time=0.5 ms", *OFTEN]),
    "artery": ("womersley", ("particleFill", "sphFlow"), [NUMERICS + "spacing=0.4 mm", CONTROL + "endTime=0.1 s", CONTROL + "write/time=0.01 s", *OFTEN]),
}
