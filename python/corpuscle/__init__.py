"""Corpuscle's cases from Python: open them, read their tables, meshes and particles, change and run them, run studies.

    import corpuscle
    case = corpuscle.Case("tutorials/rbcShear/Ca0.02")
    shape = case.table("deformation/rbc")            # a pandas.DataFrame; shape.attrs["units"], shape.attrs["meanings"]
    shape.plot(x="strain", y="D12_extent")
    cell = case.surface("rbc", strain=2)             # points, triangles, arrays as numpy
    corpuscle.period(shape, "D12_extent")

Needs python3-pandas; python3-vtk9 or python3-paraview for meshes and particles; python3-matplotlib for reports; the programs of Corpuscle for changes and
runs. They are looked for in $CORPUSCLE_BIN, in the repository that this package lies in, and along PATH.
"""
from .analysis import Mean, crossing, mean, period, tankTreadingFrequency, unwrapped
from .case import Case
from .paraviewState import paraviewState
from .programs import CorpuscleError, program
from .report import report
from .results import Surface
from .study import Study
from .tables import readTable

__all__ = ["Case", "CorpuscleError", "Mean", "Study", "Surface", "crossing", "mean", "paraviewState", "period", "program", "readTable", "report", "tankTreadingFrequency", "unwrapped"]
