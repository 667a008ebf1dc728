"""A case directory."""
import json
import pathlib

import pandas

from . import programs, results, tables


class Case:
    """A case: its settings (case["constant/flow.yaml:/Ca"]), tables, meshes, particles, and runs."""

    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        if not any((self.folder / "system" / file).is_file() for file in ("control.yaml", "relax.yaml")):
            raise FileNotFoundError(f"{self.folder} is not a case: it has neither system/control.yaml nor system/relax.yaml")

    def __repr__(self):
        return f"Case({str(self.folder)!r})"

    # Settings

    def __getitem__(self, key):
        """The value at FILE:/path, as text; a table as a dict, a list as a list."""
        return programs.runJson("caseDict", key, "-case", self.folder)

    def __setitem__(self, key, value):
        self.set({key: value})

    def __delitem__(self, key):
        programs.run([programs.program("caseDict"), "-case", str(self.folder), "-remove", key])

    def set(self, changes):
        """Several values at once, {"FILE:/path": value}: checked together before any is written. Comments stay."""
        if changes:
            programs.run([programs.program("caseDict"), "-case", str(self.folder), *_changes(changes)])

    @property
    def record(self):
        """run.json of the last run: groups, parameters, performance, status, ..."""
        path = self.folder / "run.json"
        return json.loads(path.read_text()) if path.is_file() else {}

    @property
    def used(self):
        """used.yaml: all settings as the last run understood them, defaults included (needs python3-yaml)."""
        import yaml
        return yaml.safe_load((self.folder / "used.yaml").read_text())

    # What a run has left

    @property
    def tables(self):
        """Names of the tables of observers, OBSERVER/FILE."""
        root = self.folder / "postProcessing"
        return sorted(str(path.relative_to(root).with_suffix("")) for path in root.glob("*/*.csv"))

    def table(self, name):
        """A table OBSERVER/FILE as a DataFrame (tables.readTable)."""
        path = self.folder / "postProcessing" / f"{name}.csv"
        if not path.is_file():
            raise FileNotFoundError(f"{path}: there is no such table; there are {', '.join(self.tables) or 'none'}")
        return tables.readTable(path)

    @property
    def times(self):
        """Times of results and checkpoints: time_s, strain, results, checkpoints."""
        if not self.streams and not self._hasBegun():
            return pandas.DataFrame({"time_s": [], "strain": [], "results": [], "checkpoints": []})
        return pandas.DataFrame(programs.runJson("listTimes", "-case", self.folder))

    @property
    def streams(self):
        """What there are results of: fluid, walls, types of cells, bodies."""
        return sorted(path.stem for path in (self.folder / "results").glob("*.pvd"))

    def surface(self, name, time=None, strain=None):
        """A type of cells or a body at the result nearest to a time [s] or a strain; the last one without both. In 0/ where nothing has run."""
        path = self.folder / "results" / f"{name}.pvd"
        if not path.is_file():
            start = self.folder / "0" / f"{name}.vtp"
            if start.is_file() and time is None and strain is None:
                return results.readSurface(start)
            raise FileNotFoundError(f"{path}: there are no results of {name!r}; there are {', '.join(self.streams) or 'none'}")
        all_ = results.entries(path)
        if not all_:
            raise ValueError(f"{path} has no times")
        if time is not None and strain is not None:
            raise ValueError("give a time or a strain")
        if strain is not None:
            known = self.times
            known = known[known["results"].apply(lambda names: name in names)]
            if "strain" not in known:
                raise ValueError("these results have no strain; give a time")
            low, high = known["strain"].min(), known["strain"].max()
            if not low - 1e-6 <= strain <= high + 1e-6:
                raise ValueError(f"these results reach from strain {low:g} to {high:g}")
            time = known["time_s"].iloc[(known["strain"] - strain).abs().argmin()]
        chosen = all_[-1] if time is None else min(all_, key=lambda entry: abs(entry[0] - time))
        if time is not None and not all_[0][0] - 1e-6 * all_[-1][0] <= time <= all_[-1][0] * (1 + 1e-6):
            raise ValueError(f"these results reach from {all_[0][0]:g} to {all_[-1][0]:g} s")
        return results.readSurface(chosen[1])

    def particles(self, time=None, strain=None):
        """The fluid's particles: points, and pointData as velocity, density, pressure, side (as `write.fields` says)."""
        return self.surface("fluid", time, strain)

    # Runs

    def clone(self, folder, changes=None):
        """A copy without results, with changes {"FILE:/path": value}."""
        programs.run([programs.program("cloneCase"), str(self.folder), str(folder), *_changes(changes or {})])
        return Case(folder)

    def clean(self, mesh=False):
        """Removes the results; with mesh=True also the mesh and the particles."""
        programs.run([programs.program("cleanCase"), "-case", str(self.folder), *(["-mesh"] if mesh else [])])

    @property
    def programs(self):
        """What this case needs to be run, in order."""
        if not (self.folder / "system/control.yaml").is_file():
            return ["membraneRelax"]
        mesh = self["system/mesh.yaml"] if (self.folder / "system/mesh.yaml").is_file() else {}
        packs = ["cellPack"] if (self.folder / "system/pack.yaml").is_file() else []
        meshes = ["membraneMesh"] if "cells" in mesh or "bodies" in mesh else []
        return packs + meshes + ["particleFill", self["system/control.yaml:/application"]]

    def run(self, ranks=1, only=None, show=False):
        """Meshes, fills and runs the case, or the programs that `only` names. Continues a run that was stopped; raises CorpuscleError with the
        program's own message where one fails. Returns False where a solver stopped early with a checkpoint, else True."""
        for name in ([only] if isinstance(only, str) else only) or self.programs:
            words = [programs.program(name), "-case", str(self.folder)]
            if name in ("dmpFlow", "sphFlow") and ranks > 1:
                words = ["mpirun", "-np", str(ranks)] + words
            elif name in ("membraneMesh", "particleFill", "cellPack") and only is None and self._hasBegun():
                continue
            if programs.run(words, allowed=(0, 5), show=show)[0] == 5:
                return False
        return True

    def _hasBegun(self):
        """Whether a run goes on from a checkpoint; with `startFrom: firstTime` it begins with mesh and particles."""
        return any((self.folder / "checkpoints").glob("*.h5")) and self.get("system/control.yaml:/startFrom", "latestTime") != "firstTime"

    def __contains__(self, key):
        try:
            self[key]
        except programs.CorpuscleError as error:
            if error.code != 2:
                raise
            return False
        return True

    def get(self, key, default=None):
        """The value at FILE:/path, or the default where it is not there."""
        return self[key] if key in self else default


def _changes(changes):
    return [word for key, value in changes.items() for word in ("-set", f"{key}={_yaml(value)}")]


def _yaml(value, inside=False):
    """As it is written in a dictionary."""
    if value is None:
        raise ValueError("None is no value of a dictionary; remove the entry by `del case[key]`")
    if hasattr(value, "tolist"):  # numpy
        value = value.tolist()
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(_yaml(one, True) for one in value) + "]"
    if isinstance(value, dict):
        return "{" + ", ".join(f"{key}: {_yaml(one, True)}" for key, one in value.items()) + "}"
    if isinstance(value, str) and inside and set(value) & set(",[]{}#:\"'"):
        return json.dumps(value)
    return repr(float(value)) if isinstance(value, float) else str(value)
